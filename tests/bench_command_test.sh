#!/bin/bash
# `cascade bench`: its numbers are complete and consistent, and bad input is refused. No time is asserted.
set -u
rm -rf ./*
about=bench
. "$SOURCE/tests/support/program_runs.bash"

printf 'domain { grid: 48, 32 }\nstage large: turing_spots { iterations: 400 }\nstage small: turing_spots { iterations: 200; a: a; b: b; beta: beta }\n' >spots.cascade
printf 'system s { u: 1; r: 1; u'"'"' = r * u^3 }\nstage s: s { iterations: 300; speed: 0.01 }\n' >grows.cascade
printf 'system heat { u: random(0.5, 0.5); d: 0.1; u'"'"' = d * lap(u) }\nstage s: heat { iterations: 3; speed: 1 }\n' >heat.cascade

# A table for each stage.
run 0 bench spots.cascade --seconds 0.02
[ "$(grep -c "^spots.cascade, stage '" out)" = 2 ] || fail "other than two tables"
says out "stage 'small': euler, 48 × 32 cells, single"
says out 'cell-steps/s'
says out 'a cell-step'
if [ "$CASCADE_JIT" = 1 ] || [ "$CASCADE_JIT" = ON ]; then
    says out 'arithmetic'
    says out 'first-level cache'
    says out 'memory'
    [ "$(grep -c '^  roofline  *[0-9.]* [kMGT] cell-steps/s' out)" = 2 ] || fail "no roofline"
    [ "$(grep -c '^  bound by  *[a-z]' out)" = 2 ] || fail "nothing bounds it"
fi
[ -z "$(ls | grep -v -e '\.cascade$' -e '^out$' -e '^err$')" ] || fail "a file was written"

# A program without its code generator interprets, and says so in every line.
if [ "$CASCADE_JIT" = 1 ] || [ "$CASCADE_JIT" = ON ]; then
    mkdir -p alone/bin
    cp "$CASCADE" alone/bin/cascade
    alone/bin/cascade bench spots.cascade --stage 1 --seconds 0.02 --no-kernel-cache >out 2>err ||
        fail "it needs a code generator"
    says err 'the code generator could not be loaded'
    says out "euler, 48 × 32 cells, single, interpreted"
    says out 'bound by          the interpreter'
    rm -r alone
fi

# Every row has all columns, with positive and consistent numbers.
consistent() {
    awk -F, -v rows="$1" 'NR == 1 { columns = NF; next }
        { good += NF == columns && $10 > 0 && $11 > 0 && $12 > 0 && $13 > 0 && $14 > 0 && $15 > 0 && $16 > 0
          cells = $4 * $5 * $6; ratio = $11 * $12 / cells
          close_to += ratio > 0.9999 && ratio < 1.0001 }
        END { exit !(NR == rows + 1 && good == rows && close_to == rows) }' out || fail "numbers do not fit"
}
run 0 bench spots.cascade heat.cascade --seconds 0.02 --csv
consistent 3
run 0 bench spots.cascade --seconds 0.02 --csv --stage 2 --grid 20x10x4 --threads 1 --precision double
consistent 1
says out 'spots.cascade,small,euler,20,10,4,double,'
run 0 bench spots.cascade --seconds 0.02 --csv --stage large --solver rk4
consistent 1
run 0 bench spots.cascade --seconds 0.02 --csv --mesh sphere --cells 500
consistent 2
run 0 bench spots.cascade --seconds 0.02 --backend interp --stage 1
says out interpreted
says out 'steps are interpreted'

if grep -qw fma /proc/cpuinfo; then
    run 0 bench spots.cascade --seconds 0.02 --stage 1 --fast
    says out "stage 'large': euler, 48 × 32 cells, single, fast, "
    run 0 bench spots.cascade --seconds 0.02 --csv --stage 1 --fast
    consistent 1
    [ "$(tail -n 1 out | cut -d, -f20)" = 1 ] || fail "the row does not say that it is fast"
fi
for flag in --fast --csv --quiet; do
    run 64 bench spots.cascade "$flag=3"
    says err "$flag takes no value"
done

# Stages with nothing to measure.
printf 'stage s: turing_spots { iterations: 0 }\n' >none.cascade
run 0 bench none.cascade --seconds 0.02
says out 'it takes no step'
printf 'stage s: turing_spots { iterations: 100; frozen: 1 }\n' >frozen.cascade
run 0 bench frozen.cascade --seconds 0.02
says out 'nothing moves in it'
# A stage that ends soon and starts again and again.
printf 'stage s: turing_spots { until: t > 2; iterations: 100 }\n' >short.cascade
run 0 bench short.cascade --seconds 0.02 --csv

# Bad input.
run 64 bench
says err 'a script is missing'
run 2 bench nothing.cascade
printf 'domain { grid: 8, 8 }\n' >empty.cascade
run 2 bench empty.cascade
says err 'no stage'
for seconds in 0 -1 1e9 nan inf x ''; do run 64 bench spots.cascade --seconds "$seconds"; done
for stage in 0 3 -1 medium 99999999999999999999; do
    run 3 bench spots.cascade "--stage=$stage"
    says err "no stage is called '$stage'"
done
run 3 bench grows.cascade --seconds 0.1
says err "stage 's'"
says err 'finite'
run 0 bench spots.cascade --seconds 0.02 --csv --until-stage large
consistent 1

# A script that fails does not prevent the output for the others. Ctrl-C and the limit of time end the command.
run 3 bench grows.cascade heat.cascade --seconds 0.02 --csv
says out 'heat.cascade,s,'
run 124 bench spots.cascade --seconds 100 --limit-time 0.3s
says err 'the limit of 0.3 s is reached'
timeout --preserve-status -s INT 1 "$CASCADE" bench spots.cascade --seconds 1000 >out 2>err
got=$?
[ $got = 130 ] || fail "Ctrl-C gave $got"
says err interrupted
exit 0
