#!/usr/bin/env bash
# numjs computes with the type of the first array, so whole numbers swallow fractions.
#
# Expected. numjs has the functions of numpy under their names. The sum of an array of whole numbers and an array of
# floats is an array of floats, and so is a quotient: numpy takes the type that holds both.
#
# What happens. The result has the type of the first operand. int32 1 2 plus .5 .5 is 1 2, while .5 .5 plus 1 2 is 1.5
# 2.5: a sum depends on the order of its terms. Counts divided by 2 are 0 1 1 2, growth by a factor of 1.4 does
# nothing to a count of 1 or 2, and bytes turn over at 256. The mean is a float. Nothing warns. Arrays from lists have
# the type "array", which holds any number, so the same code is right with small tests and wrong with data that was
# read from a picture (uint8) or a file.
#
# Workaround: astype, or nj.array(list, 'float64'), before computing.
#
# Seen with @d4c/numjs 0.17.35 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts @d4c/numjs@0.17.35 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import module from '@d4c/numjs';
const nj = module.default ?? module;
const show = (name, a) => console.log(`${name}: ${a.tolist().join(' ')} (${a.dtype})`);
const counts = nj.array([1, 2, 3, 4], 'int32');
const halves = nj.array([0.5, 0.5, 0.5, 0.5], 'float64');
show('counts + halves', counts.add(halves));
show('halves + counts', halves.add(counts));
show('counts / 2', counts.divide(2));
show('nj.multiply(counts, 1.4)', nj.multiply(counts, 1.4));
show('uint8 250 + 10', nj.array([250], 'uint8').add(10));
console.log(`mean of counts: ${nj.mean(counts)}`);
show('a list 1 2 3 4, / 2', nj.array([1, 2, 3, 4]).divide(2));
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
counts + halves: 1 2 3 4 (int32)
halves + counts: 1.5 2.5 3.5 4.5 (float64)
counts / 2: 0 1 1 2 (int32)
nj.multiply(counts, 1.4): 1 2 4 5 (int32)
uint8 250 + 10: 4 (uint8)
mean of counts: 2.5
a list 1 2 3 4, / 2: 0.5 1 1.5 2 (array)
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
