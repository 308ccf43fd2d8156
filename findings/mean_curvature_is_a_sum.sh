#!/usr/bin/env bash
# The mean curvature of manifold-3d is twice the mean.
#
# Expected. The mean curvature of a surface is the mean of its two principal curvatures: 1 / r for a sphere of radius r,
# and 1 / (2 r) for a cylinder. The Gaussian curvature is their product, 1 / r^2 for the sphere.
#
# What happens. calculateCurvature(gaussian, mean) stores the product, and under the name of the mean it stores the sum:
# 2 / r for the sphere, 1 / r for the cylinder. One sentence of the reference says so. The principal curvatures that
# follow from the usual formula, H + sqrt(H^2 - K) and H - sqrt(H^2 - K), are 3.73 / r and .27 / r on a sphere, where
# both are 1 / r, and a growth that follows the mean curvature is twice as fast. Nothing warns.
#
# Workaround: halve it.
#
# Seen with manifold-3d 3.5.4 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts manifold-3d@3.5.4 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import start from 'manifold-3d';
const library = await start();
library.setup();
const { Manifold } = library;
// The means of both curvatures over the vertices that are at most 3 away from the middle in z.
function curvatures(body, middle) {
  const { numProp, vertProperties } = body.calculateCurvature(0, 1).getMesh();
  const sum = [0, 0, 0];
  for (let i = 0; i < vertProperties.length; i += numProp) {
    if (Math.abs(vertProperties[i + 2] - middle) > 3) continue;
    [1, vertProperties[i + 3], vertProperties[i + 4]].forEach((v, k) => { sum[k] += v; });
  }
  return `Gaussian ${Math.abs(sum[1] / sum[0]).toFixed(2)}, mean ${(sum[2] / sum[0]).toFixed(2)}`;
}
for (const r of [1, 2]) console.log(`sphere of radius ${r}: ${curvatures(Manifold.sphere(r, 128), 0)}`);
console.log(`cylinder of radius 2: ${curvatures(Manifold.cylinder(20, 2, 2, 128).refineToLength(0.3), 10)}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
sphere of radius 1: Gaussian 1.00, mean 2.00
sphere of radius 2: Gaussian 0.25, mean 1.00
cylinder of radius 2: Gaussian 0.00, mean 0.50
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
