#!/usr/bin/env bash
# Every include obeys cmake/rooms.txt, in which rooms include only lower rooms. Headers of packages are included only in
# their rooms. Needs no build: reads $SOURCE.
set -u
cd "${SOURCE:-$(dirname "${BASH_SOURCE[0]}")/..}" || exit 1

rooms=()
declare -A may
broken=''
while read -r room others; do
    room=${room%:}
    # A room may name only rooms above it in the table, so that there can be no cycle.
    for other in $others; do
        [ -n "${may[$other]+known}" ] || broken+="cmake/rooms.txt: $room before $other"$'\n'
    done
    rooms+=("$room")
    may[$room]="$room $others"
done < <(grep -vE '^(#|$)' cmake/rooms.txt)

# find_room FILE: sets `room` to the longest entry of the table that the path begins with.
find_room() {
    room=${1%/*}
    while [ -z "${may[$room]+known}" ] && [[ $room == */* ]]; do room=${room%/*}; done
}

# Reads lines "FILE:#include "PATH"" and prints those that break the rule. Every room may include the public header.
offenders() {
    local line file path room allowed
    while IFS= read -r line; do
        file=${line%%:*}
        path=${line#*include \"}
        path=${path%\"}
        [[ $path == cascade/* ]] && continue
        find_room "$file"
        allowed=${may[$room]-}
        find_room "$path"
        [[ " $allowed " == *" $room "* ]] || printf '%s\n' "$line"
    done
}

folders=$(printf '%s\n' "${rooms[@]%%/*}" | sort -u)
# shellcheck disable=SC2086  # One word for each folder.
includes=$(grep -rEo --include='*.h' --include='*.cpp' --include='*.def' '^ *# *include "[^"]+"' $folders)
broken+=$(offenders <<<"$includes")
for folder in $folders; do
    [ "$folder" = jit ] || broken+=$(grep -rE --include='*.h' --include='*.cpp' \
        'include *[<"](llvm|llvm-c)/' "$folder")
    [ "$folder" = app ] || broken+=$(grep -rnE --include='*.h' --include='*.cpp' \
        'include *<(CLI/|histedit)' "$folder")
done
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]OpenMesh/' $folders |
    grep -vE '^mesh/(half_edges\.h|simplify\.cpp|subdivide\.cpp):')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]tiny_gltf\.h' $folders |
    grep -vE '^mesh/gltf_(model\.h|file\.cpp):')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]OpenEXR/' $folders |
    grep -v '^picture/exr\.cpp:')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]openvdb/' $folders |
    grep -v '^picture/openvdb_module\.cpp:')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]hdf5' $folders |
    grep -vE '^picture/hdf5_(module\.cpp|driver\.h):')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]sbml/' $folders |
    grep -v '^import/sbml_module\.cpp:')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]CL/' $folders |
    grep -v '^device/opencl_api\.h:')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]boost/' $folders |
    grep -vE '^(view/(server\.h|local_server\.cpp)|run/commands/statistics\.cpp):')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"](gif_lib\.h|webp/)' $folders |
    grep -vE '^film/(gif|webp)\.cpp:')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"](unsupported/)?Eigen/' $folders |
    grep -vE '^(analysis/|continuation/|atlas/flatten\.cpp:|solvers/linked_laplacian\.cpp:|tab/substitutes/fftw\.cpp:)')
broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"]Spectra/' $folders |
    grep -v '^continuation/modes\.cpp:')

# The check itself must work: these violations must be found.
made_up=$(printf '%s\n' 'core/x.h:#include "ir/y.h"' 'lang/check/x.h:#include "lang/lower/y.h"' \
    'run/stage/x.cpp:#include "app/y.h"' | offenders)
if [ "$(grep -c . <<<"$made_up")" != 3 ] || [ "$(grep -c . <<<"$includes")" -lt 1500 ]; then
    echo "the check itself does not work ($(grep -c . <<<"$includes") includes read)"
    exit 1
fi
if [ -n "$broken" ]; then
    echo "a room includes what cmake/rooms.txt does not let it:"
    echo "$broken"
    exit 1
fi
echo "$(grep -c . <<<"$includes") includes, all downwards"
