#!/usr/bin/env bash
# What two commits ask of somebody who waits for them: processor time, without a compiler cache.
#
#   bench/builds.sh BEFORE AFTER [WHAT…]
#
# clones both commits and prints the seconds of the processor of each, and AFTER / BEFORE, for each WHAT, by turns:
#   picture      ./cascade run examples/leopard.cascade in a fresh clone
#   everything   all that can be built after that: pages' engine, libraries, modules
#   tests        ./tests/run in a fresh clone, its build included
# Without WHAT: picture and everything. Packages that are missing are installed first and not counted. The clones are
# kept in $FOLDER if it is set.
set -eu -o pipefail
[ $# -ge 2 ] || { sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 64; }
source=$(cd "$(dirname "$0")/.." && pwd)
before=$1 after=$2
shift 2
[ $# -gt 0 ] || set -- picture everything
folder=${FOLDER:-$(mktemp -d)}
[ -n "${FOLDER:-}" ] || trap 'rm -rf "$folder"' EXIT
export CCACHE_DISABLE=1

# clone COMMIT NAME: a fresh clone, with the packages that it needs.
clone() {
    rm -rf "${folder:?}/$2"
    git clone -q "$source" "$folder/$2"
    git -C "$folder/$2" checkout -q "$1"
    (root=$folder/$2 && . "$root/cmake/setup.sh" && install_packages "$folder/$2.log" build tests tab)
}

do_picture() { ./cascade run examples/leopard.cascade -o picture.png; }
do_everything() { cmake --build build/release --target all cascade_engine; }
do_tests() { ./tests/run; }

# seconds NAME WHAT: the seconds of the processor that WHAT takes in a clone.
seconds() {
    local TIMEFORMAT='%U %S'
    cd "$folder/$1"
    { time "do_$2" >"$folder/$1.$2" 2>&1 </dev/null; } 2>&1 | awk '{ printf "%.0f\n", $1 + $2 }'
}

printf '%-12s %10s %10s %6s\n' what before after ratio
for what; do
    if [ "$what" != everything ]; then
        clone "$before" before
        clone "$after" after
    fi
    first=$(seconds before "$what")
    second=$(seconds after "$what")
    awk -v what="$what" -v a="$first" -v b="$second" \
        'BEGIN { printf "%-12s %8.0f s %8.0f s %6.2f\n", what, a, b, b / a }'
done
