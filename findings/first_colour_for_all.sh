#!/usr/bin/env bash
# USDLoader of three.js paints a whole mesh in the first colour of its list.
#
# Expected. In USD the primvar displayColor holds the colours of a mesh: one, one per face (uniform), one per vertex
# (vertex) or one per corner (faceVarying), as its interpolation says. A pattern on a surface is stored so, and
# usdview shows it. A loader should give each vertex its colour, as the loaders of glTF, PLY and OBJ in three.js do,
# or say that it takes one colour only.
#
# What happens. USDLoader makes a material of the first colour in the list, whatever the interpolation. There is no
# attribute "color", and vertexColors is off. So a pattern of spots is a plain surface, usually in the colour of the
# first vertex: with a blue corner the whole body is blue. It is so for all three kinds of interpolation, with indices
# or without. Nothing warns.
#
# Workaround: glTF with COLOR_0.
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
const colours = {
  constant: '(0, 0, 1)',
  uniform: '(0, 0, 1), (1, 0, 0)',
  vertex: '(0, 0, 1), (1, 0, 0), (1, 1, 0), (0, 1, 0)',
  faceVarying: '(0, 0, 1), (1, 0, 0), (1, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 0)',
};
const show = (name, lines) => {
  const mesh = load(lines);
  console.log(`${name}: colour of the material ${mesh.material.color.getHexString()}, `
    + `attribute color: ${'color' in mesh.geometry.attributes}, `
    + `vertexColors: ${mesh.material.vertexColors}`);
};
for (const [kind, list] of Object.entries(colours)) {
  show(kind, `    color3f[] primvars:displayColor = [${list}] (\n        interpolation = "${kind}"\n    )`);
}
show('vertex, by indices', `    color3f[] primvars:displayColor = [(0, 0, 1), (1, 0, 0)] (
        interpolation = "vertex"
    )
    int[] primvars:displayColor:indices = [1, 0, 1, 0]`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
constant: colour of the material 0000ff, attribute color: false, vertexColors: false
uniform: colour of the material 0000ff, attribute color: false, vertexColors: false
vertex: colour of the material 0000ff, attribute color: false, vertexColors: false
faceVarying: colour of the material 0000ff, attribute color: false, vertexColors: false
vertex, by indices: colour of the material 0000ff, attribute color: false, vertexColors: false
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
