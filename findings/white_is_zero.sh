#!/usr/bin/env bash
# VTK, OpenImageIO and Pillow misread TIFF files of 16 bits in which 0 is white.
#
# Expected. A grey TIFF file says by its PhotometricInterpretation whether 0 is white (0) or black (1), and readers
# have to support both (TIFF 6.0, sections 3 and 4). The three programs do so if a picture has 8 bits per pixel. With
# 16 bits they should do the same, or refuse.
#
# What happens. OpenImageIO and Pillow leave the numbers as they are, so the picture is a negative. VTK inverts the
# lower byte of each number, and leaves in the upper byte whatever was in the memory: noise. Nothing warns. ImageMagick
# and ffmpeg read both depths correctly.
#
# Workaround: write min-is-black, or convert by ImageMagick first.
#
# Seen with the packages of Debian 12 whose versions are below.
set -eu
for p in imagemagick=6.9.11.60 ffmpeg=5.1.9 gdal-bin=3.6.2 openimageio-tools=2.4.7.1 python3-pil=9.4.0 \
    python3-vtk9=9.1.0; do
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
import numpy
import vtk
from PIL import Image
def raw(*command):
    subprocess.run(command, check=True, capture_output=True)
    return numpy.fromfile("out.raw", "<u2")
def by_vtk(file):
    reader = vtk.vtkTIFFReader()
    reader.SetFileName(file)
    reader.Update()
    return [reader.GetOutput().GetScalarComponentAsDouble(x, 0, 0, 0) for x in range(4)]
def by_oiio(file):
    subprocess.run(["oiiotool", file, "-d", "uint16", "-o", "out.png"], check=True)
    return numpy.array(Image.open("out.png").getdata())
def show(name, values, white):
    print(f"{name}: " + " ".join(f"{v / white:.2f}" for v in values))
open("in8.pgm", "wb").write(b"P5\n4 1\n255\n" + bytes([0, 64, 128, 255]))
open("in16.pgm", "wb").write(b"P5\n4 1\n65535\n" + numpy.array([0, 16448, 32896, 65535], ">u2").tobytes())
for bits in 8, 16:
    for kind in "black", "white":
        file = f"{kind}{bits}.tif"
        subprocess.run(["gdal_translate", "-q", "-co", f"PHOTOMETRIC=MINIS{kind.upper()}", f"in{bits}.pgm", file],
                       check=True)
        white = 2 ** bits - 1
        print(f"{bits} bits, 0 is {kind}; black as 0, white as 1")
        show("  ImageMagick", raw("convert", file, "-depth", "16", "-endian", "LSB", "gray:out.raw"), 65535)
        show("  ffmpeg", raw(*f"ffmpeg -y -i {file} -pix_fmt gray16le -f rawvideo out.raw".split()), 65535)
        show("  OpenImageIO", by_oiio(file), 65535)
        show("  Pillow", list(Image.open(file).getdata()), white)
        if file == "white16.tif":
            print("  VTK, lower bytes: " + " ".join(f"{v % 256:.0f}" for v in by_vtk(file)))
        else:
            show("  VTK", by_vtk(file), white)
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
8 bits, 0 is black; black as 0, white as 1
  ImageMagick: 0.00 0.25 0.50 1.00
  ffmpeg: 0.00 0.25 0.50 1.00
  OpenImageIO: 0.00 0.25 0.50 1.00
  Pillow: 0.00 0.25 0.50 1.00
  VTK: 0.00 0.25 0.50 1.00
8 bits, 0 is white; black as 0, white as 1
  ImageMagick: 1.00 0.75 0.50 0.00
  ffmpeg: 1.00 0.75 0.50 0.00
  OpenImageIO: 1.00 0.75 0.50 0.00
  Pillow: 1.00 0.75 0.50 0.00
  VTK: 1.00 0.75 0.50 0.00
16 bits, 0 is black; black as 0, white as 1
  ImageMagick: 0.00 0.25 0.50 1.00
  ffmpeg: 0.00 0.25 0.50 1.00
  OpenImageIO: 0.00 0.25 0.50 1.00
  Pillow: 0.00 0.25 0.50 1.00
  VTK: 0.00 0.25 0.50 1.00
16 bits, 0 is white; black as 0, white as 1
  ImageMagick: 1.00 0.75 0.50 0.00
  ffmpeg: 1.00 0.75 0.50 0.00
  OpenImageIO: 0.00 0.25 0.50 1.00
  Pillow: 0.00 0.25 0.50 1.00
  VTK, lower bytes: 255 191 127 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
