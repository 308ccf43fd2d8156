#!/usr/bin/env bash
# isolines() of @thi.ng/geom-isoline breaks lines that reach the border into crumbs.
#
# Expected. A contour of a grid of numbers is either closed or it ends at the border. The field u = y has one straight
# line for each level, from the left border to the right. Its negative with the negative level has the same line.
#
# What happens. Each cell adds only the point at which the line leaves it, so the first point of an open line is
# missing. Worse, the search begins in the first row and follows a line in one direction only. If it meets a line in
# the middle, or at the wrong end, the rest becomes lines of their own: the stripe u = y falls into five lines with
# one point each, and nothing is drawn. The same stripe with the opposite sign is one line. Closed contours are right,
# so spots look well until one of them touches the border. Nothing warns.
#
# Workaround: setBorder() of the same package with a value on one side of all levels, which closes all lines along the
# border; or d3-contour.
#
# Seen with @thi.ng/geom-isoline 2.1.233 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts @thi.ng/geom-isoline@2.1.233 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { isolines, setBorder } from '@thi.ng/geom-isoline';
const n = 6;
const show = (name, f, level, close) => {
  const u = new Float64Array(n * n);
  for (let y = 0; y < n; y++) for (let x = 0; x < n; x++) u[y * n + x] = f(x, y);
  if (close !== undefined) setBorder(u, n, n, close);
  const lines = [...isolines(u, n, n, level)];
  const text = (line) => line.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(' ');
  console.log(`${name}: ${lines.map(text).join(' | ')}`);
};
// By design the points are moved by half a cell: the line x = 2.25 is drawn at 2.75, from .5 to 5.5.
show('u = x, level 2.25', (x) => x, 2.25);
show('u = -x, level -2.25', (x) => -x, -2.25);
show('u = y, level 2.25', (x, y) => y, 2.25);
show('u = -y, level -2.25', (x, y) => -y, -2.25);
show('a spot', (x, y) => Math.hypot(x - 2, y - 2), 1.2);
show('u = y, level 2.25, border 9', (x, y) => y, 2.25, 9);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
u = x, level 2.25: 2.75,1.50 2.75,2.50 2.75,3.50 2.75,4.50 2.75,5.50
u = -x, level -2.25: 2.75,0.50 2.75,1.50 | 2.75,2.50 | 2.75,3.50 | 2.75,4.50
u = y, level 2.25: 0.50,2.75 | 1.50,2.75 | 2.50,2.75 | 3.50,2.75 | 4.50,2.75
u = -y, level -2.25: 1.50,2.75 2.50,2.75 3.50,2.75 4.50,2.75 5.50,2.75
a spot: 1.50,2.02 2.02,1.50 2.50,1.30 2.98,1.50 3.50,2.02 3.70,2.50 3.50,2.98 2.98,3.50 2.50,3.70 2.02,3.50 1.50,2.98 1.30,2.50
u = y, level 2.25, border 9: 1.50,1.34 2.50,1.34 3.50,1.34 4.50,1.34 4.66,1.50 4.54,2.50 4.50,2.75 3.50,2.75 2.50,2.75 1.50,2.75 1.46,2.50 1.34,1.50
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
