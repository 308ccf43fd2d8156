#!/bin/bash
# Measures what diffusion by a tensor costs on models.
#
#   bench/tensors.sh PROGRAM [BEFORE [TURNS]]
#
# prints millions of cell steps a second for witkin_kass on a plane, for witkin_kass on a sphere of as many cells, and
# for a system on this sphere whose species, as many, diffuse by the Laplacian and react in the same way. Then prints
# how many times as long a cell step takes. The program BEFORE, if given, runs witkin_kass on the sphere, too. Programs
# and systems take turns (default 5). A number is the median, over the turns, of processor time of steps: the time of a
# long run less the time of a short one. One thread.
set -eu -o pipefail
[ $# -ge 1 ] || { sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 64; }
program=$(realpath "$1") before=${2:+$(realpath "$2")} turns=${3:-5}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export CASCADE_KERNEL_CACHE=$folder/kernels XDG_CACHE_HOME=$folder/cache
sphere='domain { surface: sphere; cells: 16000 }'
cat >"$folder/scalar.cascade" <<END
$sphere
system scalar: witkin_kass {
  plus[i]'  = lap(plus[i])      - b * plus[i]  + made
  minus[i]' = d * lap(minus[i]) - b * minus[i] + made
}
stage only: scalar { speed: 0.005 }
END
echo "$sphere stage only: witkin_kass { speed: 0.005 }" >"$folder/tensor.cascade"
echo 'domain { grid: 128, 125 } stage only: witkin_kass { speed: 0.005 }' >"$folder/plane.cascade"

processor_seconds() { # program, system, steps
    local TIMEFORMAT='%U %S'
    { time "$1" run "$folder/$2.cascade" --set "iterations=$3" --threads 1 -q -o "$folder/picture.png" \
        >"$folder/said" 2>&1; } 2>&1 | awk '{ print $1 + $2 }'
}
measure() { # program, system, steps
    local short long
    short=$(processor_seconds "$1" "$2" $(($3 / 10)))
    long=$(processor_seconds "$1" "$2" "$3")
    awk -v s="$short" -v l="$long" -v n="$3" 'BEGIN { print 16000 * 0.9 * n / (l - s) / 1e6 }'
}
for ((turn = 0; turn < turns; ++turn)); do
    measure "$program" plane 40000 >>"$folder/plane"
    measure "$program" scalar 10000 >>"$folder/scalar"
    measure "$program" tensor 10000 >>"$folder/tensor"
    [ -z "$before" ] || measure "$before" tensor 500 >>"$folder/before"
done
median() { sort -g "$folder/$1" | awk '{ all[NR] = $1 } END { print all[int((NR + 1) / 2)] }'; }
plane=$(median plane) scalar=$(median scalar) tensor=$(median tensor)
awk -v p="$plane" -v s="$scalar" -v t="$tensor" 'BEGIN {
    printf "plane %.0f, Laplacians on the sphere %.0f, tensors on the sphere %.0f million cell steps a second\n", p, s, t
    printf "tensors on the sphere take %.1f times as long as Laplacians, %.1f times as long as on the plane\n", s/t, p/t }'
[ -z "$before" ] || awk -v b="$(median before)" -v t="$tensor" 'BEGIN {
    printf "before: %.1f million cell steps a second, so now %.1f times as fast\n", b, t / b }'
