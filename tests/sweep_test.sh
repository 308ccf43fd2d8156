#!/usr/bin/env bash
# Sweeps, logs, features and limits on the command line.
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

# A sheet, a table and a result of each run. They are the same with one run at a time and with the interpreter.
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

# A run of a sweep has the bits of the same run alone.
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30 --fields -q -o fields
run 0 run spots.cascade --set turing_spots.ka=1/30 --save alone -q
cmp 'fields/fields/turing_spots.ka=1_30/small.b.npy' alone/small.b.npy || fail "other bits in a sweep"
run 0 run spots.cascade --set turing_spots.ka=1/30 --features -q
wavelength=$(awk '$1 == "wavelength" { print $2 }' out)
grep -q "^1/30,${wavelength%?}" fields/features.csv || fail "other features in a sweep"

# Results are stored: with more values only the new ones run, and --force runs all.
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30,1/35 -o fields
says err '3 runs (2 done before), 600 steps'
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30,1/35 -o fields --force
says err '3 runs, 1,800 steps'

# Parts that run at the same time, one of them twice and one killed: the same bytes as one process.
vary="--vary turing_spots.ka=1/40..1/20:5 --vary seed=1,2"
run 0 sweep spots.cascade $vary -q -o whole
for part in 1 2 2 3; do
    "$CASCADE" sweep spots.cascade $vary -q --part $part/3 -o parts &
done
"$CASCADE" sweep spots.cascade $vary -q --part 3/3 -o parts &
kill -9 $!
wait
[ ! -e parts/sheet.png ] && [ ! -e parts/features.csv ] || fail "a part draws the sheet"
run 0 sweep spots.cascade $vary -o parts
says err '10 runs (10 done before)'
cmp whole/features.csv parts/features.csv && cmp whole/sheet.png parts/sheet.png || fail "parts make another sheet"
run 0 sweep spots.cascade $vary --part 2/4 -o second
says err 'part 2 of 4: 3 runs, 1,800 steps'
[ "$(ls second/runs/*.json | wc -l)" = 3 ] || fail "a part takes other runs"
run 0 sweep spots.cascade $vary --part 1/4 --force -q -o first
run 0 sweep spots.cascade $vary --gather first --gather second -o gathered
says err '10 runs (6 done before)'
cmp whole/features.csv gathered/features.csv && cmp whole/sheet.png gathered/sheet.png || fail "gathered results differ"
run 3 sweep grows.cascade --vary r=0.01,0.05,2 --part 3/3 -o grown
says err '1 of 1 run failed'
for wrong in 0/3 4/3 3 a/b 1/0 1/3/2 -1/3; do
    run 64 sweep spots.cascade $vary --part=$wrong -o wrong
    says err "'$wrong' is not a part of a sweep"
done
run 3 sweep spots.cascade $vary --part 1/11 -o wrong
says err '11 parts are too many for the 10 runs of the sweep'
run 3 sweep spots.cascade $vary --part 1/2 --film a.gif -o wrong
says err 'a part of a sweep cannot write a film'
run 3 sweep spots.cascade $vary --part 1/2 --curve mean -o wrong
says err 'a part of a sweep cannot draw a curve'
run 3 sweep spots.cascade $vary --gather nowhere -o wrong
says err "'nowhere' holds no results of a sweep"
run 3 sweep spots.cascade $vary --gather first --fields -o wrong
says err '--fields cannot be used with --gather, which copies results without fields'
[ ! -e wrong ] || fail "a wrong part has written"

# The job script of the documentation, with a stand-in for Slurm that runs the jobs of an array.
submit() {
    local jobs=$1
    shift
    for ((job = 1; job <= jobs; ++job)); do
        SLURM_ARRAY_TASK_ID=$job SLURM_ARRAY_TASK_COUNT=$jobs SLURM_CPUS_PER_TASK=1 CASCADE=$CASCADE \
            bash "$SOURCE/examples/large/sweep.slurm" "$@" || fail "a job of Slurm failed"
    done
}
submit 3 spots.cascade $vary -o jobs
[ ! -e jobs/sheet.png ] || fail "jobs draw the sheet"
submit 1 spots.cascade $vary -o jobs
cmp whole/sheet.png jobs/sheet.png || fail "jobs make another sheet"

# Ensembles: a run for each seed, a table with means, and a curve.
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30 --seeds 1..3 --curve wavelength -o ensemble
says out 'wrote ensemble/ensembles.csv'
says out 'wrote ensemble/wavelength.svg'
says err '6 runs, '
python3 - ensemble <<'END3' || fail "the means are not those of the runs"
import csv, statistics, sys
runs = list(csv.DictReader(open(sys.argv[1] + "/features.csv")))
for row in csv.DictReader(open(sys.argv[1] + "/ensembles.csv")):
    values = [float(run[row["number"]]) for run in runs if run["turing_spots.ka"] == row["turing_spots.ka"]]
    assert int(row["runs"]) == len(values) == 3
    half = 4.30265 * statistics.stdev(values) / 3 ** 0.5
    for name, value in ("mean", statistics.mean(values)), ("deviation", statistics.stdev(values)), ("high", statistics.mean(values) + half):
        assert abs(float(row[name]) - value) <= 1e-6 * max(1, abs(value)), (row, name, value)
END3
[ "$(grep -c '<circle' ensemble/wavelength.svg)" = 2 ] || fail "a curve without two means"
run 0 sweep ensemble/sheet.png -q -o ensemble_again
cmp ensemble/ensembles.csv ensemble_again/ensembles.csv || fail "a sheet forgets its seeds"
run 64 sweep spots.cascade --seeds 3..1 -o wrong
says err 'the first seed is above the last'
run 3 sweep spots.cascade --seeds 1..2 --vary seed=1,2 -o wrong
says err "'seed' is varied twice"
run 3 sweep spots.cascade --seeds 1..2 --curve wavelength -o wrong
says err 'a curve needs a varied name other than the seed'

# Numbers over time in every run, and their means: the rows of a run are those of `cascade run --log`.
cat >decays.cascade <<'END4'
system decays { u: random(1, 2); k: 0.1; u' = -k * u }
domain { grid: 16, 16 }
stage first: decays { solver: rk4; speed: 0.5; iterations: 20; interval: 10 }
stage second: decays { u: u; solver: rk4; speed: 0.5; iterations: 10; interval: 10 }
END4
logs=(--log 'm=mean(u over domain)' --log deviation)
run 0 sweep decays.cascade --vary k=0.1,0.2 --seeds 1..4 "${logs[@]}" -q -o logged
for k in 0.1 0.2; do
    for seed in 1 4; do
        run 0 run decays.cascade --set k=$k --seed $seed "${logs[@]}" --log-file one.csv -q
        [ "$(grep "^$k,$seed," logged/logs.csv)" = "$(sed "1d; s/^/$k,$seed,/" one.csv)" ] || fail "a log of other rows in a sweep"
    done
done
python3 - logged <<'END4' || fail "the means of logs are not those of the runs"
import csv, math, statistics, sys
rows = list(csv.DictReader(open(sys.argv[1] + "/logs.csv")))
means = list(csv.DictReader(open(sys.argv[1] + "/log_ensembles.csv")))
assert len(rows) == 2 * 4 * 5 and len(means) == 2 * 2 * 5, (len(rows), len(means))
for row in means:
    at = ("k", "stage", "step", "t")
    values = [float(r[row["number"]]) for r in rows if all(r[name] == row[name] for name in at)]
    assert int(row["runs"]) == len(values) == 4
    half = 3.182446 * statistics.stdev(values) / 2
    assert math.isclose(float(row["mean"]), statistics.mean(values), rel_tol=1e-6)
    assert math.isclose(float(row["high"]), statistics.mean(values) + half, rel_tol=1e-6)
# Theory: the mean of u decays with the rate k.
first = [row for row in means if row["number"] == "m" and row["stage"] == "first"]
for k in ("0.1", "0.2"):
    start, end = [float(row["mean"]) for row in first if row["k"] == k][::2]
    assert abs(math.log(start / end) - 10 * float(k)) < 1e-5, (start, end)
END4
run 0 sweep decays.cascade --vary k=0.1,0.2 --seeds 1..4 "${logs[@]}" -o logged
says err '8 runs (8 done before)'
run 0 sweep decays.cascade --vary k=0.1,0.2 --seeds 1..4 --log 'm=mean(u over domain)' --every 4 -o logged
says err '8 runs, '
cut -d, -f2,4 logged/log_ensembles.csv | sort -u >times
for t in 0 4 8 10; do grep -qx "first,$t" times || fail "no row at t = $t"; done
run 0 sweep decays.cascade --vary k=0.1,0.2 --seeds 1..4 --log 'm=mean(u over domain)' --every 4 -q --force --threads 1 -o logged_again
cmp logged/log_ensembles.csv logged_again/log_ensembles.csv || fail "one thread, other means of logs"
run 2 sweep decays.cascade --vary k=0.1 --log u -o wrong
says err 'this value differs from cell to cell'
run 64 sweep decays.cascade --vary k=0.1 --every 2 -o wrong
says err '--log'
[ ! -e wrong ] || fail "a wrong log has written"

# A run with many seeds is a sweep.
run 0 run decays.cascade --seeds 1..4 "${logs[@]}" -o seeds
says out 'wrote seeds/log_ensembles.csv'
run 0 sweep decays.cascade --seeds=1..4 "${logs[@]}" -q -o seeds_again
for file in features.csv logs.csv ensembles.csv log_ensembles.csv sheet.png; do
    cmp seeds/$file seeds_again/$file || fail "run --seeds writes another $file"
done
run 64 run decays.cascade --seeds 1..4 --series a.npy
says err 'cascade sweep: there is no option --series'
run 64 run decays.cascade --seeds 1..4 --features
says err 'features.csv has the features of every run'
run 64 run decays.cascade --seeds 1..4 -o picture.png
says err "this option writes a folder"

# A blow-up: an empty picture in the sheet, a row with the reason, and status 3.
run 3 sweep grows.cascade --vary r=0.01,0.05,2
says err '1 of 3 runs failed: stage '
says grows_sweep/features.csv 'u is not finite any more'
[ -s grows_sweep/sheet.png ] || fail "a blow-up cost the sheet"

# Wrong use and scripts with errors: nothing is written.
run 64 sweep spots.cascade -o wrong
says err '--vary'
run 64 sweep spots.cascade --vary ka=0..1 -o wrong
says err 'the number of values'
run 64 sweep --vary ka=1,2
run 2 sweep spots.cascade --vary kaa=1,2 -o wrong
says err "error: --vary kaa=1: no stage has a parameter 'kaa'"
run 3 sweep spots.cascade --vary ka=1,1 -o wrong
says err "occurs twice"
[ ! -e wrong ] || fail "a wrong sweep has written"

# Ctrl-C and the limit of time keep the results so far.
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
# Sanitizers need too much memory for limits.
if [ -z "${SANITIZE:-}" ]; then
    run 3 run spots.cascade --grid 4000x4000 --limit-memory 100MB
    says err 'are the limit (--limit-memory)'
    run 0 run spots.cascade --limit-memory 5MB
    # Memory that is not estimated beforehand is limited by the system: a file of 800 MB.
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
says err 'this value differs from cell to cell'
run 0 sweep --help
echo "sweep: right"
