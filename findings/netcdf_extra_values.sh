#!/usr/bin/env bash
# netcdfjs appends padding bytes of the file to the values of a variable.
#
# Expected. In the classic netCDF format the values of a variable of bytes or 16-bit numbers are followed by up
# to three bytes of padding, so that the next variable begins at a multiple of four bytes. The field "vsize" of
# the header includes the padding. So a reader should compute the number of values from the dimensions.
#
# What happens. netcdfjs divides "vsize" by the size of a number. A field of 3 x 3 16-bit numbers has ten values,
# a field of 3 x 3 bytes has twelve. Each record of a series of 3 values has four, so the rows of all later records
# are shifted if the values are taken as a flat list. The padding usually contains 0 or the fill value, and looks
# like data. There is no error. Files with 32-bit or 64-bit numbers, or with even widths, are read correctly.
#
# Workaround: cut each variable or record to the product of its dimensions.
#
# Seen with netcdfjs 4.0.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts netcdfjs@4.0.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { NetCDFReader } from 'netcdfjs';
const BYTE = 1, SHORT = 3;
const i32 = (...a) => Buffer.concat(a.map((x) => { const b = Buffer.alloc(4); b.writeInt32BE(x); return b; }));
const pad = (b, fill = 0) => Buffer.concat([b, Buffer.alloc((4 - b.length % 4) % 4, fill)]);
const name = (s) => Buffer.concat([i32(s.length), pad(Buffer.from(s))]);
// A classic file with the dimensions "time" (records; 0 is unlimited) and "x" (3 long), and variables over `over`.
function file(records, variables, over) {
  const size = (type) => type === BYTE ? 1 : 2;
  const blocks = variables.map(([, type, values]) => {
    const b = Buffer.alloc(values.length * size(type));
    values.forEach((v, i) => (type === BYTE ? b.writeInt8(v, i) : b.writeInt16BE(v, 2 * i)));
    return b;
  });
  const each = variables.map(([, type]) => 4 * Math.ceil(size(type) * 3 ** (over.length - (over[0] === 0)) / 4));
  const head = (start) => Buffer.concat([Buffer.from('CDF\x01'), i32(records, 10, 2), name('time'), i32(0), name('x'),
    i32(3, 0, 0, 11, variables.length), ...variables.map(([n, type], k) => Buffer.concat([name(n), i32(over.length),
      i32(...over, 0, 0, type, each[k], start + each.slice(0, k).reduce((a, b) => a + b, 0))]))]);
  const rows = [];
  for (let r = 0; r < Math.max(records, 1); r++)
    for (const b of blocks) rows.push(pad(records ? b.subarray(r * 6, r * 6 + 6) : b));
  const f = Buffer.concat([head(head(0).length), ...rows]);
  return new NetCDFReader(f.buffer.slice(f.byteOffset, f.byteOffset + f.length));
}
const nine = [1, 2, 3, 4, 5, 6, 7, 8, 9];
const fields = file(0, [['shorts', SHORT, nine], ['bytes', BYTE, nine]], [1, 1]);
const series = file(2, [['u', SHORT, [1, 2, 3, 4, 5, 6]], ['v', SHORT, [-1, -2, -3, -4, -5, -6]]], [0, 1]);
for (const v of ['shorts', 'bytes']) console.log(`3 x 3 ${v}: ${fields.getDataVariable(v).join(' ')}`);
for (const v of ['u', 'v'])
  console.log(`2 records of 3, ${v}: ${series.getDataVariable(v).map((r) => r.join(' ')).join(' | ')}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
3 x 3 shorts: 1 2 3 4 5 6 7 8 9 0
3 x 3 bytes: 1 2 3 4 5 6 7 8 9 0 0 0
2 records of 3, u: 1 2 3 0 | 4 5 6 0
2 records of 3, v: -1 -2 -3 0 | -4 -5 -6 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
