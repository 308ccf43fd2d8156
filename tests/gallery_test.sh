#!/bin/bash
# Every picture of the gallery, and the picture of the C program, is made again and compared: all bytes must be equal, except
# the version of the program that drew it (tests/same_picture.py). Pictures of surfaces may differ in the last bits of
# Embree's rays. Without native code only small pictures are drawn, since large ones would take minutes.
set -u
failed=0

same() { python3 "$SOURCE/tests/same_picture.py" "$@"; }
again() {
    "$CASCADE" run -q "$1" -o again.png || failed=1
    case $1 in
        */surfaces/* | */materials/* | */bodies/* | */on_models/* | */cells/*) surface=(--surface) ;;
        *) surface=() ;;
    esac
    if ! same ${surface[@]+"${surface[@]}"} "$1" again.png; then
        echo "gallery: $1 does not grow again from itself"
        failed=1
    fi
}

count=0
for picture in "$SOURCE"/examples/*.png "$SOURCE"/examples/{witkin_kass,surfaces,materials,bodies,on_models,cells}/*.png; do
    if [ "$CASCADE_JIT" != 1 ] && [ "$(stat -c %s "$picture")" -gt 5300 ]; then continue; fi
    again "$picture"
    count=$((count + 1))
done
if [ "$CASCADE_JIT" = 1 ]; then
    for sheet in "$SOURCE"/examples/sweeps/*.png; do
        "$CASCADE" sweep -q "$sheet" -o swept --force || failed=1
        same "$sheet" swept/sheet.png && cmp "${sheet%.png}.csv" swept/features.csv || failed=1
    done
fi
for script in "$SOURCE"/examples/*.cascade "$SOURCE"/examples/{witkin_kass,surfaces,materials,bodies,on_models,cells,covers}/*.cascade; do
    if [ ! -f "${script%.cascade}.png" ]; then
        echo "gallery: $script has no picture beside it"
        failed=1
    fi
done
for script in "$SOURCE"/lang/systems/*.cascade; do
    picture=$SOURCE/examples/models/$(basename "${script%.cascade}").png
    if [ ! -f "$picture" ]; then
        echo "gallery: $script has no picture $picture"
        failed=1
    elif [ "$CASCADE_JIT" = 1 ]; then
        # From the script instead of the picture, so that both must agree, and by the same path, since a picture
        # contains its script's name.
        here=$PWD
        drawn=()
        case $script in */kdv.cascade) drawn=(--space-time) ;; esac
        (cd "$SOURCE" &&
            "$CASCADE" run -q "${script#"$SOURCE"/}" -o "$here/again.png" ${drawn[@]+"${drawn[@]}"}) || failed=1
        if ! same "$picture" again.png; then
            echo "gallery: $picture is not what $script draws"
            failed=1
        fi
    fi
done
if [ "$CASCADE_JIT" = 1 ]; then
    [ "$count" -ge 30 ] || { echo "gallery: only $count pictures"; failed=1; }
    "$CASCADE" compile "$SOURCE/examples/c_program/spots.cascade" --per-cell ka -o step.o > log &&
        cc -O2 -Wall -Wextra -Werror -I. "$SOURCE/examples/c_program/main.c" step.o -lpng -o spots &&
        ./spots again.png && cmp "$SOURCE/examples/c_program/spots.png" again.png || failed=1
fi
exit $failed
