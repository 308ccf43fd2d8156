#!/usr/bin/env bash
# mod of mathjs is negative for positive numbers that are just below whole ones.
#
# Expected. mod(x, y) of mathjs is x - y floor(x / y), at least 0 and less than y for positive y: the usual way to put a
# position back into a periodic box. floor(x) is never larger than x.
#
# What happens. floor, and so mod, first asks whether x equals a whole number up to a relative difference of 1e-12, as
# comparisons in mathjs do, and then takes that number: floor(2.9999999999999) is 3, floor(999999.9999995) is 1000000,
# and the remainders are -1e-13 and -5e-7. The tolerance grows with the number. So a particle that comes close to the
# end of the box has a negative position, no cell of the ring has its index, and roots or logarithms of it become
# complex. On the other side -1e-13 becomes .9999999999999, as it should. Nothing warns.
#
# Workaround: x - y * Math.floor(x / y).
#
# Seen with mathjs 15.2.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts mathjs@15.2.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import * as math from 'mathjs';
for (const x of [2.5, 2.9999999999999, 999999.9999995, -1e-13]) {
  console.log(`${x}: floor ${math.floor(x)}, instead of ${Math.floor(x)}; mod 1 ${math.mod(x, 1).toPrecision(4)}, `
    + `instead of ${(x - Math.floor(x)).toPrecision(4)}`);
}
console.log(`evaluate("999999.9999995 % 1"): ${math.evaluate('999999.9999995 % 1').toPrecision(4)}`);
const cells = [10, 20, 30, 40];
const cell = (x) => cells[Math.floor(math.mod(x, 4))];
console.log(`cells of a ring of 4 at 3.9, 3.9999999999999, 4: ${[3.9, 3.9999999999999, 4].map(cell).join(', ')}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
2.5: floor 2, instead of 2; mod 1 0.5000, instead of 0.5000
2.9999999999999: floor 3, instead of 2; mod 1 -9.992e-14, instead of 1.000
999999.9999995: floor 1000000, instead of 999999; mod 1 -5.000e-7, instead of 1.000
-1e-13: floor -1, instead of -1; mod 1 1.000, instead of 1.000
evaluate("999999.9999995 % 1"): -5.000e-7
cells of a ring of 4 at 3.9, 3.9999999999999, 4: 40, , 10
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
