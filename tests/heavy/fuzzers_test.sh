#!/usr/bin/env bash
# Each fuzzer finds no input that crashes or takes long, in a minute; that of the front end in as many inputs on any machine.
set -eu
export FRONT_END_RUNS=${FRONT_END_RUNS-20000}
SANITIZERS='' exec "$SOURCE/tests/fuzz/run_all.sh" 7
