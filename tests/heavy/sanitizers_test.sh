#!/usr/bin/env bash
# All tests except the heavy ones pass with the address, undefined behaviour and thread sanitizers.
set -eu
FUZZERS='' exec "$SOURCE/tests/fuzz/run_all.sh" 1
