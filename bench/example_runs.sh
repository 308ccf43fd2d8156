#!/bin/bash
# Compares two programs by whole runs of all examples, from command to picture.
#
#   bench/example_runs.sh BEFORE AFTER [TIMES]
#
# prints a row for each script below examples/: the least seconds of TIMES runs (default 5) of the program BEFORE
# and of AFTER, and how many times as fast AFTER is. Runs alternate. Each program has its own cache of compiled
# kernels, so only its first run compiles. On a busy machine, results are unreliable.
set -eu -o pipefail
[ $# -ge 2 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 64; }
before=$(realpath "$1") after=$(realpath "$2") times=${3:-5}
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

seconds_of() { # program, script
    local TIMEFORMAT=%R
    export CASCADE_KERNEL_CACHE=$folder/${1//\//_}
    { time "$1" run "$2" -q -o "$folder/picture.png" >"$folder/said" 2>&1; } 2>&1 || {
        cat "$folder/said" >&2
        return 1
    }
}

find examples -name '*.cascade' ! -path '*/sweeps/*' | LC_ALL=C sort | while read -r script; do
    for ((n = 0; n < times; ++n)); do
        first=$(seconds_of "$before" "$script")
        second=$(seconds_of "$after" "$script")
        echo "$first $second"
    done | awk -v name="$script" '
        NR == 1 || $1 < before { before = $1 }
        NR == 1 || $2 < after { after = $2 }
        END { if (NR) printf "%-50s %8.3f %8.3f %6.2f\n", name, before, after, before / after }'
done
