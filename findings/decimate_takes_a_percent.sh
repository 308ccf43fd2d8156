#!/usr/bin/env bash
# decimate of SciPy and Octave makes everything 1.1 % smaller.
#
# Expected. decimate smooths a series and keeps every q-th value. A constant stays what it is, as with resample_poly,
# with decimate(..., "fir"), or with a mean over q values.
#
# What happens. The usual filter is of the kind Chebyshev I, order 8, with a ripple of .05 dB. With an even order such
# a filter has its lowest value at frequency 0: -.05 dB, and as it runs forwards and backwards, -.1 dB. So 1 becomes
# .98855, whatever q is. An amount that is conserved by the equations seems to lose 1.1 % when the film is thinned
# out, and twice as much when this is done in two steps, as the manual of SciPy recommends for q above 13. Waves below
# half of the new limit are between .9886 and 1 of their height. Nothing warns.
#
# Workaround: ftype="fir" in SciPy, decimate(x, q, "fir") in Octave; an odd order, decimate(x, q, 7), which has 1 at
# frequency 0.
#
# Seen with python3-scipy 1.10.1, octave 7.3.0 and octave-signal 1.4.3 of Debian 12.
set -eu
for p in python3-scipy=1.10.1 octave=7.3.0 octave-signal=1.4.3; do
  name=${p%%=*}
  if ! dpkg-query -W -f '${Version}' "$name" 2>/dev/null | grep -q .; then
    apt-get update -qq >/dev/null 2>&1 || true
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$name" >/dev/null 2>&1 ||
      { echo "could not install $name (Debian 12, as root)"; exit 2; }
  fi
  version=$(dpkg-query -W -f '${Version}' "$name" 2>/dev/null || true)
  case "${version#*:}" in
    "${p#*=}"[-+~]*) echo "$name $version" ;;
    *) echo "this was seen with $name ${p#*=}; here it is '${version:-not the one of Debian}'"; exit 2 ;;
  esac
done
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
cat > try.py <<'EOF_PY'
import numpy
from scipy import signal
ones = numpy.ones(400)
print("SciPy:")
for q in 2, 4, 10:
    print(f"  q = {q}: {signal.decimate(ones, q)[10]:.5f}")
print(f"  q = 5, then 2: {signal.decimate(signal.decimate(ones, 5), 2)[10]:.5f}")
print(f"  fir, q = 10: {signal.decimate(ones, 10, ftype='fir')[10]:.5f}")
print(f"  order 7, q = 10: {signal.decimate(ones, 10, 7)[10]:.5f}")
print(f"  resample_poly: {signal.resample_poly(ones, 1, 10)[10]:.5f}")
EOF_PY
cat > try.m <<'EOF_M'
pkg load signal
x = ones (1, 400);
disp ("Octave:");
for q = [2 4 10]
  printf ("  q = %d: %.5f\n", q, decimate (x, q)(11));
end
printf ("  fir, q = 10: %.3f\n", decimate (x, 10, "fir")(11));
printf ("  order 7, q = 10: %.5f\n", decimate (x, 10, 7)(11));
EOF_M
{ /usr/bin/python3 try.py; octave-cli --norc try.m 2> log; } | tee seen
cat > expected <<'EOF_TXT'
SciPy:
  q = 2: 0.98855
  q = 4: 0.98855
  q = 10: 0.98855
  q = 5, then 2: 0.97724
  fir, q = 10: 1.00000
  order 7, q = 10: 1.00000
  resample_poly: 1.00000
Octave:
  q = 2: 0.98855
  q = 4: 0.98855
  q = 10: 0.98855
  fir, q = 10: 1.000
  order 7, q = 10: 1.00000
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
