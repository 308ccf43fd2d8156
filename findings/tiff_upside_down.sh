#!/usr/bin/env bash
# VTK reads TIFF files upside down, even its own.
#
# Expected. In VTK, y points up, so vtkPNGReader gives the bottom row of a picture first. TIFF files begin with the top
# row unless their Orientation says otherwise (the default is 1). So vtkTIFFReader should give the same numbers as
# vtkPNGReader for the same picture, and a picture that VTK writes and reads should stay as it is.
#
# What happens. vtkTIFFReader gives the first row of the file, the top row, as y = 0, so the picture stands on its head
# beside its PNG. vtkTIFFWriter writes the top row first, as it should, and VTK then reads its own file upside down.
# Textures and slices of a stack are mirrored, without a warning.
#
# Workaround: SetOrientationType(4) before reading a file whose Orientation is 1, or PNG.
#
# Seen with python3-vtk9 9.1.0 and gdal-bin 3.6.2 of Debian 12.
set -eu
for p in python3-vtk9=9.1.0 gdal-bin=3.6.2; do
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
printf 'ncols 2\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n10 10\n20 20\n30 30\n' > in.asc
gdal_translate -q -ot Byte in.asc in.tif
gdal_translate -q -ot Byte -of PNG in.asc in.png
cat > try.py <<'EOF_PY'
import vtk
from vtk.util.numpy_support import vtk_to_numpy
def show(reader, name, orientation=None):
    reader.SetFileName(name)
    words = ""
    if orientation:
        reader.SetOrientationType(orientation)
        words = f", SetOrientationType({orientation})"
    reader.Update()
    print(f"VTK, from the bottom to the top, {name}{words}:",
          vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[::2].tolist())
show(vtk.vtkPNGReader(), "in.png")
show(vtk.vtkTIFFReader(), "in.tif")
show(vtk.vtkTIFFReader(), "in.tif", 4)
picture, writer = vtk.vtkPNGReader(), vtk.vtkTIFFWriter()
picture.SetFileName("in.png")
writer.SetInputConnection(picture.GetOutputPort())
writer.SetFileName("by_vtk.tif")
writer.Write()
show(vtk.vtkTIFFReader(), "by_vtk.tif")
EOF_PY
{
  /usr/bin/python3 try.py
  for name in in.png in.tif by_vtk.tif; do
    gdal_translate -q -of XYZ $name "$name.xyz"
    echo "GDAL, from the top to the bottom, $name:" $(sed -n 'n;s/.* //p' "$name.xyz")
  done
} | tee seen
cat > expected <<'EOF_TXT'
VTK, from the bottom to the top, in.png: [30, 20, 10]
VTK, from the bottom to the top, in.tif: [10, 20, 30]
VTK, from the bottom to the top, in.tif, SetOrientationType(4): [30, 20, 10]
VTK, from the bottom to the top, by_vtk.tif: [10, 20, 30]
GDAL, from the top to the bottom, in.png: 10 20 30
GDAL, from the top to the bottom, in.tif: 10 20 30
GDAL, from the top to the bottom, by_vtk.tif: 10 20 30
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
