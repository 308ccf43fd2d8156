#!/usr/bin/env bash
# The interpreter of wgsl_reflect computes other hashes than a graphics processor.
#
# Expected. WgslExec and WgslDebug of wgsl_reflect run WGSL kernels in JavaScript, so that one can step through them
# or test them without a graphics processor. WGSL defines whole numbers exactly: u32 is computed modulo 2^32, >> of a
# u32 fills up with zeros, and round(2.5) is 2, the even neighbour.
#
# What happens. A product of two u32 is computed as a double, which has 53 bits: the lower bits of large products are
# rounded away, and 2654435769 * 747796405 becomes 3729788672 instead of 3729788621. >> takes each u32 for a signed
# number, so from 2^31 on ones come in from the left: this product >> 16 becomes 4294958672 instead of 56912. Both are
# steps of all common hashes, so noise and random starts differ from those of the device in almost every cell. round()
# takes halves up: 2.5 becomes 3. Sums wrap as they should, and small numbers are right, so simple tests pass.
#
# Workaround: multiply in two halves of 16 bits, and clear the upper bits after a shift with & (last lines).
#
# Seen with wgsl_reflect 1.6.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts wgsl_reflect@1.6.0 ||
  { echo "npm could not install the package"; exit 2; }
cat > try.js <<'EOF_JS'
import { WgslExec, WgslParser } from 'wgsl_reflect/wgsl_reflect.module.js';
const kernel = `
@group(0) @binding(0) var<storage, read_write> words: array<u32>;
@group(0) @binding(1) var<storage, read_write> numbers: array<f32>;
@compute @workgroup_size(1) fn main() {
  let a: u32 = 2654435769u;
  let b: u32 = 747796405u;
  words[0] = a + a;
  words[1] = a >> 5u;
  words[2] = a * b;
  words[3] = (a * b) >> 16u;
  let c: u32 = a * b;
  words[4] = c >> 16u;
  let low: u32 = a * (b & 65535u);
  let high: u32 = a * (b >> 16u);
  words[5] = low + (high << 16u);
  words[6] = (words[5] >> 16u) & 65535u;
  numbers[0] = round(2.5);
  numbers[1] = round(3.5);
}`;
const words = new Uint32Array(8);
const numbers = new Float32Array(4);
new WgslExec(new WgslParser().parse(kernel)).dispatchWorkgroups('main', 1, { 0: { 0: words, 1: numbers } });
const [a, b] = [2654435769n, 747796405n];
const right = [(2n * a) % 2n ** 32n, a >> 5n, (a * b) % 2n ** 32n];
right.push(right[2] >> 16n, right[2] >> 16n, right[2], right[2] >> 16n);
['a + a', 'a >> 5', 'a * b', '(a * b) >> 16', 'c = a * b, c >> 16', 'a * b in halves', 'the same, >> 16, & 65535']
  .forEach((text, i) => console.log(`${text}: ${words[i]}, right is ${right[i]}`));
console.log(`round(2.5): ${numbers[0]}, right is 2; round(3.5): ${numbers[1]}, right is 4`);
EOF_JS
timeout 60 node try.js | tee seen
cat > expected <<'EOF_TXT'
a + a: 1013904242, right is 1013904242
a >> 5: 4243700685, right is 82951117
a * b: 3729788672, right is 3729788621
(a * b) >> 16: 4294958672, right is 56912
c = a * b, c >> 16: 4294958672, right is 56912
a * b in halves: 3729788621, right is 3729788621
the same, >> 16, & 65535: 56912, right is 56912
round(2.5): 3, right is 2; round(3.5): 4, right is 4
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
