#!/usr/bin/env bash
# The slope of a straight line is 0, 2 or 3 in ml-savitzky-golay-generalized if the steps are unequal.
#
# Expected. The function takes a constant step, or an array with the position of each point. It fits a polynomial of
# degree 2 in a window of five points and returns its derivative. A straight line is such a polynomial, so y = 3 x has
# the slope 3 wherever the points are.
#
# What happens. The fit takes the points as equally spaced, and only a mean step near the point enters. In the middle
# of the series lines come out right; at the ends the slope of 3 x is 0, 2, 3.18 and 3.33 instead of 3. The slope of
# x^2 is wrong everywhere, and negative at its start. So the speed of a front, from a solver that chooses its steps, is
# wrong, most of all where the front begins to move. Nothing warns.
#
# Workaround: interpolate to equal steps first. For these the function is exact, at the ends too.
#
# Seen with ml-savitzky-golay-generalized 5.0.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts ml-savitzky-golay-generalized@5.0.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import * as module from 'ml-savitzky-golay-generalized';
const slope = module.sgg ?? module.default?.sgg ?? module.default;
const options = { windowSize: 5, derivative: 1, polynomial: 2 };
const list = (numbers) => Array.from(numbers, (v) => +v.toFixed(2) + 0).join(' ');
const positions = {
  'equal steps': Array.from({ length: 11 }, (_, i) => i / 2),
  'growing steps': Array.from({ length: 11 }, (_, i) => (i * i) / 10),
};
for (const [name, x] of Object.entries(positions)) {
  console.log(`${name}: x = ${list(x)}`);
  console.log(`  slope of 3 x: ${list(slope(x.map((v) => 3 * v), x, options))}`);
  console.log(`  slope of x^2: ${list(slope(x.map((v) => v * v), x, options))}`);
  console.log(`  should be:    ${list(x.map((v) => 2 * v))}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
equal steps: x = 0 0.5 1 1.5 2 2.5 3 3.5 4 4.5 5
  slope of 3 x: 3 3 3 3 3 3 3 3 3 3 3
  slope of x^2: 0 1 2 3 4 5 6 7 8 9 10
  should be:    0 1 2 3 4 5 6 7 8 9 10
growing steps: x = 0 0.1 0.4 0.9 1.6 2.5 3.6 4.9 6.4 8.1 10
  slope of 3 x: 0 2 3 3 3 3 3 3 3 3.18 3.33
  slope of x^2: -2.73 0.08 1.48 2.48 3.88 5.68 7.88 10.48 13.48 17.26 20.61
  should be:    0 0.2 0.8 1.8 3.2 5 7.2 9.8 12.8 16.2 20
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
