#!/bin/bash
# Measures the speeds of all examples, before and after a change.
#
#   bench/examples.sh PROGRAM AFTER.csv [BEFORE.csv]
#
# writes AFTER.csv with a row for each stage of each script below examples/ (`cascade bench --csv`). With
# BEFORE.csv, prints the ratios of speeds, the worst first. On a busy machine, results are unreliable.
# $SECONDS_EACH is the number of seconds for which each stage is measured (default 0.3).
set -eu
[ $# -ge 2 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 64; }
program=$(realpath "$1")
after=$(realpath -m "$2")
before=${3:+$(realpath "$3")}
cd "$(dirname "$0")/.."
mapfile -t scripts < <(find examples -name '*.cascade' | LC_ALL=C sort)
"$program" bench "${scripts[@]}" --seconds "${SECONDS_EACH:-0.3}" --csv -q >"$after.part"
mv "$after.part" "$after"
[ -z "$before" ] || awk -F, 'FNR == 1 { next }
    NR == FNR { speed[$1 "," $2] = $12; next }
    speed[$1 "," $2] > 0 && $12 > 0 { printf "%.3f  %s, %s\n", $12 / speed[$1 "," $2], $1, $2 }' \
    "$before" "$after" | sort -n
