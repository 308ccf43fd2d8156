#!/usr/bin/env bash
# The engine of exported pages, in node, computes the same bits as the program, for the systems of the library, all
# examples and random scripts. Exact pages are compared with the program itself, others with the program without
# flushing of denormal numbers.
set -u

fail() { echo "tab: $*"; exit 1; }

[ -z "${SANITIZE:-}" ] || { echo "tab: builds with sanitizers have no engine"; exit 77; }
command -v node >/dev/null || fail "node is missing; cmake/packages.txt names its package"
for denormals in kept exact; do
    "$BUILD/tests/tab_states" $denormals states.json || fail "the states were not written"
    node "$SOURCE/tests/tab/run_states.mjs" "$BUILD/engine.wasm" "$SOURCE/page/built/worker.js" states.json ||
        fail "see above ($denormals)"
done
