#!/usr/bin/env bash
# ffmpeg turns a grey picture green when it converts it to float RGB.
#
# Expected. A field that is written as one EXR channel Y (luminance by the OpenEXR standard), as a PGM or as a grey PNG
# has no colour. After conversion to gbrpf32le, the float RGB that the tonemap filter and programs without support for Y
# need, R = G = B should hold, as it does in 8 and 16 bits.
#
# What happens. In ffmpeg 5.1.9 the conversion of grey (8 bits, 16 bits or floats) to gbrpf32le gives green: black
# becomes G = .5, middle grey G = 1 with no red and no blue, white R = .3, G = 1, B = .1. The missing chroma of a grey
# picture seems to be taken as 0, which is green, instead of the middle value, which is grey. There is no warning.
# Common commands are affected: ffmpeg -i grey.exr -vf tonemap out.png, or -pix_fmt gbrpf32le.
#
# Workaround: convert to 16-bit RGB first, -vf format=gbrp16le,format=gbrpf32le (this first conversion is right).
#
# Seen with ffmpeg 5.1.9 of Debian 12.
set -eu
if ! command -v ffmpeg >/dev/null; then
  apt-get update -qq >/dev/null 2>&1 || true
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends ffmpeg >/dev/null 2>&1 ||
    { echo "ffmpeg could not be installed (Debian 12, as root)"; exit 2; }
fi
version=$(dpkg-query -W -f '${Version}' ffmpeg 2>/dev/null || true)
case "${version#*:}" in
  5.1.9[-+]*) echo "ffmpeg $version" ;;
  *) echo "this was seen with ffmpeg 5.1.9; here it is '${version:-not the one of Debian}'"; exit 2 ;;
esac
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 - <<'EOF_PY'
# Three pixels, black, middle grey, white, three times: PGM of 8 bits, PGM of 16 bits, uncompressed EXR with a float Y.
import struct
open("8_bits.pgm", "wb").write(b"P5\n3 1\n255\n" + bytes([0, 128, 255]))
open("16_bits.pgm", "wb").write(b"P5\n3 1\n65535\n" + struct.pack(">3H", 0, 32768, 65535))
def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data
head = struct.pack("<2i", 20000630, 2) + b"".join([
    attribute("channels", "chlist", b"Y\0" + struct.pack("<4i", 2, 0, 1, 1) + b"\0"),
    attribute("compression", "compression", b"\0"),
    attribute("dataWindow", "box2i", struct.pack("<4i", 0, 0, 2, 0)),
    attribute("displayWindow", "box2i", struct.pack("<4i", 0, 0, 2, 0)),
    attribute("lineOrder", "lineOrder", b"\0"),
    attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
    attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
    attribute("screenWindowWidth", "float", struct.pack("<f", 1))]) + b"\0"
open("float.exr", "wb").write(
    head + struct.pack("<q", len(head) + 8) + struct.pack("<2i", 0, 12) + struct.pack("<3f", 0, .5, 1))
EOF_PY
for f in 8_bits.pgm 16_bits.pgm float.exr; do
  for way in gbrp16le gbrpf32le gbrp16le,format=gbrpf32le; do
    ffmpeg -v error -i $f -vf "format=$way" -f rawvideo - </dev/null > raw
    python3 - "$f" "$way" <<'EOF_PY'
import struct, sys
raw = open("raw", "rb").read()
size = len(raw) // 9
v = struct.unpack("<9" + "_ H f"[size], raw)
v = [x / 65535 for x in v] if size == 2 else v
g, b, r = v[:3], v[3:6], v[6:]
print(f"{sys.argv[1]} to {sys.argv[2]}, R G B:", " | ".join("%.1f %.1f %.1f" % p for p in zip(r, g, b)))
EOF_PY
  done
done | tee seen
cat > expected <<'EOF_TXT'
8_bits.pgm to gbrp16le, R G B: 0.0 0.0 0.0 | 0.5 0.5 0.5 | 1.0 1.0 1.0
8_bits.pgm to gbrpf32le, R G B: 0.0 0.5 0.0 | 0.0 1.0 0.0 | 0.3 1.0 0.1
8_bits.pgm to gbrp16le,format=gbrpf32le, R G B: 0.0 0.0 0.0 | 0.5 0.5 0.5 | 1.0 1.0 1.0
16_bits.pgm to gbrp16le, R G B: 0.0 0.0 0.0 | 0.5 0.5 0.5 | 1.0 1.0 1.0
16_bits.pgm to gbrpf32le, R G B: 0.0 0.5 0.0 | 0.0 1.0 0.0 | 0.3 1.0 0.1
16_bits.pgm to gbrp16le,format=gbrpf32le, R G B: 0.0 0.0 0.0 | 0.5 0.5 0.5 | 1.0 1.0 1.0
float.exr to gbrp16le, R G B: 0.0 0.0 0.0 | 0.5 0.5 0.5 | 1.0 1.0 1.0
float.exr to gbrpf32le, R G B: 0.0 0.5 0.0 | 0.0 1.0 0.0 | 0.3 1.0 0.1
float.exr to gbrp16le,format=gbrpf32le, R G B: 0.0 0.0 0.0 | 0.5 0.5 0.5 | 1.0 1.0 1.0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
