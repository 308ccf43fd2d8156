#!/usr/bin/env bash
# netCDF4 of Python masks the white pixels of pictures.
#
# Expected. An array of bytes that is stored as u1 without _FillValue has 256 values, and all of them are data. The
# netCDF conventions say that without _FillValue all possible values of a byte are valid.
#
# What happens. netCDF4 masks 255 in u1 and -127 in i1. It does so for each type with its default fill value, but in
# bytes this is a number that occurs: the white pixels of a picture, a saturated field, label 255, or counts that were
# cut at 255. Means and sums leave them out: the mean of 0 1 254 255 is 85 instead of 127.5. filled() puts in the same
# number again, so a round trip hides it. xarray and cdo read 255 as a number. Nothing warns.
#
# Workaround: set_auto_mask(False) for the data set; or fill_value=False when the variable is made.
#
# Seen with python3-netcdf4 1.6.2, python3-xarray 2023.01.0 and cdo 2.1.1 of Debian 12.
set -eu
for p in python3-netcdf4=1.6.2 python3-xarray=2023.01.0 cdo=2.1.1; do
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
import xarray
def write(name, **options):
    with netCDF4.Dataset(name, "w") as data:
        data.createDimension("x", 4)
        data.createVariable("u", "u1", ("x",), **options)[:] = numpy.array([0, 1, 254, 255], "u1")
        data.createVariable("s", "i1", ("x",), **options)[:] = numpy.array([-128, -127, 0, 127], "i1")
write("a.nc")
data = netCDF4.Dataset("a.nc")
print("attributes:", data["u"].ncattrs())
for name in "us":
    print(f"netCDF4, {data[name].dtype}: {data[name][:]}, mean {data[name][:].mean():g}")
print("filled:", data["u"][:].filled())
with xarray.open_dataset("a.nc") as other:
    print(f"xarray: {other.u.values}, mean {float(other.u.mean()):g}")
out = subprocess.run("cdo -s outputf,%4g,4 -selname,u a.nc".split(), capture_output=True, text=True).stdout
print("cdo:", out.strip())
data.set_auto_mask(False)
print("set_auto_mask(False):", data["u"][:])
write("b.nc", fill_value=False)
print("fill_value=False:", netCDF4.Dataset("b.nc")["u"][:])
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
attributes: []
netCDF4, uint8: [0 1 254 --], mean 85
netCDF4, int8: [-128 -- 0 127], mean -0.333333
filled: [  0   1 254 255]
xarray: [  0   1 254 255], mean 127.5
cdo: 0   1 254 255
set_auto_mask(False): [  0   1 254 255]
fill_value=False: [  0   1 254 255]
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
