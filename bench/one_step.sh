#!/bin/bash
# Compares the same step of Gray and Scott's reaction in C++, Halide, OpenCL, Python and Cascade (docs/one_step.md).
#
#   bench/one_step.sh PROGRAM [--check] [SIDE [ROUNDS]]
#
# builds the programs of bench/one_step and compares their results with those of PROGRAM. Then it
# measures each on SIDE × SIDE cells (default 256), on one core: all take turns, ROUNDS times (default 5). Prints, for
# each, the lines of its step, the least nanoseconds of processor time for one step of one cell, and their ratio to
# Cascade's. With --check it only compares. Halide, OpenCL, NumPy and Numba are left out if they are not installed.
# $PYTHON is the interpreter, $HALIDE a folder with usr/include and usr/lib of Halide.
set -eu -o pipefail
[ $# -ge 1 ] || { sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 64; }
program=$(realpath "$1")
shift
is_check=''
if [ "${1:-}" = --check ]; then is_check=1; shift; fi
side=${1:-256} rounds=${2:-5}
sources=$(realpath "$(dirname "$0")")/one_step
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
cd "$made"
ln -s "$sources" programs # A path without spaces.
export CASCADE_KERNEL_CACHE=$made/kernels POCL_CACHE_DIR=$made/pocl
core=$(taskset -cp $$ | sed 's/.*[ ,-]//') # The last one that may be used.
steps_at_once=8 # Programs with tiles take steps in groups of this size.

# The rows of the table: names, keys of their lines in the sources, by how much they are slower than the fastest (so
# that they take fewer steps), and commands.
names=() keys=() shares=() commands=()
row() { names+=("$1") keys+=("$2") shares+=("$3") commands+=("${*:4}"); }

python=${PYTHON:-python3}
if "$python" -c 'import numpy' 2>/dev/null; then
    row "Python's lists" "Python's lists" 4000 "$python" programs/arrays.py lists
    row 'NumPy, np.roll' 'NumPy, np.roll' 40 "$python" programs/arrays.py rolls
    row 'NumPy, views and out=' 'NumPy, views and out=' 20 "$python" programs/arrays.py views
    if "$python" -c 'import numba' 2>/dev/null; then
        row Numba Numba 4 "$python" programs/arrays.py numba
    fi
fi

compile() { # program, source, flags
    "${CXX:-g++}" -std=c++17 "${@:3}" -o "$1" "$sources/$2" "${libraries[@]}"
}
libraries=()
native='-O3 -march=native'
# shellcheck disable=SC2086  # Several flags.
{
    compile loops-O2 loops.cpp -O2
    compile loops-aliased loops.cpp $native -D__restrict=
    compile loops loops.cpp $native
    compile loops-wide loops.cpp $native -mprefer-vector-width=512
}
row 'C++: % and double, -O2' 'C++, remainders' 10 ./loops-O2 remainders-double
row 'C++: % and double' 'C++, remainders' 10 ./loops remainders-double
row 'C++: % and float' 'C++, remainders' 10 ./loops remainders
row 'C++: border, no __restrict' 'C++, border cells' 5 ./loops-aliased border
row 'C++: border, -O2' 'C++, border cells' 5 ./loops-O2 border
row 'C++: border, double' 'C++, border cells' 2 ./loops border-double
row 'C++: border, float' 'C++, border cells' 1 ./loops border
row 'C++: border, 512 bits' 'C++, border cells' 1 ./loops-wide border
row 'C++: eight steps a tile' 'C++, border cells|C++, eight steps a tile' 1 ./loops tiles

libraries=(-l:libOpenCL.so.1)
if compile opencl opencl.cpp -O2 2>opencl.said && ./opencl programs/gray_scott.cl 8 1 >opencl.said 2>&1; then
    row 'OpenCL' 'OpenCL, the kernel|OpenCL, the host' 5 ./opencl programs/gray_scott.cl
fi
halide=${HALIDE:-}/usr
libraries=(-L"$halide/lib/x86_64-linux-gnu" -Wl,-rpath,"$halide/lib/x86_64-linux-gnu" -l:libHalide14.so.0)
if [ -e "$halide/include/halide14/Halide.h" ]; then
    compile halide halide.cpp -O2 -isystem "$halide/include/halide14"
    row 'Halide: row by row' 'Halide, the step|Halide, row by row' 1 ./halide rows
    row 'Halide: eight steps a tile' 'Halide, the step|Halide, eight steps a tile' 1 ./halide tiles
fi

# cascade-steps OPTION… SIDE STEPS [FILE]: as the other programs. The time is the difference of two runs, so that
# reading the script, compiling and writing do not count.
cascade_steps() {
    local words=("$@") options=() file='' seconds
    while [[ ${words[0]} == --* ]]; do options+=("${words[0]}"); words=("${words[@]:1}"); done
    local cells=${words[0]} steps=${words[1]} TIMEFORMAT='%U %S'
    file=${words[2]:-}
    run() {
        "$program" run "$sources/gray_scott.cascade" --grid "${cells}x$cells" --set "iterations=$1" --threads 1 -q \
            "${options[@]}" -o picture.png "${@:2}" >said 2>&1 || { cat said >&2; return 1; }
    }
    if [ -n "$file" ]; then
        rm -rf saved
        run "$steps" --save saved
        "$python" -c 'import numpy, sys; numpy.load("saved/grow.v.npy").tofile(sys.argv[1])' "$file"
        echo 0
        return
    fi
    run 1
    seconds=$({ time run "$steps"; time run $((5 * steps)); } 2>&1)
    awk '{ now = $1 + $2 } NR == 1 { first = now } END { printf "%.6f\n", (now - first) / 4 }' <<<"$seconds"
}
row 'Cascade' 'Cascade' 1 cascade_steps
row 'Cascade, --fast' 'Cascade' 1 cascade_steps --fast

lines_of() { # key|key…
    local key sum=0
    local -a each
    IFS='|' read -ra each <<<"$1"
    for key in "${each[@]}"; do
        sum=$((sum + $(awk -v key="lines: $key" 'index($0, key) && substr($0, index($0, key)) == key { on = 1; next }
            on && /^(\/\/|#) end$/ { print count + 0; exit } on && NF { ++count }' "$sources"/*)))
    done
    echo "$sum"
}

# All must compute the same pattern.
"$python" -c 'import numpy' 2>/dev/null || { echo 'one_step.sh: NumPy is needed to compare results' >&2; exit 1; }
for k in "${!names[@]}"; do
    ${commands[k]} 256 24 "$k.v" >/dev/null
done
"$python" - "${#names[@]}" <<'END'
import sys
import numpy as np
planes = [np.fromfile(f"{k}.v", np.float32) for k in range(int(sys.argv[1]))]
for k, plane in enumerate(planes):
    difference = abs(plane - planes[-2]).max() if plane.shape == planes[-2].shape else np.inf
    if not difference < 1e-4:
        sys.exit(f"one_step.sh: program {k + 1} differs from Cascade by {difference}")
if planes[0].std() < 0.05:
    sys.exit("one_step.sh: there is no pattern")
END
[ -z "$is_check" ] || { echo "${#names[@]} programs agree"; exit; }

# The fastest programs take 128 million steps of single cells.
taskset -cp "$core" $$ >/dev/null
base=$((134217728 / side / side))
[ "$base" -ge "$steps_at_once" ] || base=$steps_at_once
for ((round = 0; round < rounds; ++round)); do
    for k in "${!names[@]}"; do
        steps=$((base / shares[k] / steps_at_once * steps_at_once))
        [ "$steps" -gt 0 ] || steps=1
        echo "$k $steps $(${commands[k]} "$side" "$steps")"
    done
done | awk -v side="$side" '
    { ns = $3 * 1e9 / $2 / side / side }
    !($1 in least) || ns < least[$1] { least[$1] = ns }
    END { for (k in least) print k, least[k] }' | sort -n >times

cascade=$(awk -v k=$((${#names[@]} - 2)) '$1 == k { print $2 }' times)
printf '%-28s %5s %9s %8s\n' "$side x $side cells" lines ns ratio
while read -r k ns; do
    awk -v name="${names[k]}" -v lines="$(lines_of "${keys[k]}")" -v ns="$ns" -v cascade="$cascade" \
        'BEGIN { printf "%-28s %5d %9.3f %8.2f\n", name, lines, ns, ns / cascade }'
done <times
