#!/usr/bin/env bash
# convertBitDepth of image-js makes white grey: 255 becomes 65280 of 65535.
#
# Expected. White is the largest number of each depth, so 255 becomes 65535 in 16 bits: numbers are multiplied by 257,
# as the specification of PNG recommends. On the way back 65535 becomes 255, and the nearest step is taken for others.
#
# What happens. convertBitDepth(16) multiplies by 256: white becomes 65280, which is .9961. convertBitDepth(8) divides
# by 256 and cuts, so all numbers up to 255 become 0. A picture that goes to 16 bits has no white: invert() leaves 255
# in its white places instead of 0, a threshold at the maximum finds nothing, and beside pictures that were made with
# 16 bits it is .4 % darker. The way from 8 to 16 and back to 8 bits gives the same numbers, which hides it. Nothing
# warns.
#
# Workaround: multiply by 257 / 256, as the last line does.
#
# Seen with image-js 1.7.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts image-js@1.7.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { Image } from 'image-js';
const grey = (numbers, bitDepth) => {
  const data = bitDepth === 8 ? Uint8Array.from(numbers) : Uint16Array.from(numbers);
  return new Image(numbers.length, 1, { data, colorModel: 'GREY', bitDepth });
};
const row = (image) => Array.from({ length: image.width }, (_, x) => image.getValue(x, 0, 0)).join(' ');
const bytes = grey([0, 1, 128, 254, 255], 8);
const wide = grey([0, 128, 255, 256, 40000, 65535], 16);
console.log(`8 bits: ${row(bytes)}; as 16 bits: ${row(bytes.convertBitDepth(16))}`);
console.log(`as 16 bits and inverted: ${row(bytes.convertBitDepth(16).invert())}`);
console.log(`and back to 8 bits: ${row(bytes.convertBitDepth(16).convertBitDepth(8))}`);
console.log(`16 bits: ${row(wide)}; as 8 bits: ${row(wide.convertBitDepth(8))}`);
console.log(`and back to 16 bits: ${row(wide.convertBitDepth(8).convertBitDepth(16))}`);
const repaired = bytes.convertBitDepth(16);
for (let x = 0; x < 5; x++) repaired.setValue(x, 0, 0, Math.round((repaired.getValue(x, 0, 0) * 257) / 256));
console.log(`multiplied by 257 / 256: ${row(repaired)}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
8 bits: 0 1 128 254 255; as 16 bits: 0 256 32768 65024 65280
as 16 bits and inverted: 65535 65279 32767 511 255
and back to 8 bits: 0 1 128 254 255
16 bits: 0 128 255 256 40000 65535; as 8 bits: 0 0 0 1 156 255
and back to 16 bits: 0 0 0 256 39936 65280
multiplied by 257 / 256: 0 257 32896 65278 65535
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
