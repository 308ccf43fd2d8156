#!/usr/bin/env bash
# Signed 16-bit TIFF files become four different pictures.
#
# Expected. TIFF has signed whole numbers (SampleFormat 2). For a PNG, which has none, a program may cut the numbers
# below 0, or shift all of them, but it should keep their order, or refuse.
#
# What happens. ImageMagick shifts: 0 becomes middle grey. OpenImageIO cuts below 0 and doubles the rest, so that
# 32767 becomes white. vips and GDAL cut, and keep the rest. GraphicsMagick and ffmpeg take the bits as unsigned:
# -1 becomes white beside a black 0, so a field that waves about 0 has hard edges that are not in the data.
#
# Workaround: shift and scale to unsigned numbers before, or use floats.
#
# Seen with the packages of Debian 12 whose versions are below.
set -eu
for p in gdal-bin=3.6.2 imagemagick=6.9.11.60 graphicsmagick=1.4 openimageio-tools=2.4.7.1 \
  libvips-tools=8.14.1 ffmpeg=5.1.9; do
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
printf 'ncols 6\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n-32768 -100 -1 0 100 32767\n' > in.asc
gdal_translate -q -ot Int16 in.asc in.tif
show() { echo "$1: $(gdal_translate -q -of AAIGrid out.png out.asc && tail -n 1 out.asc | xargs)"; }
try() {
  echo "in the file: $(tail -n 1 in.asc)"
  convert -quiet in.tif -depth 16 out.png && show ImageMagick
  oiiotool in.tif -d uint16 -o out.png && show OpenImageIO
  vips copy in.tif out.png 2> /dev/null && show vips
  gdal_translate -q -of PNG -ot UInt16 in.tif out.png && show GDAL
  gm convert in.tif -depth 16 out.png 2> /dev/null && show GraphicsMagick
  ffmpeg -v quiet -y -i in.tif -pix_fmt gray16be out.png && show ffmpeg
}
try | tee seen
cat > expected <<'EOF_TXT'
in the file: -32768 -100 -1 0 100 32767
ImageMagick: 0 32668 32767 32768 32868 65535
OpenImageIO: 0 0 0 0 200 65535
vips: 0 0 0 0 100 32767
GDAL: 0 0 0 0 100 32767
GraphicsMagick: 32768 65436 65535 0 100 32767
ffmpeg: 32768 65436 65535 0 100 32767
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
