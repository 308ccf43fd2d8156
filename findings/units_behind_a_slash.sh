#!/usr/bin/env bash
# mathjs reads "kg/m s" as two different units, and "kg/m*s" is another unit in unitmath.
#
# Expected. One package reads one string as one unit: "kg/m s" is a viscosity, kg/(m s), for those who see a product
# under the line, or kg s/m for those who read from left to right.
#
# What happens. math.unit("6 kg/m s") of mathjs is 6 kg s/m, and math.evaluate("6 kg/m s") is 6 kg/(m s). So a rate
# "mol/m^3 s" that was tried in evaluate() becomes an amount times a time in unit(). "kg/m*s" is kg s/m for both, and
# kg/(m s) for unitmath, a unit library in the style of mathjs, and for js-quantities, which put all that follows the
# slash below the line. Only a conversion to a unit of the other kind throws. Nothing warns.
#
# Workaround: kg m^-1 s^-1, which all of them read the same.
#
# Seen with mathjs 15.2.0, unitmath 0.8.8 and js-quantities 1.8.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts mathjs@15.2.0 unitmath@0.8.8 js-quantities@1.8.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import * as math from 'mathjs';
import Qty from 'js-quantities';
import unitmath from 'unitmath';
const readers = {
  'unit() of mathjs': (text, unit) => math.unit(text).toNumber(unit),
  'evaluate() of mathjs': (text, unit) => math.evaluate(text).toNumber(unit),
  'unitmath': (text, unit) => unitmath(text).to(unit).value,
  'js-quantities': (text, unit) => Qty(text).to(unit).scalar,
};
const meanings = { 'kg m^-1 s^-1': 'kg/(m s)', 'kg m^-1 s': 'kg s/m' };
function meaning(read, text) {
  for (const [unit, name] of Object.entries(meanings)) {
    try {
      return `${read(text, unit)} ${name}`;
    } catch {}
  }
  return 'not read';
}
for (const text of ['6 kg/m s', '6 kg/m*s', '6 kg/m/s', '6 kg m^-1 s^-1']) {
  for (const [name, read] of Object.entries(readers)) console.log(`${text}, ${name}: ${meaning(read, text)}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
6 kg/m s, unit() of mathjs: 6 kg s/m
6 kg/m s, evaluate() of mathjs: 6 kg/(m s)
6 kg/m s, unitmath: 6 kg/(m s)
6 kg/m s, js-quantities: 6 kg/(m s)
6 kg/m*s, unit() of mathjs: 6 kg s/m
6 kg/m*s, evaluate() of mathjs: 6 kg s/m
6 kg/m*s, unitmath: 6 kg/(m s)
6 kg/m*s, js-quantities: 6 kg/(m s)
6 kg/m/s, unit() of mathjs: 6 kg/(m s)
6 kg/m/s, evaluate() of mathjs: 6 kg/(m s)
6 kg/m/s, unitmath: not read
6 kg/m/s, js-quantities: not read
6 kg m^-1 s^-1, unit() of mathjs: 6 kg/(m s)
6 kg m^-1 s^-1, evaluate() of mathjs: 6 kg/(m s)
6 kg m^-1 s^-1, unitmath: 6 kg/(m s)
6 kg m^-1 s^-1, js-quantities: 6 kg/(m s)
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
