#!/usr/bin/env bash
# Compares the processor time that users of two commits wait for, without a compiler cache.
#
#   bench/builds.sh BEFORE AFTER [WHAT…]
#
# clones both commits and, for each WHAT in turn, prints the processor seconds of both and the ratio AFTER / BEFORE:
#   picture      ./cascade run examples/leopard.cascade in a fresh clone
#   everything   all that can be built after picture: pages' engine, libraries, modules
#   tests        ./tests/run in a fresh clone, including its build
# By default: picture and everything. Missing packages are installed first, without being measured. If $FOLDER is set,
# the clones are kept there.
set -eu -o pipefail
[ $# -ge 2 ] || { sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 64; }
source=$(cd "$(dirname "$0")/.." && pwd)
before=$1 after=$2
shift 2
[ $# -gt 0 ] || set -- picture everything
folder=${FOLDER:-$(mktemp -d)}
[ -n "${FOLDER:-}" ] || trap 'rm -rf "$folder"' EXIT
export CCACHE_DISABLE=1

# clone COMMIT NAME: makes a fresh clone and installs the packages that it needs.
clone() {
    rm -rf "${folder:?}/$2"
    git clone -q "$source" "$folder/$2"
    git -C "$folder/$2" checkout -q "$1"
    (root=$folder/$2 && . "$root/cmake/setup.sh" && install_packages "$folder/$2.log" build tests tab)
}

do_picture() { ./cascade run examples/leopard.cascade -o picture.png; }
do_everything() { cmake --build build/release --target all cascade_engine; }
do_tests() { ./tests/run; }

# seconds NAME WHAT: prints the processor seconds that WHAT takes in a clone.
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
