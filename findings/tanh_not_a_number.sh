#!/usr/bin/env bash
# tanh() of numjs is not a number for large arguments.
#
# Expected. tanh(x) approaches 1. Math.tanh(400) is 1, and so is the result of numpy, which numjs imitates.
#
# What happens. numjs divides exp(2 x) - 1 by exp(2 x) + 1. From x = 355 on both are infinite, and the result is NaN.
# Negative numbers are right: -400 gives -1. Near 0 digits are lost: 1e-17 gives 0. A switch such as tanh(500 (u -
# 1)), which should cut off a reaction or draw the sharp profile of a front, is right below the threshold, and NaN
# where u exceeds it by .71. As NaN spreads with each step of diffusion, the whole field is lost. Nothing warns.
#
# Workaround: clip the argument to -20 to 20, or apply Math.tanh to the list.
#
# Seen with @d4c/numjs 0.17.35 (npm), Node.js 20. numjs 0.16.1, from which it was made, has the same formula.
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
const x = [-400, -1e-17, 1e-17, 1, 354, 355, 400];
console.log(`x: ${x.join(' ')}`);
console.log(`numjs: ${nj.tanh(nj.array(x)).tolist().map((v) => +v.toPrecision(6)).join(' ')}`);
console.log(`Math.tanh: ${x.map((v) => +Math.tanh(v).toPrecision(6)).join(' ')}`);
const u = [0, 0.5, 1, 1.5, 2];
const edge = (f) => f(u.map((v) => 500 * (v - 1)));
console.log(`tanh(500 (u - 1)) for u = ${u.join(' ')}: ${edge((v) => nj.tanh(nj.array(v)).tolist()).join(' ')}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
x: -400 -1e-17 1e-17 1 354 355 400
numjs: -1 0 0 0.761594 1 NaN NaN
Math.tanh: -1 -1e-17 1e-17 0.761594 1 1 1
tanh(500 (u - 1)) for u = 0 0.5 1 1.5 2: -1 -1 0 1 NaN
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
