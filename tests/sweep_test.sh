#!/usr/bin/env bash
# Sweeps, logs, features and limits as a user meets them.
set -u
rm -rf ./*
unset NO_COLOR

about="sweep"
source "$SOURCE/tests/support/program_runs.bash"

cat >spots.cascade <<'END2'
domain { grid: 48, 32 }
stage large: turing_spots { iterations: 400; interval: 100; ka: 1/80 }
stage small: turing_spots { iterations: 200; ka: 1/20; beta: beta; a: a; b: b }
END2
printf 'system s { u: 1; r: 1; u'"'"' = r * u^3 }\nstage s: s { iterations: 300; speed: 0.01 }\n' >grows.cascade
printf 'stage s: turing_spots { iterations: 100000000 }\n' >long.cascade

# A sheet, a table, a result of each run; the same with one run at a time and interpreted.
run 0 sweep spots.cascade --vary large.ka=1/80..1/20:3 --vary seed=1,2
says out 'wrote spots_sweep/sheet.png'
says out 'wrote spots_sweep/features.csv'
says err '6 runs, 3,600 steps in'
[ "$(grep -c . spots_sweep/features.csv)" = 7 ] || fail "a table of other than 6 runs"
[ "$(ls spots_sweep/runs/*.json | wc -l)" = 6 ] || fail "other than 6 results"
run 0 sweep spots.cascade --vary large.ka=1/80..1/20:3 --vary seed=1,2 \
    --threads 1 --backend interp -q -o again
[ ! -s out ] && [ ! -s err ] || fail "quiet is not quiet"
cmp spots_sweep/features.csv again/features.csv || fail "another backend, another table"
cmp spots_sweep/sheet.png again/sheet.png || fail "another backend, another sheet"

cp spots_sweep/sheet.png sheet.png
run 0 sweep sheet.png -q -o sheet_again
cmp sheet.png sheet_again/sheet.png || fail "a sheet does not make itself again"

# A run of a sweep is the run alone.
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30 --fields -q -o fields
run 0 run spots.cascade --set turing_spots.ka=1/30 --save alone -q
cmp 'fields/fields/turing_spots.ka=1_30/small.b.npy' alone/small.b.npy || fail "other bits in a sweep"
run 0 run spots.cascade --set turing_spots.ka=1/30 --features -q
wavelength=$(awk '$1 == "wavelength" { print $2 }' out)
grep -q "^1/30,${wavelength%?}" fields/features.csv || fail "other features in a sweep"

# Results are kept: more values run alone, --force runs all.
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30,1/35 -o fields
says err '3 runs (2 done before), 600 steps'
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30,1/35 -o fields --force
says err '3 runs, 1,800 steps'

# A blow-up: an empty tile, a row that says why, a status.
run 3 sweep grows.cascade --vary r=0.01,0.05,2
says err '1 of 3 runs failed: stage '
says grows_sweep/features.csv 'u is not finite any more'
[ -s grows_sweep/sheet.png ] || fail "a blow-up cost the sheet"

# Wrong use, wrong scripts: nothing is written.
run 64 sweep spots.cascade -o wrong
says err '--vary'
run 64 sweep spots.cascade --vary ka=0..1 -o wrong
says err 'the number of values'
run 64 sweep --vary ka=1,2
run 2 sweep spots.cascade --vary kaa=1,2 -o wrong
says err "no stage has a parameter 'kaa'"
run 3 sweep spots.cascade --vary ka=1,1 -o wrong
says err "stands twice"
[ ! -e wrong ] || fail "a wrong sweep has written"

# Ctrl-C and the limit of time keep what is done.
timeout --preserve-status -s INT 2 "$CASCADE" sweep long.cascade --vary ka=1/80,1/40 >out 2>err
[ $? = 130 ] || fail "Ctrl-C is not 130"
says err 'interrupted; 0 of 2 runs are done'
says long_sweep/features.csv 'not run'
run 124 sweep long.cascade --vary ka=1/80,1/40 --limit-time 1s
says err 'the limit of 1 s is reached; 0 of 2 runs are done'
run 124 run long.cascade --limit-time 0.5s --log t -o limited.png
says err "the limit of 0.5 s is reached at stage 's', step"
[ -s limited.png ] && [ -s limited.csv ] || fail "the limit of time lost the picture"
run 0 run spots.cascade --limit-time 1h
# A sanitizer's own memory knows no limits.
if [ -z "${SANITIZE:-}" ]; then
    run 3 run spots.cascade --grid 4000x4000 --limit-memory 100MB
    says err 'are the limit (--limit-memory)'
    run 0 run spots.cascade --limit-memory 5MB
    # What is not counted beforehand is refused by the system: a file of 800 MB.
    header="{'descr': '<f8', 'fortran_order': False, 'shape': (10000, 10000), }"
    printf '\x93NUMPY\x01\x00\x76\x00%-117s\n' "$header" >large.npy
    truncate -s 800000128 large.npy
    echo 'stage s: turing_spots { iterations: 10; a: field("large.npy") }' >reads.cascade
    run 3 run reads.cascade --limit-memory 100MB
    says err 'there is not enough memory'
    rm large.npy
fi
run 64 run spots.cascade --limit-memory 12
says err 'write 500MB, 2GB or 1.5GiB'
run 64 run spots.cascade --limit-time soon

# A log.
run 0 run spots.cascade --log ka --log 't + 0.5' --log-every 150 -q
[ "$(head -n 3 spots.csv | tr '\n' ' ')" = 'stage,step,t,ka,t + 0.5 large,0,0,0.0125,0.5 large,150,150,0.0125,150.5 ' ] ||
    fail "a log of other rows: $(head -n 3 spots.csv)"
run 0 run spots.cascade --log ka --log-file numbers.csv
says out 'wrote numbers.csv'
run 2 run spots.cascade --log 'a'
says err 'this differs from cell to cell'
run 0 sweep --help
echo "sweep: right"
