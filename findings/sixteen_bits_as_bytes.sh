#!/usr/bin/env bash
# VTK reads PGM files of 16 bits as bytes.
#
# Expected. PGM and PPM files have two bytes for each number if their largest number is above 255. vtkPNGReader and
# vtkTIFFReader give 16 bits as unsigned short, so vtkPNMReader should do the same, or refuse such files.
#
# What happens. vtkPNMReader ignores the largest number in the header and takes each byte for a number. The image has
# the right size, but it holds only the first half of the file. High and low bytes alternate, so a smooth picture gets
# stripes of noise. There is no warning.
#
# Workaround: PNG, or a raw file read by vtkImageReader with SetDataScalarTypeToUnsignedShort.
#
# Seen with python3-vtk9 9.1.0 of Debian 12.
set -eu
for p in python3-vtk9=9.1.0; do
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
import vtk
from vtk.util.numpy_support import vtk_to_numpy
numbers = [[1000, 2000, 3000], [4000, 5000, 6000]]
def pgm(name, largest, size, scale):
    with open(name, "wb") as file:
        file.write(f"P5\n3 2\n{largest}\n".encode())
        for row in numbers:
            for number in row:
                file.write((number // scale).to_bytes(size, "big"))
def show(name):
    reader = vtk.vtkPNMReader()
    reader.SetFileName(name)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    values = vtk_to_numpy(scalars).reshape(2, 3)[::-1].tolist()
    print(f"{name}: {scalars.GetDataTypeAsString()}, from the top: {values}")
print("in the file of 16 bits:", numbers)
pgm("of_8_bits.pgm", 255, 1, 100)
show("of_8_bits.pgm")
pgm("of_16_bits.pgm", 65535, 2, 1)
show("of_16_bits.pgm")
print("its bytes:", [list(number.to_bytes(2, "big")) for row in numbers for number in row])
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
in the file of 16 bits: [[1000, 2000, 3000], [4000, 5000, 6000]]
of_8_bits.pgm: unsigned char, from the top: [[10, 20, 30], [40, 50, 60]]
of_16_bits.pgm: unsigned char, from the top: [[3, 232, 7], [208, 11, 184]]
its bytes: [[3, 232], [7, 208], [11, 184], [15, 160], [19, 136], [23, 112]]
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
