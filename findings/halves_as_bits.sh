#!/usr/bin/env bash
# ffmpeg takes the bits of 16-bit floats in TIFF files for brightness.
#
# Expected. TIFF stores numbers of 16 bits as unsigned, signed or floating-point (SampleFormat 1, 2, 3). GDAL and
# OpenImageIO read floats of 16 bits as numbers, and vips refuses them. ffmpeg refuses floats of 32 bits, so it should
# read those of 16 bits correctly or refuse them, too.
#
# What happens. ffmpeg reads the bits as unsigned numbers, without a warning. The range 0 to 1 becomes 0 to 0.234, and
# not linearly: .25 is .203. Numbers below zero become brighter than 1, so the troughs of a wave about 0 are the
# brightest parts of the picture.
#
# Workaround: convert such files to EXR or to unsigned numbers first.
#
# Seen with ffmpeg 5.1.9, gdal-bin 3.6.2 and openimageio-tools 2.4.7.1 of Debian 12.
set -eu
for p in ffmpeg=5.1.9 gdal-bin=3.6.2 openimageio-tools=2.4.7.1; do
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
printf 'ncols 6\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n-0.5 -0.25 0 0.25 0.5 1\n' > in.asc
gdal_translate -q -ot Float32 -co NBITS=16 in.asc half.tif
{
  echo "GDAL: from $(gdalinfo -mm half.tif | sed -n 's/.*Min.Max=\(.*\),/\1 to /p')"
  echo "OpenImageIO: from $(oiiotool --stats half.tif | sed -n 's/.*Stats Min: \([^ ]*\) .*/\1/p')" \
    "to $(oiiotool --stats half.tif | sed -n 's/.*Stats Max: \([^ ]*\) .*/\1/p')"
  ffmpeg -v warning -y -i half.tif -pix_fmt gray16le -f rawvideo out.raw
  echo "ffmpeg, of 65535:$(od -An -tu2 out.raw)"
  gdal_translate -q -ot Float32 in.asc single.tif
  ffmpeg -v quiet -y -i single.tif -pix_fmt gray16le -f rawvideo other.raw && echo "ffmpeg reads floats of 32 bits" ||
    echo "ffmpeg refuses floats of 32 bits"
} | tee seen
cat > expected <<'EOF_TXT'
GDAL: from -0.500 to 1.000
OpenImageIO: from -0.500000 to 1.000000
ffmpeg, of 65535: 47104 46080     0 13312 14336 15360
ffmpeg refuses floats of 32 bits
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
