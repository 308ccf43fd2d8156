#!/usr/bin/env bash
# Jimp reads TIFF files of 32-bit floats as four different pictures.
#
# Expected. TIFF stores grey or RGB floats, and its first two bytes name the byte order; both orders are valid (TIFF
# 6.0, section 2 and SampleFormat). Jimp, and utif2 by which it reads TIFF files, should show 0 as black and 1 as white
# in each of them, cut what lies beyond, or refuse.
#
# What happens. Grey in little-endian order: 0 to 1 is right, but what lies beyond is taken modulo 256, so 1.01 is
# black and -.01 is white: specks on the crests and in the troughs of a pattern. Grey in big-endian order: black. RGB
# in little-endian order: black. RGB in big-endian order: right, but with the curve of sRGB, so .25 is 137 instead of
# 64. Nothing warns. 16-bit pictures are right in each case, and the package tiff reads the numbers of all these files.
#
# Workaround: the package tiff, or 16-bit pictures.
#
# Seen with jimp 1.6.1, utif2 4.1.0 and tiff 7.1.3 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts jimp@1.6.1 utif2@4.1.0 tiff@7.1.3 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { Jimp } from 'jimp';
import { decode } from 'tiff';
// A TIFF file of one row without compression. The numbers have the type 'float', 32 bits, or 'word', 16 bits.
function write(numbers, type, bits, channels, little) {
  const place = 200, size = bits / 8;
  const view = new DataView(new ArrayBuffer(place + numbers.length * size));
  const tags = [[256, numbers.length / channels], [257, 1], [258, bits], [259, 1], [262, channels === 1 ? 1 : 2],
    [273, place], [277, channels], [278, 1], [279, numbers.length * size], [339, type === 'float' ? 3 : 1]];
  view.setUint16(0, little ? 0x4949 : 0x4d4d);
  view.setUint16(2, 42, little);
  view.setUint32(4, 8, little);
  view.setUint16(8, tags.length, little);
  tags.forEach(([tag, value], i) => {
    const at = 10 + 12 * i, list = (tag === 258 || tag === 339) && channels > 1;
    view.setUint16(at, tag, little);
    view.setUint16(at + 2, 3, little);
    view.setUint32(at + 4, list ? channels : 1, little);
    view.setUint16(at + 8, value, little);
    if (list) {
      view.setUint32(at + 8, tag === 258 ? 150 : 160, little);
      for (let c = 0; c < channels; ++c) view.setUint16((tag === 258 ? 150 : 160) + 2 * c, value, little);
    }
  });
  numbers.forEach((x, i) => {
    const at = place + i * size;
    if (type === 'word') view.setUint16(at, x, little);
    else view.setFloat32(at, x, little);
  });
  return view.buffer;
}
const floats = [0, 0.25, 0.5, 1, 1.01, -0.01];
for (const [type, bits] of [['word', 16], ['float', 32]]) {
  const numbers = type === 'float' ? floats : [0, 16384, 32768, 65535];
  console.log(`${type}s of ${bits} bits: ${numbers.join(' ')}`);
  for (const channels of [1, 3]) {
    for (const little of [true, false]) {
      const file = write(numbers.flatMap((x) => Array(channels).fill(x)), type, bits, channels, little);
      const read = [...decode(file)[0].data].filter((_, i) => i % channels === 0);
      const same = read.every((x, i) => Math.fround(x) === Math.fround(numbers[i]));
      const picture = [...(await Jimp.fromBuffer(Buffer.from(file))).bitmap.data].filter((_, i) => i % 4 === 0);
      console.log(`  ${channels === 1 ? 'grey' : 'RGB'}, ${little ? 'little' : 'big'}-endian: `
        + `Jimp ${picture.join(' ')}; tiff ${same ? 'reads the numbers' : 'differs'}`);
    }
  }
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
words of 16 bits: 0 16384 32768 65535
  grey, little-endian: Jimp 0 64 128 255; tiff reads the numbers
  grey, big-endian: Jimp 0 64 128 255; tiff reads the numbers
  RGB, little-endian: Jimp 0 64 128 255; tiff reads the numbers
  RGB, big-endian: Jimp 0 64 128 255; tiff reads the numbers
floats of 32 bits: 0 0.25 0.5 1 1.01 -0.01
  grey, little-endian: Jimp 0 64 128 255 2 254; tiff reads the numbers
  grey, big-endian: Jimp 0 0 0 0 0 0; tiff reads the numbers
  RGB, little-endian: Jimp 0 0 0 0 0 0; tiff reads the numbers
  RGB, big-endian: Jimp 0 137 188 255 255 0; tiff reads the numbers
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
