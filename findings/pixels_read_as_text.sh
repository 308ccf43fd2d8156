#!/usr/bin/env bash
# netcdf_file of SciPy writes the bytes of pictures as text.
#
# Expected. An array of uint8 is an array of numbers. netCDF 3 has no unsigned bytes, so a writer stores them as signed
# bytes with the attribute _Unsigned, stores them in 16 bits, or refuses, as netcdf_file does for uint16.
#
# What happens. netcdf_file stores uint8 as char, the type for text. What is read back is an array of one-byte strings:
# 0 is the empty string, 65 is "A". int8 stays a number. Sums and most conversions raise an error, but astype(int)
# reads the text: 48 to 57, the characters of the digits, become 0 to 9. So a mask of 49 and 50, or a picture that is
# dark grey everywhere, becomes a much darker one. Nothing warns.
#
# Workaround: v[:].view("u1"), which gives the numbers back; or write int16.
#
# Seen with python3-scipy 1.10.1 and python3-numpy 1.24.2 of Debian 12.
set -eu
for p in python3-scipy=1.10.1 python3-numpy=1.24.2; do
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
from scipy.io import netcdf_file
import numpy
rows = {"mixed": [0, 65, 100, 200, 255], "grey": [48, 49, 50, 56, 57]}
with netcdf_file("pixels.nc", "w") as file:
    file.createDimension("x", 5)
    for kind in "u1", "i1", "i2", "u2":
        for name, numbers in rows.items():
            try:
                variable = file.createVariable(f"{name} {kind}", numpy.dtype(kind), ("x",))
                variable[:] = numpy.array(numpy.minimum(numbers, 127 if kind == "i1" else 255), kind)
            except ValueError as error:
                print(f"{name} {kind}: {error}")
with netcdf_file("pixels.nc", mmap=False) as file:
    for name, variable in file.variables.items():
        print(f"{name}: read as {variable.typecode()}, {variable[:].tolist()}")
    text = file.variables["grey u1"][:]
    print("grey u1 as int:", text.astype(int).tolist(), "by view:", text.view("u1").tolist())
    try:
        print("mixed u1 as int:", file.variables["mixed u1"][:].astype(int).tolist())
    except ValueError as error:
        print("mixed u1 as int:", error)
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
mixed u2: NetCDF 3 does not support type uint16
grey u2: NetCDF 3 does not support type uint16
mixed u1: read as c, [b'', b'A', b'd', b'\xc8', b'\xff']
grey u1: read as c, [b'0', b'1', b'2', b'8', b'9']
mixed i1: read as b, [0, 65, 100, 127, 127]
grey i1: read as b, [48, 49, 50, 56, 57]
mixed i2: read as h, [0, 65, 100, 200, 255]
grey i2: read as h, [48, 49, 50, 56, 57]
grey u1 as int: [0, 1, 2, 8, 9] by view: [48, 49, 50, 56, 57]
mixed u1 as int: invalid literal for int() with base 10: b''
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
