#!/usr/bin/env bash
# OpenImageIO reads and writes FITS pictures shifted by one row.
#
# Expected. In a FITS file the numbers follow the header directly, beginning at a multiple of 2880 bytes, and the last
# block is filled up to 2880 bytes (FITS standard 4.0, section 3.3.2). The first row of the file is the lowest one.
#
# What happens. OpenImageIO reads the rows from the second one on, and fills the highest row with 0: the lowest row is
# lost, and the others are one row too low. It also ignores BZERO, by which FITS stores unsigned numbers of 16 bits, so
# numbers below 32768 become 0, and the others are 32768 too small and doubled. Files that it writes have a row of zeros
# before the picture, and no filling. Other programs see the picture one row too high and without its highest row, or
# refuse the file. OpenImageIO itself reads it correctly, so a test of writing and reading passes. Nothing warns.
#
# Workaround: convert by ImageMagick, which reads and writes both kinds correctly.
#
# Seen with openimageio-tools 2.4.7.1, imagemagick 6.9.11.60 and python3-astropy 5.2.1 of Debian 12.
set -eu
for p in openimageio-tools=2.4.7.1 imagemagick=6.9.11.60 python3-astropy=5.2.1 python3-pil=9.4.0; do
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
import warnings
import numpy
from PIL import Image
from astropy.io import fits
warnings.simplefilter("ignore")  # astropy's, of a file that is too short
def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout
def show(name, file):
    depth = "16" if file == "words.fits" else "8"
    run("oiiotool", file, "-d", "uint" + depth, "-o", "tool.png")
    run("convert", file, "-depth", depth, "magick.png")
    by_tool, by_magick = (" ".join(map(str, Image.open(f).getdata())) for f in ("tool.png", "magick.png"))
    print(f"{name}, from the top: OpenImageIO {by_tool}; ImageMagick {by_magick}")
def rows(file):
    with fits.open(file, ignore_missing_end=True) as opened:
        return opened[0].data[::-1, 0].tolist()  # astropy begins with the lowest row
fits.writeto("bytes.fits", numpy.array([[40], [30], [20], [10]], "u1"))
show("bytes 10 20 30 40", "bytes.fits")
fits.writeto("words.fits", numpy.array([[60000], [40000], [20000], [10000]], "u2"))
show("16 bits 10000 20000 40000 60000", "words.fits")
open("in.pgm", "w").write("P2\n1 4\n255\n10 20 30 40\n")
for name, command in ("OpenImageIO", ["oiiotool", "in.pgm", "-o"]), ("ImageMagick", ["convert", "in.pgm"]):
    run(*command, "written.fits")
    size = len(open("written.fits", "rb").read())
    print(f"10 20 30 40 written by {name}: astropy reads {rows('written.fits')}, {size % 2880} bytes in the last block")
show("bytes written by ImageMagick", "written.fits")
run("oiiotool", "in.pgm", "-o", "own.fits")
show("bytes written by OpenImageIO", "own.fits")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
bytes 10 20 30 40, from the top: OpenImageIO 0 10 20 30; ImageMagick 10 20 30 40
16 bits 10000 20000 40000 60000, from the top: OpenImageIO 0 0 0 14464; ImageMagick 10000 20000 40000 60000
10 20 30 40 written by OpenImageIO: astropy reads [20, 30, 40, 0], 5 bytes in the last block
10 20 30 40 written by ImageMagick: astropy reads [10, 20, 30, 40], 0 bytes in the last block
bytes written by ImageMagick, from the top: OpenImageIO 0 10 20 30; ImageMagick 10 20 30 40
bytes written by OpenImageIO, from the top: OpenImageIO 10 20 30 40; ImageMagick 20 30 40 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
