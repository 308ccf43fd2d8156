#!/bin/bash
# `cascade run --timing`: every part is printed, and the parts add up.
set -u
rm -rf ./*
about=timing
. "$SOURCE/tests/support/program_runs.bash"

printf 'domain { grid: 48, 32 }\nstage large: turing_spots { iterations: 400 }\nstage small: turing_spots { iterations: 200; a: a; b: b; beta: beta }\n' >spots.cascade
printf 'system s { u: 1; r: 1; u'"'"' = r * u^3 }\nstage s: s { iterations: 300; speed: 0.01 }\n' >grows.cascade

# adds_up: the lines that are not indented add up to the last line, except for rounding.
adds_up() {
    awk '/ m?s +[0-9.]+ %/ && !/^ / {
             for (k = 2; k < NF; ++k) if ($(k + 2) == "%" && ($k == "ms" || $k == "s")) {
                 ms = $(k - 1) * ($k == "s" ? 1000 : 1); share = $(k + 1)
                 rounding = $k == "s" ? 5 : 0.5
             }
             if ($1 == "everything") { all = ms; whole = share } else { sum += ms; parts += share; ++lines }
         }
         END { exit !(lines == 8 && all > 0 && whole == 100 && sum - all < rounding && all - sum < rounding &&
                      parts > 99 && parts < 101) }' err || fail "the parts do not add up"
}
parts_are_there() {
    for part in 'program start' 'read and check' 'cells of the model' 'starting values' compile steps \
                'pictures and files' 'the rest' everything; do
        grep -q "^$part  *[0-9.]* m*s  *[0-9.]* %" err || fail "no line of '$part'"
    done
}

run 0 run spots.cascade --timing
parts_are_there
adds_up
says err '400 steps, '
says err '200 steps, '
says err 'cell-steps/s'
grep -q '^  large ' err || fail "no line of a stage"
grep -q '▆' err && fail "bars in a pipe"

# The table is printed even with -q, and after a failed run; without --timing it is not.
run 0 run spots.cascade --timing -q --until-stage large
parts_are_there
adds_up
# Code that was compiled after the last step of the previous run was also stored.
[ "$CASCADE_JIT" != 1 ] || says err 'found on disk'
grep -q '^  large ' err && fail "a stage alone has lines of its own"
run 3 run grows.cascade --timing
parts_are_there
adds_up
run 0 run spots.cascade
grep -q everything err && fail "a table nobody asked for"
run 2 run nothing.cascade --timing

# Cells of a model take time, too.
run 0 run spots.cascade --mesh sphere --cells 100 --timing -q -o cells.npz
adds_up
awk '/^cells of the model/ { exit !($5 > 0) }' err || fail "cells came for nothing"
exit 0
