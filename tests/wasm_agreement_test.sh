#!/usr/bin/env bash
# Kernels as WebAssembly modules compute the same bits as the interpreter. Modules that keep denormal numbers and
# modules that flush them to 0 are tested, with both compilers of node: the fast one that code starts with, and the one
# that optimises.
set -u

fail() { echo "wasm: $*"; exit 1; }

command -v node >/dev/null || fail "node is missing; cmake/packages.txt names its package"
"$BUILD/tests/wasm_cases" kept kept.cases || fail "the cases were not written"
"$BUILD/tests/wasm_cases" exact exact.cases || fail "the exact cases were not written"
for compiler in --liftoff-only --no-liftoff; do
    node $compiler "$SOURCE/tests/wasm/run_cases.mjs" kept.cases exact.cases ||
        fail "see above (node $compiler)"
done
