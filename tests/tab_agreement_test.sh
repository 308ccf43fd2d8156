#!/usr/bin/env bash
# The engine of pages, in node, computes the same bits as the program with denormal numbers kept: the systems
# of the library, all examples and random scripts.
set -u

fail() { echo "tab: $*"; exit 1; }

[ -z "${SANITIZE:-}" ] || { echo "tab: builds with sanitizers have no engine"; exit 77; }
command -v node >/dev/null || fail "node is missing; cmake/packages.txt names its package"
"$BUILD/tests/tab_states" states.json || fail "the states were not written"
node "$SOURCE/tests/tab/run_states.mjs" "$BUILD/engine.wasm" "$SOURCE/page/built/worker.js" states.json ||
    fail "see above"
