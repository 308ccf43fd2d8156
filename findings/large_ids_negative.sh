#!/usr/bin/env bash
# h5wasm makes whole numbers from 2147483648 on negative.
#
# Expected. create_dataset of h5wasm chooses a type if none is given: whole numbers become integers, others doubles.
# A number of JavaScript is exact up to 2^53, so large whole numbers should become 64-bit integers or doubles.
#
# What happens. Each list of whole numbers becomes 32-bit integers, and larger ones lose their upper bits:
# 2147483648 is stored as -2147483648, a time in milliseconds as -807049216, 2^53 - 1 as -1. It is so for attributes
# too. A single fraction in the list makes all of it doubles, and right. So numbers of particles, hashes, seeds and
# times are right in short tests and wrong in long runs. Nothing warns.
#
# Workaround: pass a Float64Array or BigInt64Array, or dtype: '<d' or '<q'.
#
# Seen with h5wasm 0.10.3 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts h5wasm@0.10.3 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import h5, { File } from 'h5wasm/node';
await h5.ready;
const file = new File('numbers.h5', 'w');
const lists = {
  'below 2^31': [2147483647, 1],
  'from 2^31 on': [2147483648, 1],
  'and a fraction': [2147483648, 1.5],
  'and a negative one': [2147483648, -1],
  'milliseconds of a clock': [1700000000000, 1700000000250],
  '2^53 - 1': [9007199254740991],
};
for (const [name, list] of Object.entries(lists)) {
  const set = file.create_dataset({ name, data: list });
  console.log(`${name}: ${list.join(' ')} is stored as ${set.dtype} ${Array.from(set.value).join(' ')}`);
}
file.create_attribute('cells', 3000000000);
console.log(`attribute 3000000000: ${file.attrs.cells.dtype} ${file.attrs.cells.value}`);
for (const dtype of ['<d', '<q', '<I']) {
  const set = file.create_dataset({ name: `as ${dtype}`, data: [2147483648, 1], dtype });
  console.log(`2147483648 1 with dtype ${dtype}: ${Array.from(set.value).join(' ')}`);
}
const typed = file.create_dataset({ name: 'typed', data: Float64Array.of(2147483648, 1) });
console.log(`2147483648 1 in a Float64Array: ${Array.from(typed.value).join(' ')}`);
file.close();
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
below 2^31: 2147483647 1 is stored as <i 2147483647 1
from 2^31 on: 2147483648 1 is stored as <i -2147483648 1
and a fraction: 2147483648 1.5 is stored as <d 2147483648 1.5
and a negative one: 2147483648 -1 is stored as <i -2147483648 -1
milliseconds of a clock: 1700000000000 1700000000250 is stored as <i -807049216 -807048966
2^53 - 1: 9007199254740991 is stored as <i -1
attribute 3000000000: <i -1294967296
2147483648 1 with dtype <d: 2147483648 1
2147483648 1 with dtype <q: 2147483648 1
2147483648 1 with dtype <I: 2147483648 1
2147483648 1 in a Float64Array: 2147483648 1
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
