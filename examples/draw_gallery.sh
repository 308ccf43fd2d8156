#!/bin/bash
# Draws the picture beside every example again. The test tests/gallery_test.sh compares them.
#
#     examples/draw_gallery.sh [NAME…]      all, or some, by name without ending: leopard,
#                                           models/barkley for a system of the library,
#                                           witkin_kass/zebra
set -eu
cd "$(dirname "$0")/.."
program=${CASCADE:-./cascade}

draw() {
    "$program" run -q "examples/$1.cascade" -o "examples/$1.png" "${@:2}"
}

# Recipes of Appendix C, on four times the cells of the thesis and in colours; finer at the end.
draw_recipe() { draw "$1" --grid 128x128 --detail 3 --palette "$2"; }

# Covers are 1600 × 1200 and drawn with many rays, each in a different setting.
draw_cover() {
    local setting
    case $1 in
        zebra) setting=(--view 60,8 --light outdoors --background '#d9c8a0') ;;
        delft) setting=(--view 0,14 --light studio --background '#e8e4dc') ;;
        thorns) setting=(--view 0,10 --light studio --background '#23262b') ;;
        lamp) setting=(--view 0,14 --light studio --background '#15161c') ;;
        frog) setting=(--view 35,18 --light outdoors --background '#3d4a2c') ;;
        emperor) setting=(--view 62,8 --light studio --background '#0d3a52') ;;
    esac
    draw "covers/$1" --size 1600x1200 --quality fine "${setting[@]}"
}

# Exhibits of the museum are small. Automata and clocks show their cells, and time runs downwards in lines.
draw_exhibit() {
    case $1 in
        life_soup | cyclic_automaton | sandpile | lone_neighbour | forest_fire | ising_critical) draw "museum/$1" ;;
        eden_cluster | forest_of_trees | spiral_chimera) draw "museum/$1" ;;
        *_line | quantum_carpet | rule_thirty) draw "museum/$1" --space-time ;;
        ball_of_spots | scroll_wave | alloy_sponge | scaled_egg) draw "museum/$1" --size 144x112 ;;
        *) draw "museum/$1" --size 104 ;;
    esac
}

draw_one() {
    case $1 in
        pearson_map) draw "$1" ;;
        materials/lava) draw "$1" --displace --light studio --background '#120c0a' ;;
        witkin_kass/replication) draw "$1" --copies 2x2 ;;
        witkin_kass/* | surfaces/* | bodies/*) draw "$1" ;;
        on_models/torus) draw "$1" --view 30,40 ;;
        on_models/fingerprint | on_models/lobes) draw "$1" ;;
        on_models/giraffe) draw "$1" --view 60,10 --size 720x800 ;;
        on_models/leopard | on_models/cheetah | on_models/genet) draw "$1" --view 60,12 --size 960x560 ;;
        on_models/growing_leopard)
            draw "$1" --view 60,12 --size 480x300 -o "examples/$1.webp" ;;  # With a film of its growth.
        on_models/angelfish | on_models/emperor) draw "$1" --view 70,10 ;;
        on_models/*) draw "$1" --view 55,15 ;;  # Animals, from the side.
        cells/fur) draw "$1" --view 55,15 --light studio ;;
        cells/leopard_thorns) draw "$1" --view 55,15 ;;
        cells/bear) draw "$1" --view 20,10 ;;
        cells/feathers) draw "$1" --view 62,14 ;;
        cells/thorny_head) draw "$1" --view 25,5 --light studio --background '#c9ced3' ;;
        cells/grown_body) draw "$1" --view 30,20 ;;
        cells/*) draw "$1" ;;
        covers/*) draw_cover "${1#*/}" ;;
        museum/*) draw_exhibit "${1#*/}" ;;
        models/kdv) "$program" run -q lang/systems/kdv.cascade -o examples/models/kdv.png --space-time ;;
        models/*) "$program" run -q "lang/systems/${1#*/}.cascade" -o "examples/$1.png" ;;
        figure_3_2) draw "$1" --space-time --scale 4 ;;
        # A figure of its moments, and a picture of the last one.
        replication)
            draw "$1" --detail 2 --palette coral --range 0,0.4 -o "examples/$1.svg" \
                --panel one.v --panel two.v --panel four.v --panel eight.v --panel many.v --panel all.v
            ;;
        # These two recipes need the grid of the thesis.
        squirrel) draw "$1" --detail 6 --palette tan ;;
        mixed_spots) draw "$1" --detail 6 --palette viridis ;;
        cheetah | small_spots) draw_recipe "$1" cheetah ;;
        leopard | lionfish) draw_recipe "$1" "$1" ;;
        plates | thin_lines) draw_recipe "$1" tan ;;
        wide_spots) draw_recipe "$1" giraffe ;;
        eroded_stripes) draw_recipe "$1" zebra ;;
        bumpy_stripes) draw_recipe "$1" coral ;;
        broken_lines) draw_recipe "$1" dart_frog ;;
        honeycomb) draw_recipe "$1" inferno ;;
        autocatalytic_spots | vary_spots) draw_recipe "$1" magma ;;
        growing_fish) draw "$1" --size 320 -o "examples/$1.webp" ;;  # With a film of its growth.
        butterfly | fish) draw "$1" --detail 3 ;;  # With smooth outlines.
        automatic_cascade | brusselator | fitzhugh_nagumo | gray_scott_* | figure_3_3_cheetah | \
            figure_3_3_leopard | figure_3_4_mixed_stripes | figure_3_4_reticulation) draw "$1" --size 512 ;;
        *) draw "$1" --size 384 ;;
    esac
}

sweep_gray_scott() {
    local folder
    folder=$(mktemp -d)
    "$program" sweep -q examples/sweeps/gray_scott.cascade -o "$folder" \
        --vary gray_scott.feed=0.014..0.062:9 --vary gray_scott.kill=0.047..0.065:7
    cp "$folder/sheet.png" examples/sweeps/gray_scott.png
    cp "$folder/features.csv" examples/sweeps/gray_scott.csv
    rm -r "$folder"
}

if [ $# -gt 0 ]; then
    for name in "$@"; do draw_one "$name"; done
else
    for script in lang/systems/*.cascade; do draw_one "models/$(basename "$script" .cascade)"; done
    for script in examples/witkin_kass/*.cascade; do
        draw_one "witkin_kass/$(basename "$script" .cascade)"
    done
    for script in examples/surfaces/*.cascade; do
        draw_one "surfaces/$(basename "$script" .cascade)"
    done
    for script in examples/bodies/*.cascade; do
        draw_one "bodies/$(basename "$script" .cascade)"
    done
    for script in examples/materials/*.cascade; do
        draw_one "materials/$(basename "$script" .cascade)"
    done
    for script in examples/on_models/*.cascade; do
        draw_one "on_models/$(basename "$script" .cascade)"
    done
    for script in examples/museum/*.cascade; do draw_one "museum/$(basename "$script" .cascade)"; done
    for script in examples/covers/*.cascade; do draw_one "covers/$(basename "$script" .cascade)"; done
    for script in examples/cells/*.cascade; do draw_one "cells/$(basename "$script" .cascade)"; done
    for script in examples/*.cascade; do draw_one "$(basename "$script" .cascade)"; done
    sweep_gray_scott
fi
