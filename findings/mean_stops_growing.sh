#!/usr/bin/env bash
# In numba the mean of 25 million ones is .67.
#
# Expected. Functions compiled by numba give the results of numpy. numpy adds up floats of 32 bits in pairs, so that
# sums of many numbers are right to six digits; if numba adds them one after the other, it would use a double.
#
# What happens. sum() and mean() of a 32-bit array add one after the other in 32 bits. From 2^24 = 16777216 on, adding 1
# changes nothing: a field of 5000 x 5000 ones has the sum 16777216 and the mean .67, and std() of equal numbers is .33.
# With other numbers it begins earlier: with numbers between .3 and .4, one million have a mean that is wrong in the
# fourth digit, and 25 million a mean of .3355 instead of .3500. numpy gives .35000. Nothing warns. A test on a small
# grid shows nothing. Means that a reaction reads, and checks that an amount is conserved, fail on large grids only.
#
# Workaround: add in a variable that begins with 0.0, which is a double, or use a.astype(numpy.float64).
#
# Seen with python3-numba 0.56.4 and python3-numpy 1.24.2 of Debian 12.
set -eu
for p in python3-numba=0.56.4 python3-numpy=1.24.2; do
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
import numba
import numpy
@numba.njit
def compiled(a):
    return a.sum(), a.mean(), a.std()
@numba.njit
def in_a_double(a):
    total = 0.0
    for number in a.flat:
        total += number
    return total / a.size
def report(name, a):
    total, mean, spread = compiled(a)
    print(f"{name}: sum {total:.5g}, mean {mean:.4f}, std {spread:.4f}; "
          f"numpy {a.sum():.5g}, {a.mean():.4f}, {a.std():.4f}; mean in a double {in_a_double(a):.4f}")
for side in 1000, 4096, 5000:
    report(f"{side} x {side} ones", numpy.ones((side, side), "f4"))
for side in 1000, 5000:
    steps = numpy.arange(side * side, dtype="i8") * 7919 % 10007  # the same numbers each time, from 0 to 10006
    report(f"{side} x {side} numbers from .3 to .4", (0.3 + 0.1 * steps / 10007).astype("f4").reshape(side, side))
EOF_PY
/usr/bin/python3 -W ignore try.py | tee seen
cat > expected <<'EOF_TXT'
1000 x 1000 ones: sum 1e+06, mean 1.0000, std 0.0000; numpy 1e+06, 1.0000, 0.0000; mean in a double 1.0000
4096 x 4096 ones: sum 1.6777e+07, mean 1.0000, std 0.0000; numpy 1.6777e+07, 1.0000, 0.0000; mean in a double 1.0000
5000 x 5000 ones: sum 1.6777e+07, mean 0.6711, std 0.3289; numpy 2.5e+07, 1.0000, 0.0000; mean in a double 1.0000
1000 x 1000 numbers from .3 to .4: sum 3.5009e+05, mean 0.3501, std 0.0289; numpy 3.5e+05, 0.3500, 0.0289; mean in a double 0.3500
5000 x 5000 numbers from .3 to .4: sum 8.3886e+06, mean 0.3355, std 0.0323; numpy 8.7497e+06, 0.3500, 0.0289; mean in a double 0.3500
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
