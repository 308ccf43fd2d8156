#!/usr/bin/env bash
# The mean of whole numbers is a whole number in cdo and NCO, and half of 1 is 1 in cdo.
#
# Expected. Means, standard deviations and quotients of counts, labels or pixels are rarely whole numbers. numpy and
# xarray return floats for them, and so should tools whose purpose is statistics of files.
#
# What happens. Both tools keep the type of the variable and round. The mean of 1 1 1 4 is 2, not 1.75, and the
# standard deviation in cdo is 1, not 1.3. cdo divc,2 turns 1 2 3 4 into 1 1 2 2, so the sum of the halves is 6
# instead of 5. The mean of a film of 0 and 1 is 0 or 1 in each pixel. Neither tool warns.
#
# Workaround: cdo -b F64; in NCO ncap2 -s 'u=double(u)' before.
#
# Seen with cdo 2.1.1, nco 5.1.4 and python3-netcdf4 1.6.2 of Debian 12.
set -eu
for p in cdo=2.1.1 nco=5.1.4 python3-netcdf4=1.6.2; do
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
import subprocess
import netCDF4
import numpy
def write(name, numbers, type):
    with netCDF4.Dataset(name, "w") as data:
        data.createDimension("time", None)
        data.createDimension("x", 1)
        time = data.createVariable("time", "f8", ("time",))
        time.units = "days since 2000-01-01"
        time[:] = numpy.arange(len(numbers))
        data.createVariable("u", type, ("time", "x"))[:, 0] = numbers
def run(command):
    log = subprocess.run(command, shell=True, capture_output=True, text=True)
    with netCDF4.Dataset("out.nc") as data:
        u = data["u"][:]
        print(f"{command}: {' '.join(f'{v:.3g}' for v in u.ravel())} ({u.dtype})"
              + (" with a message" if "arn" in log.stderr else ""))
write("a.nc", [1, 1, 1, 4], "i4")
write("b.nc", [1, 2, 3, 4], "i4")
run("cdo timmean a.nc out.nc")
run("ncra -O a.nc out.nc")
run("cdo -b F64 timmean a.nc out.nc")
run("cdo timstd a.nc out.nc")
run("cdo divc,2 b.nc out.nc")
run("cdo mulc,.4 b.nc out.nc")
run("cdo -b F64 divc,2 b.nc out.nc")
run("ncap2 -O -s 'u=double(u)' a.nc c.nc && ncra -O c.nc out.nc")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
cdo timmean a.nc out.nc: 2 (int32)
ncra -O a.nc out.nc: 2 (int32)
cdo -b F64 timmean a.nc out.nc: 1.75 (float64)
cdo timstd a.nc out.nc: 1 (int32)
cdo divc,2 b.nc out.nc: 1 1 2 2 (int32)
cdo mulc,.4 b.nc out.nc: 0 1 1 2 (int32)
cdo -b F64 divc,2 b.nc out.nc: 0.5 1 1.5 2 (float64)
ncap2 -O -s 'u=double(u)' a.nc c.nc && ncra -O c.nc out.nc: 1.75 (float64)
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
