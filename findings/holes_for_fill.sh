#!/usr/bin/env bash
# jsfive leaves holes in data sets whose chunks were not all written.
#
# Expected. A chunked HDF5 data set may have chunks that nobody has written: a series of snapshots that is not
# finished, or a field that is filled only where something happens. Readers return the fill value for them, 0 unless
# the file names another (HDF5 file format specification, fill value message), as the HDF5 library does.
#
# What happens. jsfive returns a JavaScript array with holes: these elements do not exist. Reading one gives undefined,
# and arithmetic NaN. But forEach, map, filter and reduce skip holes, so means, minima and histograms leave those cells
# out without a trace: the smallest of 2 2 2 0 0 0 is 2. Nothing warns.
#
# Workaround: Array.from(value, (x) => x ?? 0) with the fill value; or h5wasm, the library itself.
#
# Seen with jsfive 0.4.2 and h5wasm 0.10.3 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts h5wasm@0.10.3 jsfive@0.4.2 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { readFileSync } from 'node:fs';
import h5wasm from 'h5wasm/node';
import { File } from 'jsfive';
await h5wasm.ready;
// Four snapshots of three cells, a chunk each; the second and the fourth are not written.
const file = new h5wasm.File('series.h5', 'w');
const snapshot = new Float32Array([2, 2, 2]);
file.create_dataset({ name: 'u', data: snapshot, shape: [1, 3], maxshape: [null, 3], chunks: [1, 3] });
const series = file.get('u');
series.resize([4, 3]);
series.write_slice([[2, 3], []], snapshot);
file.close();
function show(name, u) {
  const all = Array.from(u, String).join(' ');
  const mean = u.reduce((sum, x) => sum + x, 0) / u.filter(() => true).length;
  const smallest = u.reduce((a, b) => Math.min(a, b));
  console.log(`${name}: ${u.length} numbers, ${all}; u[3] is ${u[3]}, the smallest ${smallest}, the mean ${mean}`);
}
const library = new h5wasm.File('series.h5', 'r');
show('h5wasm', library.get('u').value);
library.close();
const { buffer, byteOffset: start, byteLength: size } = readFileSync('series.h5');
show('jsfive', new File(buffer.slice(start, start + size), 'series.h5').get('u').value);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
h5wasm: 12 numbers, 2 2 2 0 0 0 2 2 2 0 0 0; u[3] is 0, the smallest 0, the mean 1
jsfive: 12 numbers, 2 2 2 undefined undefined undefined 2 2 2 undefined undefined undefined; u[3] is undefined, the smallest 2, the mean 2
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
