#!/usr/bin/env bash
# Wall time to the same pattern for each solver: Turing's spots after the same time.
# usage: bench/solvers.sh CASCADE [SIDE…]   (the program; sides of the grid, 256 and 1024 by default)
set -eu
cascade=$1
shift
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
printf 'stage spots: turing_spots { iterations: 28000; ka: 0.05/16 }\n' > "$folder/spots.cascade"
for side in "${@:-256 1024}"; do
    for size in $side; do
        for solver in euler symplectic rk2 rk4 rk23 rk45 rkl1 rkl2 imex imex2 gauss; do
            told=$("$cascade" run "$folder/spots.cascade" --grid "${size}x$size" --solver "$solver" \
                --output "$folder/$solver.png" 2>&1 | tail -n 1)
            printf '%5d² %-10s %s\n' "$size" "$solver" "$told"
        done
    done
done

# Where operators lie in each other: an alloy comes apart, to the same time.
cat > "$folder/alloy.cascade" <<'END'
stage alloy: cahn_hilliard { iterations: 12000; speed: 0.025 }
END
for side in "${@:-256}"; do
    for size in $side; do
        for solver in euler rkl1 imex imex2 gauss; do
            told=$("$cascade" run "$folder/alloy.cascade" --grid "${size}x$size" --solver "$solver" \
                --output "$folder/$solver.png" 2>&1 | tail -n 1)
            printf 'alloy %5d² %-10s %s\n' "$size" "$solver" "$told"
        done
    done
done

# Large spots found on coarse grids first: a sixteenth of the steps, at the full grid.
printf 'stage spots: turing_spots { start: coarse(4); iterations: 1750; ka: 0.005/16 }\n' > "$folder/coarse.cascade"
printf 'stage spots: turing_spots { iterations: 28000; ka: 0.005/16 }\n' > "$folder/fine.cascade"
for side in "${@:-256}"; do
    for size in $side; do
        for start in fine coarse; do
            told=$("$cascade" run "$folder/$start.cascade" --grid "${size}x$size" \
                --output "$folder/$start.png" 2>&1 | tail -n 1)
            printf 'large spots %5d² %-10s %s\n' "$size" "$start" "$told"
        done
    done
done
