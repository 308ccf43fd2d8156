#!/bin/bash
# Measures the time of a step per cell and species, for different numbers of species.
#
#   bench/species.sh PROGRAM [SIDE]
#
# measures families of 1 to 100 species on SIDE × SIDE cells (default 256), on one thread. Species react with
# themselves alone, with the next in a ring (u[i+1]), or with all (a sum). Prints nanoseconds per cell and species.
# $SECONDS_EACH is the number of seconds per family (default 0.5). On a busy machine, results are unreliable.
set -eu -o pipefail
[ $# -ge 1 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 64; }
program=$(realpath "$1") side=${2:-256}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
echo "species  alone   ring    all"
for count in 1 2 4 8 16 32 64 100; do
    printf '%7d' "$count"
    for other in 'u[i]' "u[mod(i, $count) + 1]" "sum(u[j] over j) / $count"; do
        cat >"$folder/family.cascade" <<END
system family {
  i: 1..$count
  j: 1..$count
  u[i]: random(0.5, 0.4)
  spread[i]: 0.1 + 0.05 * mod(i, 3)
  u[i]' = spread[i] * lap(u[i]) + u[i] * (1 - u[i]) * (0.5 - $other)
  speed: 0.2
}
stage a: family { iterations: 1000000 }
END
        "$program" bench "$folder/family.cascade" --grid "${side}x$side" --threads 1 -q --csv \
            --seconds "${SECONDS_EACH:-0.5}" | awk -F, -v n="$count" 'NR == 2 { printf " %7.3f", 1e9 / $12 / n }'
    done
    echo
done
