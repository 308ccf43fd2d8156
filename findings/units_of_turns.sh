#!/usr/bin/env bash
# Sixty turns per minute are 6.28 hertz in pint, quantities, UDUNITS and GNU units.
#
# Expected. A frequency counts turns, beats or waves per second: 60 rpm are 1 Hz, as 60 beats per minute are. A
# library that converts rpm to hertz without an error should give 1.
#
# What happens. The four treat a turn as an angle of 2 pi radians and a radian as 1, so a turn is 6.28, and 60 rpm are
# 6.28 Hz. Nothing warns. The same holds for revolution in pint and GNU units, and for cycle in UDUNITS. Conversely 1 Hz
# is 1 rad/s, as if it were the angular frequency, and .159 turns per second. So a rate of oscillation that passes
# through such a library can be wrong by a factor of 2 pi, while 60/min, without a word for the turn, comes out as 1 Hz.
#
# Workaround: write 1/min or 1/s for frequencies, and rad/s for angular frequencies.
#
# Seen with python3-pint 0.19.2, python3-quantities 0.13.0, udunits-bin 2.2.28 and units 2.22 of Debian 12.
set -eu
for p in python3-pint=0.19.2 python3-quantities=0.13.0 udunits-bin=2.2.28 units=2.22; do
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
import pint
import quantities
import subprocess
unit = pint.UnitRegistry()
def by_pint(number, old, new):
    return (number * unit(old)).to(new).magnitude
def by_quantities(number, old, new):
    return float(quantities.Quantity(number, old).rescale(new))
def by_udunits(number, old, new):
    told = subprocess.run(["udunits2", "-H", f"{number} {old}", "-W", new], capture_output=True, text=True).stdout
    return float(told.split("=")[1].split()[0])
def by_units(number, old, new):
    return float(subprocess.run(["units", "-t", f"{number} {old}", new], capture_output=True, text=True).stdout)
for number, old, new in (60, "rpm", "Hz"), (60, "1/min", "Hz"), (1, "Hz", "rpm"), (1, "Hz", "radian/s"):
    print(f"{number} {old} in {new}:", end="")
    for name, convert in ("pint", by_pint), ("quantities", by_quantities), ("UDUNITS", by_udunits), ("units", by_units):
        print(f" {name} {convert(number, old, new):.4g}", end="")
    print()
print(f"1 cycle in radian: UDUNITS {by_udunits(1, 'cycle', 'radian'):.4g}")
print(f"60 revolution/min in Hz: pint {by_pint(60, 'revolution/min', 'Hz'):.4g}",
      f"units {by_units(60, 'revolution/min', 'Hz'):.4g}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
60 rpm in Hz: pint 6.283 quantities 6.283 UDUNITS 6.283 units 6.283
60 1/min in Hz: pint 1 quantities 1 UDUNITS 1 units 1
1 Hz in rpm: pint 9.549 quantities 9.549 UDUNITS 9.549 units 9.549
1 Hz in radian/s: pint 1 quantities 1 UDUNITS 1 units 1
1 cycle in radian: UDUNITS 6.283
60 revolution/min in Hz: pint 6.283 units 6.283
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
