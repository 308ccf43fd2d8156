#!/usr/bin/env bash
# Four readers of Radiance pictures see four different brightnesses.
#
# Expected. A pixel of a Radiance .hdr file has three mantissas of 8 bits and a common exponent e; its colour is the
# mantissa times 2 to the power e - 136. So 128 with e = 129 is 1, and 0 is 0. Radiance itself adds .5 to the mantissa,
# as the middle of the step that was cut off. Both are in use; a writer that divides by 256 and cuts off fits both.
#
# What happens. OpenImageIO reads 1, libvips 1.0039 (it adds .5), three.js 1.0039 as well (it divides by 255), hdrify
# 1.0078 (it does both). The difference is small for white, but with .5 a dark channel of a bright pixel is 25 %
# brighter, and 0 does not stay 0: pure red is not pure any more. Written and read again, a picture becomes brighter
# each time if writer and reader do not match. If numbers matter, as for a field, the same file gives four fields.
#
# Workaround: use EXR or PFM for numbers.
#
# Seen with openimageio-tools 2.4.7.1 and libvips-tools 8.14.1 of Debian 12, three 0.187.0 and hdrify 1.2.1 (npm),
# Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
for p in openimageio-tools=2.4.7.1 libvips-tools=8.14.1; do
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
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 hdrify@1.2.1 ||
  { echo "npm could not install the packages"; exit 2; }
python3 - <<'EOF_PY'
# One pixel: red 128, green 2, blue 0, exponent 129.
open("a.hdr", "wb").write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + bytes([128, 2, 0, 129]))
EOF_PY
cat > try.js <<'EOF_JS'
import fs from 'node:fs';
import { FloatType } from 'three';
import { HDRLoader } from 'three/examples/jsm/loaders/HDRLoader.js';
import { readHdr } from 'hdrify';
const file = fs.readFileSync('a.hdr');
const show = (name, data) => console.log(`${name}: ${[...data].slice(0, 3).map((x) => x.toFixed(4)).join(' ')}`);
show('three', new HDRLoader().setDataType(FloatType).parse(new Uint8Array(file).buffer).data);
show('hdrify', readHdr(new Uint8Array(file)).data);
const raw = fs.readFileSync('vips.raw');
show('libvips', [0, 4, 8].map((i) => raw.readFloatLE(i)));
EOF_JS
vips rad2float a.hdr vips.v
vips rawsave vips.v vips.raw
{
  oiiotool a.hdr --printstats | awk '/Stats Min/ { printf "OpenImageIO: %.4f %.4f %.4f\n", $3, $4, $5 }'
  node try.js
} | tee seen
cat > expected <<'EOF_TXT'
OpenImageIO: 1.0000 0.0156 0.0000
three: 1.0039 0.0157 0.0000
hdrify: 1.0078 0.0196 0.0039
libvips: 1.0039 0.0195 0.0039
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
