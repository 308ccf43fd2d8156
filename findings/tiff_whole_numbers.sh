#!/usr/bin/env bash
# geotiff.js writes signed whole numbers as single bytes.
#
# Expected. writeArrayBuffer() of geotiff takes a typed array and writes it with the size and the kind of its
# numbers. It does so for floats, bytes and unsigned numbers of 16 and 32 bits.
#
# What happens. For an Int16Array or Int32Array it writes the tags of 16 or 32 signed bits, but each number takes
# only one byte, modulo 256. Read back, 1 -2 300 -400 become 510 11376 0 0: two numbers share one pixel, and the
# second half of the picture is 0. Counts of cells, labels of regions and height maps with negative values are
# lost. There is no error, also not if BitsPerSample and SampleFormat are given.
#
# Workaround: write a Float32Array, exact up to 2 to the 24, or add an offset and write unsigned numbers.
#
# Seen with geotiff 3.0.5 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts geotiff@3.0.5 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { writeArrayBuffer, fromArrayBuffer } from 'geotiff';
async function show(values, more = {}) {
  const file = await fromArrayBuffer(await writeArrayBuffer(values, { width: 2, height: 2, ...more }));
  const [read] = await (await file.getImage()).readRasters();
  console.log(`${values.constructor.name} ${values.join(' ')} -> ${read.constructor.name} ${read.join(' ')}`);
}
await show(Float32Array.from([1, -2, 300, -400]));
await show(Uint16Array.from([1, 2, 300, 400]));
await show(Uint32Array.from([1, 2, 300, 70000]));
await show(Int8Array.from([1, -2, 30, -40]));
await show(Int16Array.from([1, -2, 300, -400]));
await show(Int16Array.from([1, -2, 300, -400]), { BitsPerSample: [16], SampleFormat: [2] });
await show(Int32Array.from([1, -2, 300, -400]));
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
Float32Array 1 -2 300 -400 -> Float32Array 1 -2 300 -400
Uint16Array 1 2 300 400 -> Uint16Array 1 2 300 400
Uint32Array 1 2 300 70000 -> Uint32Array 1 2 300 70000
Int8Array 1 -2 30 -40 -> Int8Array 1 -2 30 -40
Int16Array 1 -2 300 -400 -> Int16Array 510 11376 0 0
Int16Array 1 -2 300 -400 -> Int16Array 510 11376 0 0
Int32Array 1 -2 300 -400 -> Int32Array 33434736 0 0 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
