#!/usr/bin/env bash
# The static site is written, no link is broken, and its scripts grow in headless Chromium without a network. axe-core
# finds no serious problem on its pages.
set -u

fail() { echo "site: $*"; exit 1; }

[ -z "${SANITIZE:-}" ] || { echo "site: builds with sanitizers have no engine"; exit 77; }
browser=$(command -v chromium-headless-shell || command -v chromium) || fail "chromium is missing; cmake/packages.txt names its package"

rm -rf site profile
"$SOURCE/page/site.sh" site "$CASCADE" >said || fail "it was not written: $(cat said)"
tail -n 1 said
# axe-core is one of the packages of the page.
"$SOURCE/page/build.sh" built >build.log 2>&1 || echo "site: axe-core could not be installed"
axe=$PWD/node_modules/axe-core/axe.min.js
[ -e "$axe" ] || axe=''
node "$SOURCE/tests/page/site.mjs" "$browser" "$axe" || fail "see above"
