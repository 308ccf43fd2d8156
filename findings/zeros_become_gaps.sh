#!/usr/bin/env bash
# xarray reads the zeros of Zarr arrays as missing values.
#
# Expected. A Zarr array has a fill_value: what a chunk contains that was never written. zarr-python sets it to 0
# by default. It does not mean "missing", and all the numbers that were written should be read as they are.
#
# What happens. xarray takes the fill_value for the _FillValue of netCDF, which does mean "missing". So open_zarr
# makes each 0 a NaN, also those that were written, and integers become floats. Counts, masks, labels of cells and a
# concentration that is 0 outside of a spot are full of gaps. Means leave the gaps out: a field that is 2 in one of
# four points, and else 0, has the mean 2. Nothing warns.
#
# Workaround: create the arrays with fill_value=None, or open them with mask_and_scale=False.
#
# Seen with python3-zarr 2.13.6 and python3-xarray 2023.01.0 of Debian 12.
set -eu
for p in python3-zarr=2.13.6 python3-xarray=2023.01.0; do
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
import xarray
import zarr
group = zarr.open_group("a.zarr", "w")
for name, kind, more in (("cells", "i4", {}), ("u", "f4", {}), ("free", "f4", {"fill_value": None})):
    array = group.create_dataset(name, data=numpy.array([0, 0, 2, 0], kind), **more)
    array.attrs["_ARRAY_DIMENSIONS"] = ["x"]
    print(f"{name}, fill_value {array.fill_value}: zarr reads {array[:].tolist()}, mean {array[:].mean():g}")
for how in {}, {"mask_and_scale": False}:
    data = xarray.open_zarr("a.zarr", consolidated=False, **how)
    for name in "cells", "u", "free":
        print(f"{name}, xarray with {how}: {data[name].values.tolist()}, mean {float(data[name].mean()):g}")
EOF_PY
python3 try.py | tee seen
cat > expected <<'EOF_TXT'
cells, fill_value 0: zarr reads [0, 0, 2, 0], mean 0.5
u, fill_value 0.0: zarr reads [0.0, 0.0, 2.0, 0.0], mean 0.5
free, fill_value None: zarr reads [0.0, 0.0, 2.0, 0.0], mean 0.5
cells, xarray with {}: [nan, nan, 2.0, nan], mean 2
u, xarray with {}: [nan, nan, 2.0, nan], mean 2
free, xarray with {}: [0.0, 0.0, 2.0, 0.0], mean 0.5
cells, xarray with {'mask_and_scale': False}: [0, 0, 2, 0], mean 0.5
u, xarray with {'mask_and_scale': False}: [0.0, 0.0, 2.0, 0.0], mean 0.5
free, xarray with {'mask_and_scale': False}: [0.0, 0.0, 2.0, 0.0], mean 0.5
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
