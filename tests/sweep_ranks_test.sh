#!/usr/bin/env bash
# Sweeps whose runs several ranks share: the same bytes as one process, and nothing lost if a rank is killed.
set -u
rm -rf ./*
unset NO_COLOR

about="sweeps on ranks"
source "$SOURCE/tests/support/program_runs.bash"
source "$SOURCE/tests/support/open_mpi.bash"

cat >spots.cascade <<'END'
domain { grid: 48, 32 }
stage large: turing_spots { iterations: 400; ka: 1/80 }
stage small: turing_spots { iterations: 200; ka: 1/20; beta: beta; a: a; b: b }
END
vary=(--vary turing_spots.ka=1/40..1/20:5 --vary seed=1,2)
run 0 sweep spots.cascade "${vary[@]}" -q -o whole
same() {
    for file in features.csv ensembles.csv sheet.png; do
        cmp whole/$file $1/$file || fail "$1 has another $file"
    done
}

# Under mpiexec and with --ranks, also with more ranks than runs. Rank 0 alone writes and prints.
for ranks in 2 3; do
    "${launch[@]}" -n $ranks "$CASCADE" sweep spots.cascade "${vary[@]}" -o on_$ranks >out 2>err </dev/null ||
        fail "a sweep fails on $ranks ranks"
    same on_$ranks
    says err '10 runs, 6,000 steps in'
    [ "$(grep -c steps err)" = 1 ] || fail "steps are told more than once"
    [ "$(grep -c wrote out)" = 3 ] || fail "files are told more than once"
    [ "$(ls on_$ranks/runs/*.json | wc -l)" = 10 ] || fail "other than 10 results"
done
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30 --ranks 4 -q -o few
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30 -o few
says err '2 runs (2 done before)'

# The whole sweep takes up what parts and ranks have done; ranks take up a part.
run 0 sweep spots.cascade "${vary[@]}" --ranks 2 --part 2/3 -o mixed
says err 'part 2 of 3: 3 runs, 1,800 steps'
[ ! -e mixed/sheet.png ] || fail "a part draws the sheet"
run 0 sweep spots.cascade "${vary[@]}" --ranks 2 -o mixed
says err '10 runs (3 done before), 4,200 steps'
same mixed
run 0 sweep spots.cascade --vary turing_spots.ka=1/40,1/30 --ranks 2 --fields --film ends.gif -q -o fields
run 0 run spots.cascade --set turing_spots.ka=1/30 --save alone -q
cmp 'fields/fields/turing_spots.ka=1_30/small.b.npy' alone/small.b.npy || fail "other bits on ranks"
[ -s ends.gif ] || fail "ranks write no film"

# Runs that fail are results, with the status and the words of one process.
printf 'system s { u: 1; r: 1; u'"'"' = r * u^3 }\nstage s: s { iterations: 300; speed: 0.01 }\n' >grows.cascade
run 3 sweep grows.cascade --vary r=0.01,0.05,2 -q -o grows
mv err alone.err
run 3 sweep grows.cascade --vary r=0.01,0.05,2 -q --ranks 2 -o grows_on_two
cmp err alone.err || fail "a failure is told in other words"
cmp grows/features.csv grows_on_two/features.csv || fail "ranks write another table"

# A rank with another script, or without it, ends all ranks before the first run.
mkdir one two
cp spots.cascade one
sed 's/1\/80/1\/70/' spots.cascade >two/spots.cascade
apart() {
    "${launch[@]}" -n 1 --wdir "$PWD/one" "$CASCADE" sweep "$@" : -n 1 --wdir "$PWD/two" "$CASCADE" sweep "$@" \
        >out 2>err </dev/null
}
apart spots.cascade "${vary[@]}" -q && fail "another script is accepted"
says err 'rank 1 of 2 on'
says err 'this rank and rank 0 do not have the same script'
[ -z "$(ls one/spots_sweep/runs 2>/dev/null)" ] || fail "a wrong rank lets runs begin"
rm two/spots.cascade
apart spots.cascade "${vary[@]}" -q && fail "a missing folder is accepted"
says err 'rank 1 of 2 on'
# The script is the same, but not a file that it reads.
printf 'stage s: turing_spots { iterations: 10; a: 4 + field("noise.csv") }\ndomain { grid: 2, 2 }\n' >one/reads.cascade
cp one/reads.cascade two
printf '0,1\n1,0\n' >one/noise.csv
printf '0,1\n1,1\n' >two/noise.csv
apart reads.cascade --vary ka=1/20,1/30 -q && fail "another file is accepted"
says err 'this rank and rank 0 do not have the same runs'
run 64 sweep spots.cascade "${vary[@]}" --ranks 0

# A rank is killed: results are kept, and the same command goes on. Ctrl-C ends all ranks.
printf 'domain { grid: 48, 32 }\nstage s: turing_spots { iterations: 100000 }\n' >long.cascade
long=(sweep long.cascade --vary ka=1/80..1/20:40 -o long)
begin() {
    "$CASCADE" "${long[@]}" --ranks 3 >out 2>err </dev/null &
    starter=$!
    for ((k = 0; k < 600; ++k)); do
        [ "$(ls long/runs/*.json 2>/dev/null | wc -l)" -gt "$1" ] && return
        sleep 0.05
    done
    fail "no results are kept while ranks run"
}
begin 3
kill -9 "$(pgrep -P "$(pgrep -P $starter)" | tail -n 1)"
wait $starter
[ $? = 3 ] || fail "a killed rank gives another status"
says err 'was killed by signal 9'
says err 'the same command goes on with the runs that are missing'
kept=$(ls long/runs/*.json | wc -l)
[ "$kept" -lt 40 ] || fail "the rank was killed too late"
begin "$kept"
kill -INT $starter
wait $starter
[ $? = 130 ] || fail "an interrupted sweep has another status"
says err 'interrupted; '
kept=$(ls long/runs/*.json | wc -l)
[ "$kept" -lt 40 ] || fail "the sweep was interrupted too late"
run 0 "${long[@]}" --ranks 2
says err "40 runs ($kept done before)"
run 0 "${long[@]:0:4}" -q -o alone_long
cmp long/features.csv alone_long/features.csv && cmp long/sheet.png alone_long/sheet.png ||
    fail "a sweep that was killed and interrupted has other bytes"

# The job script for several nodes, and the one for arrays of jobs on two machines without a common folder.
OMPI_MCA_rmaps_base_oversubscribe=1 CASCADE=$CASCADE SLURM_NTASKS=2 SLURM_CPUS_PER_TASK=1 \
    bash "$SOURCE/examples/large/sweep_ranks.slurm" spots.cascade "${vary[@]}" -o by_slurm >out 2>err ||
    fail "the job script for ranks fails"
same by_slurm
for node in 1 2; do
    mkdir -p node_$node && cp spots.cascade node_$node
    (cd node_$node && SLURM_ARRAY_TASK_ID=$node SLURM_ARRAY_TASK_COUNT=2 SLURM_CPUS_PER_TASK=1 CASCADE=$CASCADE \
        bash "$SOURCE/examples/large/sweep.slurm" spots.cascade "${vary[@]}" -o results) || fail "node $node fails"
done
run 0 sweep spots.cascade "${vary[@]}" --gather node_1/results --gather node_2/results -o of_nodes
says err '10 runs (10 done before)'
same of_nodes
echo "sweeps on ranks: right"
