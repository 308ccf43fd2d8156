#!/usr/bin/env bash
# glTF-Transform adds the position of a node to the morph targets of its mesh, so the shape moves twice.
#
# Expected. clearNodeTransform() moves the transform of a node into its mesh, and says that it changes the vertices of
# the mesh and its morph targets, so that the scene looks the same. In glTF 2.0 the POSITION of a morph target is a
# difference (section on morph targets): a difference is scaled and turned with the mesh, but not moved.
#
# What happens. transformPrimitive(), and with it transformMesh() and clearNodeTransform(), applies the whole matrix to
# the differences. Scales and turns are right. But each target adds the position of the node once more, times its
# weight: a mesh of a node at x = 10 that should grow upwards also slides from x = 10 to x = 20 as it grows. At weight 0
# everything is right, and the file is valid.
#
# Workaround: clear only the scale and the rotation, and leave the translation in the node, as in the last lines of the
# output.
#
# Seen with @gltf-transform/core and functions 4.5.1 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts @gltf-transform/core@4.5.1 @gltf-transform/functions@4.5.1 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { Document } from '@gltf-transform/core';
import { clearNodeTransform } from '@gltf-transform/functions';
// A node with one triangle; its morph target lifts the three corners by 1 in y.
function scene(place) {
  const file = new Document(), buffer = file.createBuffer();
  const points = (list) => file.createAccessor().setType('VEC3').setArray(new Float32Array(list)).setBuffer(buffer);
  const target = file.createPrimitiveTarget().setAttribute('POSITION', points([0, 1, 0, 0, 1, 0, 0, 1, 0]));
  const triangle = file.createPrimitive().setAttribute('POSITION', points([1, 0, 0, 2, 0, 0, 1, 1, 0]));
  triangle.addTarget(target);
  const node = file.createNode().setMesh(file.createMesh().addPrimitive(triangle));
  file.createScene().addChild(node);
  place(node);
  return node;
}
// The first corner in the scene, by the glTF standard: matrix of the node * (POSITION + weight * difference).
function corner(node, weight) {
  const triangle = node.getMesh().listPrimitives()[0];
  const at = triangle.getAttribute('POSITION').getElement(0, []);
  const step = triangle.listTargets()[0].getAttribute('POSITION').getElement(0, []);
  const [x, y, z] = at.map((value, i) => value + weight * step[i]), m = node.getMatrix();
  return [0, 1, 2].map((i) => Math.round(100 * (m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i])) / 100).join(' ');
}
function show(name, place, clear = clearNodeTransform) {
  const node = scene(place), weights = [0, 0.5, 1], path = () => weights.map((w) => corner(node, w)).join(', ');
  const before = path();
  clear(node);
  console.log(`${name}, weights 0, .5, 1: before ${before}; after ${path()}`);
}
show('scale 2', (node) => node.setScale([2, 2, 2]));
show('turned', (node) => node.setRotation([0, 0, Math.SQRT1_2, Math.SQRT1_2]));
show('at 10 0 0', (node) => node.setTranslation([10, 0, 0]));
const both = (node) => node.setTranslation([10, 0, 0]).setScale([2, 2, 2]);
show('at 10 0 0, scale 2', both);
show('the same, translation kept', both, (node) => {
  const place = node.getTranslation();
  clearNodeTransform(node.setTranslation([0, 0, 0]));
  node.setTranslation(place);
});
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
scale 2, weights 0, .5, 1: before 2 0 0, 2 1 0, 2 2 0; after 2 0 0, 2 1 0, 2 2 0
turned, weights 0, .5, 1: before 0 1 0, -0.5 1 0, -1 1 0; after 0 1 0, -0.5 1 0, -1 1 0
at 10 0 0, weights 0, .5, 1: before 11 0 0, 11 0.5 0, 11 1 0; after 11 0 0, 16 0.5 0, 21 1 0
at 10 0 0, scale 2, weights 0, .5, 1: before 12 0 0, 12 1 0, 12 2 0; after 12 0 0, 17 1 0, 22 2 0
the same, translation kept, weights 0, .5, 1: before 12 0 0, 12 1 0, 12 2 0; after 12 0 0, 12 1 0, 12 2 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
