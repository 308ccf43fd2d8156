#!/usr/bin/env bash
# The exporters of three.js turn mirrored parts inside out.
#
# Expected. A Mesh with a negative scale is the usual way to make the other half of a symmetric model. three.js turns
# the order of the corners round when it draws such a mesh, so its outside stays outside. An STL file has to list the
# corners counter-clockwise as seen from outside; OBJ and PLY readers take the same order. The exporters apply the
# scale to the corners, so they should turn the order round as well.
#
# What happens. STLExporter, OBJExporter and PLYExporter move the corners and keep their order. So the mirrored half
# has a negative volume, and programs that draw only the outside show its inside. The normals that STLExporter computes
# point inwards too. There is no warning, and on the screen of three.js the part looks right.
#
# Workaround: before the export, put the scale into a clone of the geometry with applyMatrix4(), and swap two corners
# of each triangle.
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
import { BoxGeometry, Mesh, Vector3 } from 'three';
import { OBJExporter } from 'three/addons/exporters/OBJExporter.js';
import { PLYExporter } from 'three/addons/exporters/PLYExporter.js';
import { STLExporter } from 'three/addons/exporters/STLExporter.js';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';
// The volume that the triangles enclose; positive if their corners run counter-clockwise as seen from outside.
function volume(geometry) {
  const list = geometry.index ? geometry.toNonIndexed() : geometry;
  const corner = (i) => new Vector3().fromBufferAttribute(list.attributes.position, i);
  let sum = 0;
  for (let i = 0; i < list.attributes.position.count; i += 3) {
    sum += corner(i).dot(corner(i + 1).cross(corner(i + 2))) / 6;
  }
  return Math.round(1000 * sum) / 1000;
}
const formats = {
  STL: (mesh) => new STLLoader().parse(new STLExporter().parse(mesh)),
  OBJ: (mesh) => new OBJLoader().parse(new OBJExporter().parse(mesh)).children[0].geometry,
  PLY: (mesh) => new PLYLoader().parse(new PLYExporter().parse(mesh, undefined, {})),
};
for (const [name, format] of Object.entries(formats)) {
  for (const scale of [1, -1]) {
    const mesh = new Mesh(new BoxGeometry(1, 2, 3).translate(5, 0, 0));
    mesh.scale.x = scale;
    mesh.updateMatrixWorld(true);
    const geometry = format(mesh);
    geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox;
    console.log(`${name}, scale ${scale}: x from ${min.x} to ${max.x}, volume ${volume(geometry)} instead of 6`);
  }
}
const wing = new Mesh(new BoxGeometry(1, 2, 3).translate(5, 0, 0));
wing.scale.x = -1;
wing.updateMatrixWorld(true);
const [normal, corner] = new STLExporter().parse(wing).match(/(normal|vertex) .*/g);
console.log(`mirrored STL, box from x = -5.5: the first triangle has ${normal}, ${corner}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
STL, scale 1: x from 4.5 to 5.5, volume 6 instead of 6
STL, scale -1: x from -5.5 to -4.5, volume -6 instead of 6
OBJ, scale 1: x from 4.5 to 5.5, volume 6 instead of 6
OBJ, scale -1: x from -5.5 to -4.5, volume -6 instead of 6
PLY, scale 1: x from 4.5 to 5.5, volume 6 instead of 6
PLY, scale -1: x from -5.5 to -4.5, volume -6 instead of 6
mirrored STL, box from x = -5.5: the first triangle has normal 1 0 0, vertex -5.5 1 1.5
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
