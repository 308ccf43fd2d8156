#!/usr/bin/env bash
# ndarray-gradient returns minus the gradient.
#
# Expected. The gradient of f(x) = x is 1. The package promises a "2-point central finite difference", which
# everybody writes as (f(x+1) - f(x-1)) / 2.
#
# What happens. ndarray-gradient computes (f(x-1) - f(x+1)) / 2 with each of its boundary conditions. Its own example
# shows this: the gradient to the left of a bump is negative. Magnitudes are right, so edges of pictures look right,
# but cells that should climb a gradient run away from it, and normals of a height field are tilted to the wrong side.
#
# Workaround: negate the result.
#
# Seen with ndarray 1.1.1, ndarray-gradient 1.0.1 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts ndarray@1.1.1 ndarray-gradient@1.0.1 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import ndarray from 'ndarray';
import gradient from 'ndarray-gradient';
const rising = ndarray(Float64Array.from([0, 1, 2, 3, 4, 5]), [6]);
for (const border of ['clamp', 'mirror', 'wrap']) {
  const slopes = ndarray(new Float64Array(6), [6, 1]);
  gradient(slopes, rising, border);
  console.log(`gradient of 0 1 2 3 4 5, ${border}: ${slopes.data.join(' ')}`);
}
const plane = ndarray(Float64Array.from({ length: 25 }, (_, i) => 10 * Math.floor(i / 5) + i % 5), [5, 5]);
const both = ndarray(new Float64Array(50), [5, 5, 2]);
gradient(both, plane);
console.log(`gradient of 10 x + y in the middle: ${both.get(2, 2, 0)} ${both.get(2, 2, 1)}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
gradient of 0 1 2 3 4 5, clamp: -0.5 -1 -1 -1 -1 -0.5
gradient of 0 1 2 3 4 5, mirror: 0 -1 -1 -1 -1 0
gradient of 0 1 2 3 4 5, wrap: 2 -1 -1 -1 -1 2
gradient of 10 x + y in the middle: -10 -1
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
