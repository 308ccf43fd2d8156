#!/usr/bin/env bash
# One PFM file, three readers, three different pictures.
#
# Expected. A portable float map (Debevec's format, which Netpbm also uses) stores its rows from the bottom to the top.
# The number in the third header line gives the byte order by its sign and a scale of the samples by its magnitude.
# Readers should agree on the order of rows, and should either all use the scale in the same way or all ignore it.
#
# What happens. ffmpeg 5.1.9 reads the first row of the file as the top row. Netpbm and ImageMagick read it as the
# bottom row. With a scale of 2, ImageMagick doubles the samples, Netpbm and ffmpeg halve them. So Netpbm shows the
# picture upright and dark, ImageMagick upright and bright, ffmpeg upside down and dark. ffmpeg also writes the top row
# of a PFM first: what it writes it reads correctly, but the picture is upside down in all other programs.
#
# Workaround: write a scale of 1 or -1 only, and use -vf vflip after ffmpeg reads, or before it writes, a PFM.
#
# Seen with ffmpeg 5.1.9, ImageMagick 6.9.11-60, netpbm 11.01.00 of Debian 12.
set -eu
want='ffmpeg imagemagick-6.q16 netpbm'
if ! command -v ffmpeg >/dev/null || ! command -v convert-im6.q16 >/dev/null || ! command -v pfmtopam >/dev/null; then
  apt-get update -qq >/dev/null 2>&1 || true
  # shellcheck disable=SC2086  # one word a package
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $want >/dev/null 2>&1 ||
    { echo "could not install: $want (Debian 12, as root)"; exit 2; }
fi
for p in ffmpeg=5.1.9 imagemagick-6.q16=6.9.11.60 netpbm=11.01.00; do
  version=$(dpkg-query -W -f '${Version}' "${p%=*}" 2>/dev/null || true)
  case "${version#*:}" in
    "${p#*=}"[-+]*) echo "${p%=*} $version" ;;
    *) echo "this was seen with ${p%=*} ${p#*=}; here it is '${version:-not the one of Debian}'"; exit 2 ;;
  esac
done
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
# 2 x 2 pixels; by the format .2 .2 is the bottom row and .4 .4 the top one.
python3 - <<'EOF_PY'
import struct
for name, scale in ("one", "-1.0"), ("two", "-2.0"):
    with open(name + ".pfm", "wb") as f:
        f.write(b"Pf\n2 2\n" + scale.encode() + b"\n" + struct.pack("<4f", .2, .2, .4, .4))
with open("rows.pgm", "wb") as f:  # a white row above a black one
    f.write(b"P5\n1 2\n255\n" + bytes([255, 0]))
EOF_PY
bytes() { od -An -v -tu1 | tr -s ' \n' ' ' | sed 's/^ //;s/ $//'; }
for f in one two; do
  echo "$f, netpbm:      $(pfmtopam -maxval=255 $f.pfm | tail -c 4 | bytes)"
  echo "$f, ImageMagick: $(convert-im6.q16 $f.pfm -depth 8 gray:- | bytes)"
  echo "$f, ffmpeg:      $(ffmpeg -v error -i $f.pfm -f rawvideo -pix_fmt gray - </dev/null | bytes)"
done > seen
ffmpeg -v error -y -i rows.pgm -pix_fmt grayf32le written.pfm </dev/null
echo "written by ffmpeg, read by netpbm: $(pfmtopam -maxval=255 written.pfm | tail -c 2 | bytes)" >> seen
cat seen
cat > expected <<'EOF_TXT'
one, netpbm:      102 102 51 51
one, ImageMagick: 102 102 51 51
one, ffmpeg:      51 51 102 102
two, netpbm:      51 51 26 26
two, ImageMagick: 204 204 102 102
two, ffmpeg:      26 26 51 51
written by ffmpeg, read by netpbm: 0 255
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
