#!/usr/bin/env bash
# simplify and derivative of mathjs take the root of x^2 for x.
#
# Expected. The root of x^2 is the absolute value of x. simplify() leaves sqrt(x^2) and abs(x) as they are, so
# (x^2)^(1/2), (x^2)^.5 and (x^4)^(1/4) should stay too.
#
# What happens. They become x, and (x^2)^(3/2) becomes x^3: exponents are multiplied. At -2 the value changes from 2 to
# -2, and a saturating x / (1 + x), written with such a root, changes from .67 to 2. derivative() simplifies first, so
# the slope of (x^2)^(1/2) is 1 on both sides, where that of sqrt(x^2) is -1 at -2. Distances and norms of one
# component are of this form. Nothing warns.
#
# Workaround: write sqrt or abs; or pass { context: math.simplify.realContext } to simplify, and { simplify: false } to
# derivative.
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
const at = (text, x) => math.format(math.evaluate(text, { x }), 6);
for (const text of ['(x^2)^(1/2)', '(x^2)^0.5', '(x^4)^(1/4)', '(x^2)^(3/2)', 'sqrt(x^2)', '(x^6)^(1/3)', 'abs(x)']) {
  const simple = math.simplify(text).toString();
  console.log(`${text} becomes ${simple}: at x = -2 from ${at(text, -2)} to ${at(simple, -2)}`);
}
const distance = '(x^2)^(1/2) / (1 + (x^2)^(1/2))';
const simple = math.simplify(distance).toString();
console.log(`${distance} becomes ${simple}: at x = -2 from ${at(distance, -2)} to ${at(simple, -2)}`);
for (const context of ['realContext', 'positiveContext']) {
  const kept = math.simplify('(x^2)^(1/2)', {}, { context: math.simplify[context] }).toString();
  console.log(`${context}: ${kept}`);
}
const slope = math.derivative('(x^2)^(1/2)', 'x').toString();
const plain = math.derivative('(x^2)^(1/2)', 'x', { simplify: false }).toString();
const root = math.derivative('sqrt(x^2)', 'x').toString();
console.log(`derivative of (x^2)^(1/2): ${slope}, at -2 ${at(slope, -2)}, without simplify ${at(plain, -2)}`);
console.log(`derivative of sqrt(x^2): at -2 ${at(root, -2)}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
(x^2)^(1/2) becomes x: at x = -2 from 2 to -2
(x^2)^0.5 becomes x: at x = -2 from 2 to -2
(x^4)^(1/4) becomes x: at x = -2 from 2 to -2
(x^2)^(3/2) becomes x ^ 3: at x = -2 from 8 to -8
sqrt(x^2) becomes sqrt(x ^ 2): at x = -2 from 2 to 2
(x^6)^(1/3) becomes x ^ 2: at x = -2 from 4 to 4
abs(x) becomes abs(x): at x = -2 from 2 to 2
(x^2)^(1/2) / (1 + (x^2)^(1/2)) becomes x / (x + 1): at x = -2 from 0.666667 to 2
realContext: (x ^ 2) ^ (1 / 2)
positiveContext: x
derivative of (x^2)^(1/2): 1, at -2 1, without simplify -1
derivative of sqrt(x^2): at -2 -1
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
