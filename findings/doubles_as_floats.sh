#!/usr/bin/env bash
# VTKLoader of three.js reads the doubles of binary files as floats.
#
# Expected. A legacy VTK file names the type of its points, float or double. ASCII files of both are read correctly,
# so VTKLoader should read 8 bytes per number in a binary file of doubles, or refuse it, as it refuses types of data
# sets that it does not know.
#
# What happens. It takes 4 bytes per number whatever the type. The first half of the points becomes wrong numbers, 1
# becomes 1.875 and 0, and the second half is not read. Triangles are found, as the loader searches for the word
# POLYGONS, so there is a mesh with the right number of triangles and all its corners in wrong places, most of them
# near 0. Nothing warns. VTK writes doubles whenever its points are doubles, as after many filters.
#
# Workaround: points of floats, by SetDataTypeToFloat of vtkPoints; or ASCII.
#
# Seen with three 0.187.0 (npm), Node.js 20. The loader says that release 194 will remove it.
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
import { VTKLoader } from 'three/examples/jsm/loaders/VTKLoader.js';
console.warn = () => {}; // the note about release 194
const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];
const polygons = [3, 0, 1, 2, 3, 0, 2, 3];
const show = (name, buffer) => {
  const g = new VTKLoader().parse(new Uint8Array(buffer).buffer);
  const position = [...g.attributes.position.array].map((v) => +v.toPrecision(4));
  console.log(`${name}: points ${position.join(' ')}, triangles ${[...g.index.array].join(' ')}`);
};
for (const type of ['float', 'double']) {
  // The title is long since the loader needs files of at least 250 bytes.
  const title = 'a square '.repeat(15);
  const head = (kind) => `# vtk DataFile Version 3.0\n${title}\n${kind}\nDATASET POLYDATA\nPOINTS 4 ${type}\n`;
  show(`ASCII, ${type}`, Buffer.from(`${head('ASCII')}${points.join(' ')}\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\n`));
  const size = type === 'float' ? 4 : 8;
  const numbers = Buffer.alloc(size * points.length);
  points.forEach((v, i) => (size === 4 ? numbers.writeFloatBE(v, 4 * i) : numbers.writeDoubleBE(v, 8 * i)));
  const indices = Buffer.alloc(4 * polygons.length);
  polygons.forEach((v, i) => indices.writeInt32BE(v, 4 * i));
  const parts = [head('BINARY'), numbers, '\nPOLYGONS 2 8\n', indices, '\n'];
  show(`binary, ${type}`, Buffer.concat(parts.map((part) => Buffer.from(part))));
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
ASCII, float: points 0 0 0 1 0 0 1 1 0 0 1 0, triangles 0 1 2 0 2 3
binary, float: points 0 0 0 1 0 0 1 1 0 0 1 0, triangles 0 1 2 0 2 3
ASCII, double: points 0 0 0 1 0 0 1 1 0 0 1 0, triangles 0 1 2 0 2 3
binary, double: points 0 0 0 0 0 0 1.875 0 0 0 0 0, triangles 0 1 2 0 2 3
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
