#!/usr/bin/env bash
# The npm package cascade-patterns, packed and installed as its users install it: patterns in node have the bits of the
# program, and errors, changes, pictures and types are as index.d.ts says (tests/tab/use_package.mjs).
set -eu

fail() { echo "npm package: $*"; exit 1; }

[ -z "${SANITIZE:-}" ] || { echo "npm package: builds with sanitizers have no engine"; exit 77; }
command -v node >/dev/null && command -v npm >/dev/null || { echo "npm package: node or npm is missing"; exit 77; }
[ -e "$BUILD/engine.wasm" ] || fail "engine.wasm is missing"

rm -rf project saved
mkdir project
file=$("$SOURCE/page/npm/pack.sh" "$BUILD/engine.wasm" .) || fail "the package was not packed"
cd project
echo '{ "private": true, "type": "module" }' >package.json
npm install --offline --ignore-scripts --no-audit --no-fund --silent "../$file" || fail "the package was not installed"

cat >spots.cascade <<'SCRIPT'
domain { grid: 40, 24 }
system spots {
  ## How fast it goes.
  rate: 0.1 in 0 .. 1 step 0.05
  place: x
  u: 1 + 0.5 * sin(7 * x + 3 * y) + random(0.1, 0.1)
  u' = rate * lap(u) - 0.01 * place * u^2
}
stage one: spots { iterations: 60 }
stage two: spots { iterations: 40; u: u }
SCRIPT
sed 's/40, 24/12, 10, 6/' spots.cascade >volume.cascade
for name in spots volume; do
    "$CASCADE" run $name.cascade --set rate=0.15 --save $name -o $name.png --quiet || fail "$name was not run"
done
cp "$SOURCE/tests/tab/use_package.mjs" .
node use_package.mjs || fail "see above"
