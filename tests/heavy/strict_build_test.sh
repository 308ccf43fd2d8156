#!/usr/bin/env bash
# Each file compiles by itself, without a precompiled header, with -O3 and without a warning. So no file relies on
# includes of other files in its unit.
set -eu
cmake -G Ninja -S "$SOURCE" -B strict --preset strict >configure.log || { tail -n 30 configure.log; exit 1; }
ninja -C strict -k 0 >build.log || { grep -E 'error|warning' build.log | head -n 60; exit 1; }
echo "$(grep -c 'Building CXX' build.log) files compiled anew, each by itself"
