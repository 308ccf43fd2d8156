#!/usr/bin/env bash
# Simplex noise in three dimensions is three times as strong in one npm package as in another.
#
# Expected. Simplex noise is a published method, with a factor for each dimension that brings its values to -1 to 1.
# simplex-noise keeps to this: in two and in three dimensions the values go close to 1 and no further. The other
# packages follow the same text and should do so as well.
#
# What happens. In two dimensions they do. In three, simplex3 of noisejs ends at .42, since it cuts the corners off at
# another radius and keeps the old factor; its spread is .16 instead of .43. fast-simplex-noise goes to 1.23, and to
# 1.15 in four dimensions: a colour map or a texture of bytes that expects 1 is cut, or turns over to black. Code that
# goes from a picture to a film, with time as the third coordinate, changes its contrast, and a threshold such as .5,
# which covered 14 % of the picture, is never reached.
#
# Workaround: measure the spread once, and divide by it.
#
# Seen with simplex-noise 4.0.3, noisejs 2.1.0, fast-simplex-noise 4.0.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts \
  simplex-noise@4.0.3 noisejs@2.1.0 fast-simplex-noise@4.0.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { createNoise2D, createNoise3D, createNoise4D } from 'simplex-noise';
import noisejs from 'noisejs';
import fast from 'fast-simplex-noise';
let seed = 1;
const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647; // the generator of Park and Miller
const noise = new noisejs.Noise(0.42);
const { makeNoise2D, makeNoise3D, makeNoise4D } = fast.default ?? fast;
const functions = {
  'simplex-noise 2-D': createNoise2D(random),
  'noisejs 2-D': (x, y) => noise.simplex2(x, y),
  'fast-simplex-noise 2-D': makeNoise2D(random),
  'simplex-noise 3-D': createNoise3D(random),
  'noisejs 3-D': (x, y, z) => noise.simplex3(x, y, z),
  'fast-simplex-noise 3-D': makeNoise3D(random),
  'simplex-noise 4-D': createNoise4D(random),
  'fast-simplex-noise 4-D': makeNoise4D(random),
};
for (const [name, f] of Object.entries(functions)) {
  const n = 1000000;
  let largest = 0, squares = 0, above = 0;
  for (let i = 0; i < n; i++) {
    const v = f(random() * 256, random() * 256, random() * 256, random() * 256);
    largest = Math.max(largest, Math.abs(v));
    squares += v * v;
    above += v > 0.5;
  }
  console.log(`${name}: largest ${largest.toFixed(2)}, spread ${Math.sqrt(squares / n).toFixed(2)}, `
    + `above .5: ${(100 * above / n).toFixed(0)} %`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
simplex-noise 2-D: largest 1.00, spread 0.44, above .5: 16 %
noisejs 2-D: largest 1.00, spread 0.44, above .5: 16 %
fast-simplex-noise 2-D: largest 1.00, spread 0.44, above .5: 16 %
simplex-noise 3-D: largest 0.98, spread 0.43, above .5: 14 %
noisejs 3-D: largest 0.42, spread 0.16, above .5: 0 %
fast-simplex-noise 3-D: largest 1.23, spread 0.48, above .5: 16 %
simplex-noise 4-D: largest 0.98, spread 0.30, above .5: 5 %
fast-simplex-noise 4-D: largest 1.15, spread 0.29, above .5: 5 %
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
