#!/usr/bin/env bash
# OpenImageIO reads tiled TIFF files of doubles as black.
#
# Expected. OpenImageIO reads TIFF files of 64-bit floats: oiiotool describes such a file as "double tiff". Large
# pictures are often stored in tiles, and maketx always writes tiles.
#
# What happens. Doubles in strips are read correctly. In tiles, every pixel is 0, without an error or a warning. maketx
# keeps the type, so it turns a good file of doubles into a texture that OpenImageIO itself reads as black. The file
# contains the right numbers: GDAL reads them. Floats of 32 bits are read correctly in both layouts.
#
# Workaround: store floats of 32 bits, or strips; for maketx, -d float.
#
# Seen with openimageio-tools 2.4.7.1 and gdal-bin 3.6.2 of Debian 12.
set -eu
for p in openimageio-tools=2.4.7.1 gdal-bin=3.6.2; do
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
{
  printf 'ncols 64\nnrows 64\nxllcorner 0\nyllcorner 0\ncellsize 1\n'
  for y in $(seq 64); do seq -s ' ' "$((y * 64))" "$((y * 64 + 63))"; done
} > in.asc
look() {
  echo "$1: largest value by GDAL $(gdalinfo -mm "$2" | sed -n 's/.*Min.Max=.*,//p')," \
    "by OpenImageIO $(oiiotool --stats "$2" | sed -n 's/.*Stats Max: \([^ ]*\) .*/\1/p')"
}
try() {
  for t in Float32 Float64; do
    gdal_translate -q -ot $t in.asc strips.tif
    gdal_translate -q -ot $t -co TILED=YES in.asc tiles.tif
    look "$t in strips" strips.tif
    look "$t in tiles" tiles.tif
    maketx strips.tif -o texture.tx
    look "$t by maketx" texture.tx
  done
}
try | tee seen
cat > expected <<'EOF_TXT'
Float32 in strips: largest value by GDAL 4159.000, by OpenImageIO 4159.000000
Float32 in tiles: largest value by GDAL 4159.000, by OpenImageIO 4159.000000
Float32 by maketx: largest value by GDAL 4159.000, by OpenImageIO 4159.000000
Float64 in strips: largest value by GDAL 4159.000, by OpenImageIO 4159.000000
Float64 in tiles: largest value by GDAL 4159.000, by OpenImageIO 0.000000
Float64 by maketx: largest value by GDAL 4159.000, by OpenImageIO 0.000000
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
