#!/usr/bin/env bash
# One bad part makes a whole union empty in manifold-3d, without an exception.
#
# Expected. A library for solids reports a part that it cannot make where it is made, as manifold-3d does for a mesh
# with holes: it throws. And the union of a part with nothing is the part.
#
# What happens. An outline that runs clockwise, as many with y down do, is empty by the default fill
# rule. extrude() of it, extrude() with a negative height and cube() with a negative side throw nothing: they return a
# body whose status() is InvalidConstruction. Each union or difference with it is empty too: of a thousand good cells
# and a bad one nothing is left, and getMesh() has 0 triangles. An empty body that was made by cutting, with the status
# NoError, leaves unions as they are. hull() drops the bad part and keeps the rest.
#
# Workaround: test status() of each part; new CrossSection(outline, 'NonZero') takes both directions.
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
const { CrossSection, Manifold } = library;
const box = Manifold.cube([1, 2, 3]);
const square = [[9, 0], [10, 0], [10, 1], [9, 1]];
const told = (body) => `volume ${body.volume().toFixed(3)}, ${body.getMesh().numTri} triangles, ${body.status()}`;
console.log(`a box alone: ${told(box)}`);
console.log(`area of a square, counter-clockwise ${new CrossSection(square).area()}, clockwise `
  + `${new CrossSection([...square].reverse()).area()}, clockwise and NonZero `
  + `${new CrossSection([...square].reverse(), 'NonZero').area()}`);
const parts = {
  'a square outline': () => Manifold.extrude([square], 1),
  'a clockwise outline': () => Manifold.extrude([[...square].reverse()], 1),
  'a negative height': () => Manifold.extrude([square], -1),
  'a negative side': () => Manifold.cube([-1, 1, 1]),
  'a box cut to nothing': () => box.trimByPlane([1, 0, 0], 50),
};
for (const [name, make] of Object.entries(parts)) {
  const part = make();
  console.log(`${name}: ${told(part)}`);
  console.log(`  two boxes and this part: ${told(Manifold.union([box, box.translate([5, 0, 0]), part]))}`);
  console.log(`  a box minus this part: ${told(box.subtract(part))}`);
  console.log(`  hull of a box and this part: ${Manifold.hull([box, part]).volume().toFixed(3)}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
a box alone: volume 6.000, 12 triangles, NoError
area of a square, counter-clockwise 1, clockwise 0, clockwise and NonZero 1
a square outline: volume 1.000, 12 triangles, NoError
  two boxes and this part: volume 13.000, 36 triangles, NoError
  a box minus this part: volume 6.000, 12 triangles, NoError
  hull of a box and this part: 34.500
a clockwise outline: volume 0.000, 0 triangles, InvalidConstruction
  two boxes and this part: volume 0.000, 0 triangles, InvalidConstruction
  a box minus this part: volume 0.000, 0 triangles, InvalidConstruction
  hull of a box and this part: 6.000
a negative height: volume 0.000, 0 triangles, InvalidConstruction
  two boxes and this part: volume 0.000, 0 triangles, InvalidConstruction
  a box minus this part: volume 0.000, 0 triangles, InvalidConstruction
  hull of a box and this part: 6.000
a negative side: volume 0.000, 0 triangles, InvalidConstruction
  two boxes and this part: volume 0.000, 0 triangles, InvalidConstruction
  a box minus this part: volume 0.000, 0 triangles, InvalidConstruction
  hull of a box and this part: 6.000
a box cut to nothing: volume 0.000, 0 triangles, NoError
  two boxes and this part: volume 12.000, 24 triangles, NoError
  a box minus this part: volume 6.000, 12 triangles, NoError
  hull of a box and this part: 6.000
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
