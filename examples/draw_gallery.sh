#!/bin/bash
# Draws the picture beside every example again. The test tests/gallery_test.sh compares them.
#
#     examples/draw_gallery.sh [NAME…]      all, or some, by name without ending
set -eu
cd "$(dirname "$0")/.."
program=${CASCADE:-./cascade}

draw() {
    "$program" run -q "examples/$1.cascade" -o "examples/$1.png" "${@:2}"
}

draw_one() {
    case $1 in
        figure_3_2) draw "$1" --space-time --scale 4 ;;
        # Grids of 128 cells and more.
        brusselator | fitzhugh_nagumo | gray_scott_* | figure_3_3_cheetah | figure_3_3_leopard | \
            figure_3_4_mixed_stripes | figure_3_4_reticulation) draw "$1" --scale 2 ;;
        *) draw "$1" --scale 4 ;;
    esac
}

if [ $# -gt 0 ]; then
    for name in "$@"; do draw_one "$name"; done
else
    for script in examples/*.cascade; do draw_one "$(basename "$script" .cascade)"; done
fi
