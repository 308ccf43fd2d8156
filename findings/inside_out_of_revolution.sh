#!/usr/bin/env bash
# JSCAD and manifold-3d turn bodies of revolution inside out, so a union takes away.
#
# Expected. A profile that turns about an axis sweeps the same ring whether it lies on the right of the axis or on the
# left, and whether it turns by 180 or by -180 degrees. JSCAD takes profiles on the left, and cuts those that lie
# across the axis; extrudeLinear of both libraries gives a positive volume or refuses.
#
# What happens. extrudeRotate of JSCAD gives a ring with its inside outside if the profile is on the left: the volume
# is -122.5 instead of 122.5. A cube minus this ring is the ring, and the union of the rings from left and right is
# nothing. extrudeFromSlices does the same if the slices go down. revolve of manifold-3d does so for a negative angle:
# the union with a far cube has a volume of -61.8, a block minus the body is larger than the block, and status() is
# NoError. JSCAD turns by negative angles correctly; manifold-3d makes a profile on the left empty. Nothing warns.
#
# Workaround: mirror profiles to the right, order slices upwards, turn by positive angles and rotate the body.
#
# Seen with @jscad/modeling 2.13.0 and manifold-3d 3.5.4 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts @jscad/modeling@2.13.0 manifold-3d@3.5.4 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import jscad from '@jscad/modeling';
import start from 'manifold-3d';
const { booleans, extrusions, geometries, maths, primitives, transforms } = jscad;
const { CrossSection, Manifold } = await start().then((library) => { library.setup(); return library; });
// The volume that the polygons enclose; positive if their corners run counter-clockwise as seen from outside.
function volume(body) {
  let sum = 0;
  for (const { vertices } of geometries.geom3.toPolygons(body)) {
    for (let i = 2; i < vertices.length; i++) {
      const [a, b, c] = [vertices[0], vertices[i - 1], vertices[i]];
      sum += maths.vec3.dot(a, maths.vec3.cross(maths.vec3.create(), b, c)) / 6;
    }
  }
  return sum.toFixed(1);
}
const profile = (x) => transforms.translate([x, 0, 0], primitives.square({ size: 2 }));
const ring = (x, angle = 2 * Math.PI) => extrusions.extrudeRotate({ segments: 16, angle }, profile(x));
const cube = primitives.cuboid({ size: [20, 20, 20] });
for (const x of [5, -5]) {
  console.log(`JSCAD, profile at x = ${x}: ring ${volume(ring(x))}, half ${volume(ring(x, Math.PI))}, `
    + `backwards ${volume(ring(x, -Math.PI))}, cube minus ring ${volume(booleans.subtract(cube, ring(x)))}`);
}
console.log(`JSCAD, union of both rings: ${volume(booleans.union(ring(5), ring(-5)))}`);
const square = geometries.geom2.toSides(primitives.square({ size: 2 }));
for (const step of [1, -1]) {
  const move = (i) => maths.mat4.fromTranslation(maths.mat4.create(), [0, 0, i * step]);
  const callback = (_, i) => extrusions.slice.transform(move(i), extrusions.slice.fromSides(square));
  const tower = extrusions.extrudeFromSlices({ numberOfSlices: 3, callback }, geometries.geom2.create());
  console.log(`JSCAD, three slices in steps of ${step}: ${volume(tower)}`);
}
const block = Manifold.cube([40, 40, 40], true);
const far = Manifold.cube([1, 1, 1]).translate([50, 0, 0]);
for (const [x, angle] of [[5, 180], [5, -180], [-5, 180]]) {
  const body = Manifold.revolve(CrossSection.square([2, 2], true).translate([x, 0]), 64, angle);
  console.log(`manifold-3d, profile at x = ${x}, ${angle} degrees: ${body.volume().toFixed(1)}, ${body.status()}, `
    + `with a cube of 1 ${far.add(body).volume().toFixed(1)}, `
    + `64000 minus it ${block.subtract(body).volume().toFixed(1)}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
JSCAD, profile at x = 5: ring 122.5, half 61.2, backwards 61.2, cube minus ring 7877.5
JSCAD, profile at x = -5: ring -122.5, half -61.2, backwards -61.2, cube minus ring 122.5
JSCAD, union of both rings: 0.0
JSCAD, three slices in steps of 1: 8.0
JSCAD, three slices in steps of -1: -8.0
manifold-3d, profile at x = 5, 180 degrees: 62.8, NoError, with a cube of 1 63.8, 64000 minus it 63937.2
manifold-3d, profile at x = 5, -180 degrees: -62.8, NoError, with a cube of 1 -61.8, 64000 minus it 64062.8
manifold-3d, profile at x = -5, 180 degrees: 0.0, InvalidConstruction, with a cube of 1 0.0, 64000 minus it 0.0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
