#!/usr/bin/env bash
# STLExporter, OBJExporter and PLYExporter of three.js write the seed instead of the grown shape.
#
# Expected. The exporters write what stands in the scene. They apply the position, the turn and the scale of a mesh.
# A growing shape is a mesh with a morph target, and morphTargetInfluences tell how far it has grown; a pattern of
# many equal cells is an InstancedMesh; a curve that is drawn step by step has a draw range. Box3.setFromObject(mesh,
# true) knows the first two.
#
# What happens. Of a box of width 1 that has grown to 5, the three exporters write a box of width 1. Of three boxes in
# a row from 4.5 to 25.5 they write one box, at the origin, where no box is drawn. Of a mesh with two triangles in its
# draw range they write all twelve. Nothing warns, and the files are valid: a print is the seed, not the plant.
#
# Workaround: bake the growth into a clone of the geometry, from computeMorphedAttributes of BufferGeometryUtils, as
# in the last lines; make one mesh for each instance; cut the index to the draw range.
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
import { Box3, BoxGeometry, Float32BufferAttribute, InstancedMesh, Matrix4, Mesh } from 'three';
import { OBJExporter } from 'three/addons/exporters/OBJExporter.js';
import { PLYExporter } from 'three/addons/exporters/PLYExporter.js';
import { STLExporter } from 'three/addons/exporters/STLExporter.js';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';
import { computeMorphedAttributes } from 'three/addons/utils/BufferGeometryUtils.js';
const formats = {
  STL: (mesh) => new STLLoader().parse(new STLExporter().parse(mesh)),
  OBJ: (mesh) => new OBJLoader().parse(new OBJExporter().parse(mesh)).children[0].geometry,
  PLY: (mesh) => new PLYLoader().parse(new PLYExporter().parse(mesh, undefined, {})),
};
function grown() {
  const geometry = new BoxGeometry(1, 1, 1);
  const growth = Array.from(geometry.attributes.position.array, (v) => 4 * v);
  geometry.morphAttributes.position = [new Float32BufferAttribute(growth, 3)];
  geometry.morphTargetsRelative = true;
  const mesh = new Mesh(geometry);
  mesh.morphTargetInfluences[0] = 1;
  return mesh;
}
function row() {
  const mesh = new InstancedMesh(new BoxGeometry(1, 1, 1), undefined, 3);
  for (let i = 0; i < 3; i++) mesh.setMatrixAt(i, new Matrix4().makeTranslation(5 + 10 * i, 0, 0));
  return mesh;
}
function begun() {
  const mesh = new Mesh(new BoxGeometry(1, 1, 1));
  mesh.geometry.setDrawRange(0, 6);
  return mesh;
}
function baked() {
  const mesh = grown();
  const geometry = mesh.geometry.clone();
  geometry.setAttribute('position', computeMorphedAttributes(mesh).morphedPositionAttribute);
  geometry.morphAttributes = {};
  return new Mesh(geometry);
}
const meshes = { 'grown from 1 to 5': grown, 'three instances': row, 'two of twelve triangles': begun, 'baked': baked };
for (const [name, make] of Object.entries(meshes)) {
  const mesh = make();
  mesh.updateMatrixWorld(true);
  const { min, max } = new Box3().setFromObject(mesh, true);
  console.log(`${name}: x from ${min.x} to ${max.x} in the scene`);
  for (const [format, roundTrip] of Object.entries(formats)) {
    const geometry = roundTrip(mesh);
    geometry.computeBoundingBox();
    const box = geometry.boundingBox;
    const corners = geometry.index ? geometry.index.count : geometry.attributes.position.count;
    console.log(`  ${format}: x from ${box.min.x} to ${box.max.x}, ${corners / 3} triangles`);
  }
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
grown from 1 to 5: x from -2.5 to 2.5 in the scene
  STL: x from -0.5 to 0.5, 12 triangles
  OBJ: x from -0.5 to 0.5, 12 triangles
  PLY: x from -0.5 to 0.5, 12 triangles
three instances: x from 4.5 to 25.5 in the scene
  STL: x from -0.5 to 0.5, 12 triangles
  OBJ: x from -0.5 to 0.5, 12 triangles
  PLY: x from -0.5 to 0.5, 12 triangles
two of twelve triangles: x from -0.5 to 0.5 in the scene
  STL: x from -0.5 to 0.5, 12 triangles
  OBJ: x from -0.5 to 0.5, 12 triangles
  PLY: x from -0.5 to 0.5, 12 triangles
baked: x from -2.5 to 2.5 in the scene
  STL: x from -2.5 to 2.5, 12 triangles
  OBJ: x from -2.5 to 2.5, 12 triangles
  PLY: x from -2.5 to 2.5, 12 triangles
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
