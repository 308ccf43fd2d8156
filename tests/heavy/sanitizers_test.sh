#!/usr/bin/env bash
# All tests but the heavy ones pass under the sanitizers of addresses, undefined behaviour and threads.
set -eu
FUZZERS='' exec "$SOURCE/tests/fuzz/run_all.sh" 1
