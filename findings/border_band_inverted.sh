#!/usr/bin/env bash
# isobands() of Turf fills the hole instead of the band if a band surrounds the field.
#
# Expected. isobands() turns a grid of numbers into one multipolygon per range. Together the ranges cover the grid once.
# A round spot in the middle gives a disc, rings around it, and last a polygon with the border of the grid outside and
# the outermost ring as its hole.
#
# What happens. If all numbers on the border of the grid lie in one range, the outer ring of that range is missing,
# and its hole becomes its polygon. So the background of a spot is the spot itself: it is painted over the spot, an
# area is wrong (706 instead of 894), and the surroundings are in no range. With two spots it is both of them. This is
# the usual case for a pattern that has not yet reached the border. There is no warning. If another range touches the
# border anywhere, all is right.
#
# Workaround: isoBands() of the package marchingsquares, which gives the right areas.
#
# Seen with @turf/isobands 7.4.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts @turf/isobands@7.4.0 @turf/helpers@7.4.0 \
  marchingsquares@1.3.3 || { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { featureCollection, point } from '@turf/helpers';
import { isobands } from '@turf/isobands';
import { isoBands } from 'marchingsquares';
const size = 41, breaks = [0, 5, 15, 60];
const area = (ring) => ring.reduce((sum, [x, y], i) => {
  const [u, v] = ring[(i + 1) % ring.length];
  return sum + (x * v - u * y) / 2;
}, 0);
function show(name, field) {
  const rows = [...Array(size).keys()].map((y) => [...Array(size).keys()].map((x) => field(x, y)));
  const points = rows.flatMap((row, y) => row.map((z, x) => point([x, y], { z })));
  isobands(featureCollection(points), breaks, { zProperty: 'z' }).features.forEach(({ geometry }, i) => {
    const polygons = geometry.coordinates.map((rings) =>
      `${Math.abs(area(rings[0])).toFixed(0)} with ${rings.length - 1} holes`);
    const covered = geometry.coordinates.flat().reduce((sum, ring) => sum + area(ring), 0);
    const right = Math.abs(isoBands(rows, breaks[i], breaks[i + 1] - breaks[i]).reduce((sum, r) => sum + area(r), 0));
    console.log(`${name}, ${breaks[i]} to ${breaks[i + 1]}: polygons of ${polygons.join(' and ')}; `
      + `area ${covered.toFixed(0)}, by marchingsquares ${right.toFixed(0)}`);
  });
}
show('one spot', (x, y) => Math.hypot(x - 20, y - 20));
show('two spots', (x, y) => Math.min(Math.hypot(x - 20, y - 10), Math.hypot(x - 20, y - 30)) * 2);
show('a spot at the border', (x, y) => Math.hypot(x - 10, y - 20));
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
one spot, 0 to 5: polygons of 78 with 0 holes; area 78, by marchingsquares 78
one spot, 5 to 15: polygons of 706 with 1 holes; area 628, by marchingsquares 628
one spot, 15 to 60: polygons of 706 with 0 holes; area -706, by marchingsquares 894
two spots, 0 to 5: polygons of 19 with 0 holes and 19 with 0 holes; area 38, by marchingsquares 38
two spots, 5 to 15: polygons of 176 with 1 holes and 176 with 1 holes; area 314, by marchingsquares 314
two spots, 15 to 60: polygons of 176 with 0 holes and 176 with 0 holes; area -352, by marchingsquares 1248
a spot at the border, 0 to 5: polygons of 78 with 0 holes; area 78, by marchingsquares 78
a spot at the border, 5 to 15: polygons of 629 with 1 holes; area 551, by marchingsquares 551
a spot at the border, 15 to 60: polygons of 971 with 0 holes; area 971, by marchingsquares 971
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
