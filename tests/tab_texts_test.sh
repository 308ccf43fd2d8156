#!/usr/bin/env bash
# The memory of the engine of exported pages, in node, does not grow with every text.
set -u

fail() { echo "tab: $*"; exit 1; }

[ -z "${SANITIZE:-}" ] || { echo "tab: builds with sanitizers have no engine"; exit 77; }
command -v node >/dev/null || fail "node is missing; cmake/packages.txt names its package"
node "$SOURCE/tests/tab/many_texts.mjs" "$BUILD/engine.wasm" "$SOURCE/page/built/worker.js" || fail "see above"
