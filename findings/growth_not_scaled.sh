#!/usr/bin/env bash
# Geometries of three.js that are scaled or turned keep their old morph targets.
#
# Expected. applyMatrix4() of BufferGeometry, with scale(), rotateX(), lookAt() and center(), applies a matrix "to the
# geometry"; the documentation recommends them for a change that is made once. Positions, normals and tangents are
# changed. Morph targets belong to the geometry too: they are in its bounding box, and clone() and toNonIndexed() treat
# them.
#
# What happens. The morph targets stay as they were. A model in metres that is scaled to millimetres grows by a
# thousandth of what it should; a model that is turned from z up to y up grows sideways; with absolute targets
# (morphTargetsRelative is false) it shrinks back to its old size and place. There is no warning, and at weight 0
# everything looks right.
#
# Workaround: scale and turn the Mesh, or apply the matrix to each of geometry.morphAttributes.position as well (for
# relative targets without its translation).
#
# Seen with three 0.187.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { BufferGeometry, Float32BufferAttribute, Mesh, Vector3 } from 'three';
// A flat square of 1 m in the plane z = 0. Its morph target is a roof: two corners rise by .5 in z.
function square(relative) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  geometry.morphTargetsRelative = relative;
  const roof = relative ? [0, 0, 0, 0, 0, 0, 0, 0, .5, 0, 0, .5] : [0, 0, 0, 1, 0, 0, 0, 1, .5, 1, 1, .5];
  geometry.morphAttributes.position = [new Float32BufferAttribute(roof, 3)];
  return geometry;
}
// The last corner as three.js draws it, with the weight 1.
function corner(mesh) {
  mesh.morphTargetInfluences = [1];
  mesh.updateMatrixWorld();
  return mesh.getVertexPosition(3, new Vector3()).applyMatrix4(mesh.matrixWorld).toArray()
    .map((x) => Math.round(100 * x) / 100 + 0).join(' ');
}
for (const relative of [true, false]) {
  const kind = relative ? 'relative' : 'absolute';
  for (const [name, change] of [['scaled by 1000', (g) => g.scale(1000, 1000, 1000)],
    ['turned by rotateX', (g) => g.rotateX(-Math.PI / 2)]]) {
    const whole = new Mesh(square(relative));
    change({ scale: (...s) => whole.scale.set(...s), rotateX: (a) => whole.rotateX(a) });
    const geometry = square(relative);
    change(geometry);
    console.log(`${kind} target, ${name}: corner by the Mesh ${corner(whole)}, `
      + `by the geometry ${corner(new Mesh(geometry))}`);
  }
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
relative target, scaled by 1000: corner by the Mesh 1000 1000 500, by the geometry 1000 1000 0.5
relative target, turned by rotateX: corner by the Mesh 1 0.5 -1, by the geometry 1 0 -0.5
absolute target, scaled by 1000: corner by the Mesh 1000 1000 500, by the geometry 1 1 0.5
absolute target, turned by rotateX: corner by the Mesh 1 0.5 -1, by the geometry 1 1 0.5
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
