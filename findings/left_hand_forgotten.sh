#!/usr/bin/env bash
# USDLoader of three.js turns meshes that say leftHanded inside out, and moves those that should stay.
#
# Expected. The attribute orientation of a USD mesh says whether its corners run counter-clockwise as seen from
# outside, rightHanded, the default, or clockwise, leftHanded. Programs with clockwise triangles write the latter, and
# a loader should turn the faces. The list xformOpOrder names the moves and turns that are applied, in their order;
# ops that it does not name have no effect (USD documentation of UsdGeomXformable).
#
# What happens. orientation is ignored: the outside of a leftHanded mesh is not drawn, and its computed normals point
# inwards, so it is dark where light falls on it. A translation that xformOpOrder does not name moves the mesh. The
# order itself is respected, as are upAxis and metersPerUnit. Nothing warns.
#
# Workaround: write rightHanded meshes, and no ops that xformOpOrder does not name.
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
import { USDLoader } from 'three/examples/jsm/loaders/USDLoader.js';
const load = (lines) => {
  const text = `#usda 1.0
(
    defaultPrim = "a"
    metersPerUnit = 1
    upAxis = "Y"
)
def Mesh "a"
{
    int[] faceVertexCounts = [3, 3]
    int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
${lines}
}
`;
  let mesh;
  new USDLoader().parse(text).traverse((object) => { if (object.isMesh) mesh = object; });
  return mesh;
};
const show = (name, lines) => {
  const mesh = load(lines);
  mesh.updateMatrixWorld(true);
  const { position, normal } = mesh.geometry.attributes;
  const corner = mesh.localToWorld(new mesh.position.constructor().fromBufferAttribute(position, 1));
  console.log(`${name}: normal z ${normal.getZ(0)}, corner (1, 0, 0) is at ${corner.toArray().join(' ')}`);
};
show('rightHanded', '    uniform token orientation = "rightHanded"');
show('leftHanded', '    uniform token orientation = "leftHanded"');
const move = '    double3 xformOp:translate = (10, 0, 0)';
const scale = '    float3 xformOp:scale = (2, 1, 1)';
const order = (list) => `    uniform token[] xformOpOrder = [${list.map((op) => `"xformOp:${op}"`).join(', ')}]`;
show('translate, not in xformOpOrder', move);
show('translate, in xformOpOrder', `${move}\n${order(['translate'])}`);
show('xformOpOrder translate, scale', `${move}\n${scale}\n${order(['translate', 'scale'])}`);
show('xformOpOrder scale, translate', `${move}\n${scale}\n${order(['scale', 'translate'])}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
rightHanded: normal z 1, corner (1, 0, 0) is at 1 0 0
leftHanded: normal z 1, corner (1, 0, 0) is at 1 0 0
translate, not in xformOpOrder: normal z 1, corner (1, 0, 0) is at 11 0 0
translate, in xformOpOrder: normal z 1, corner (1, 0, 0) is at 11 0 0
xformOpOrder translate, scale: normal z 1, corner (1, 0, 0) is at 12 0 0
xformOpOrder scale, translate: normal z 1, corner (1, 0, 0) is at 22 0 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
