#!/usr/bin/env bash
# Runs on several ranks that mpiexec starts: the same files as one process, whatever the number of ranks, and what
# happens if a rank is given something else, fails, is killed or is interrupted.
set -u
rm -rf ./*
unset NO_COLOR

about="ranks"
source "$SOURCE/tests/support/program_runs.bash"
source "$SOURCE/tests/support/open_mpi.bash"
on() { "${launch[@]}" -n "$1" "$CASCADE" "${@:2}" >out 2>err </dev/null; }

# Every kind of stage: each on a plane and in a volume, with sides, masks, draws, aggregates and parameters that vary.
stages() {
    cat <<'END'
system gs {
  u: 1 - 0.5 * disc(0.5, 0.5, 0.3)
  v: 0.25 * disc(0.5, 0.4, 0.3) + random(0, 0.02)
  k: 0.06 + 0.001 * noise(0.3)
  u' = 0.16 * lap(u) - u * v^2 + 0.037 * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - (0.037 + k) * v
}
system held: gs { v' = 0.08 * lap(v) + u * v^2 - 0.097 * v + 0.01 * (0.1 - mean(v over domain)) }
system shaken: gs { u' = 0.16 * lap(u) - u * v^2 + 0.037 * (1 - u) + 0.01 * normal(0, 1) }
system moved: gs { v' = 0.08 * lap(v) + u * v^2 - 0.097 * v + 0.01 * sin(6 * sx + t) }
stage plain: gs { iterations: 30 }
stage second: gs { iterations: 5; u: plain.u; v: plain.v; frozen: plain.v > 0.2 }
stage mean: held { iterations: 12 }
stage draws: shaken { iterations: 12 }
stage steps: gs { duration: 6; solver: rk45 }
stage stable: gs { duration: 12; speed: 3; solver: rkl2 }
stage fourth: moved { duration: 5; solver: rk4; every: 2 }
stage chosen: gs { duration: 8; speed: auto }
stage ends: gs { iterations: 40; until: max(v over domain) > 0.2; check: 5; u: plain.u; v: plain.v }
END
}
combinations=0
# tests/unit/ranks runs more combinations, on threads.
while IFS='|' read -r counts domain; do
    { echo "domain { $domain }"; stages; } >all.cascade
    log=(--log 'mean(v over domain)' --log-every 3 --log-file)
    run 0 run all.cascade -q --save whole -o whole.png --features "${log[@]}" whole.csv
    mv out whole.features
    for ranks in $counts; do
        on $ranks run all.cascade -q --save shared -o shared.png --features "${log[@]}" shared.csv ||
            fail "$ranks ranks fail with '$domain'"
        cmp out whole.features && cmp shared.csv whole.csv && cmp shared.png whole.png || fail "$ranks ranks differ"
        for file in whole/*.npy; do
            cmp "$file" "shared/${file#*/}" || fail "$ranks ranks differ with '$domain'"
        done
        combinations=$((combinations + 9))
    done
done <<'END'
2 3 4|grid: 21, 18; seed: 3
3|grid: 9, 8, 6; boundary: noflux
2 3|grid: 11, 75; seed: 5
2|grid: 7, 40; boundary: noflux; mask: sy < 0.9
2|grid: 6, 5, 34
2|grid: 20, 15; mask: hypot(sx - 0.5, sy - 0.5) < 0.45
END
[ "$combinations" = 81 ] || fail "$combinations combinations instead of 81"

# --ranks starts the ranks itself. Each message and each file is written once.
run 0 run all.cascade --ranks 3 --save shared -o again.png
[ "$(grep -c . out)" = 2 ] && says out 'wrote again.png' || fail "files are not told once"
[ "$(grep -c 'steps in' err)" = 1 ] || fail "steps are not told once"
cmp again.png whole.png || fail "--ranks differs"
run 0 run all.cascade --ranks 2 -q --timing -o again.png
says err '2 ranks, rank 0 sent '
grep -qE '^  1 on \S+ +[0-9.]+ ms +[0-9.]+ ms +[0-9,]+$' err || fail "no line for rank 1 in --timing"
# Ranks exchange halos of 16 rows before 16 steps, of 2 rows before 2, and of thin parts after each step. If all steps
# fall into one batch between checks, 160 steps take 10 exchanges. Batches end earlier while the program measures their
# time.
exchanges() {
    printf 'domain { grid: 40, %s }\nstage s: gray_scott { iterations: %s }\n' "$1" "$2" >tall.cascade
    run 0 run tall.cascade --ranks 2 -q --timing -o tall.png
    grep -oE 'in [0-9]+ exchanges' err | grep -oE '[0-9]+'
}
few=$(exchanges 256 160)
[ "$few" -ge 10 ] && [ "$few" -le 32 ] || fail "160 steps with halos of 16 rows take $few exchanges"
some=$(exchanges 32 160)
[ "$some" -ge 80 ] && [ "$some" -le 120 ] || fail "160 steps with halos of 2 rows take $some exchanges"
[ "$(exchanges 15 160)" = 161 ] || fail "other than one exchange for each step and one at the start"
run 64 run all.cascade --ranks 2 --mpi lam
says err '--mpi'

# The bytes of halos are the ones that the model of bench/ranks_model.py computes.
python3 "$SOURCE/bench/ranks.py" "$CASCADE" --side 500 --steps 20 --turns 1 --save cost.json >out 2>err ||
    fail "bench/ranks.py fails"
python3 "$SOURCE/bench/ranks_model.py" cost.json --steps 0 >out 2>err || fail "bench/ranks_model.py fails"
[ "$(grep -cE 'measured ([0-9,]+), model \1$' out)" = 2 ] || fail "other bytes of halos than the model computes"

# A run saved by two ranks continues on three, and on one.
run 0 run all.cascade --ranks 2 -q --save half -o again.png --stop-at steps:2
run 0 run --resume half --ranks 3 -q --save on_three -o again.png
run 0 run --resume half -q --save on_one -o again.png
for file in whole/*.npy; do
    cmp "$file" "on_three/${file#*/}" && cmp "$file" "on_one/${file#*/}" || fail "a resumed run differs"
done

# The job script: a job that ends early, and the same job again on another number of nodes.
submit() {
    OMPI_MCA_rmaps_base_oversubscribe=1 SLURM_NTASKS=$1 SLURM_CPUS_PER_TASK=1 CASCADE=$CASCADE SAVED=job PICTURE=job.png \
        bash "$SOURCE/examples/large/run.slurm" "${@:2}" >out 2>err </dev/null || fail "the job script fails"
}
submit 2 all.cascade --stop-at steps:2
submit 3 all.cascade --stop-at steps:2
for file in whole/*.npy; do
    cmp "$file" "job/${file#*/}" || fail "the job script makes other bits"
done
cmp whole.png job.png || fail "the job script draws another picture"

# What is refused: by rank 0 alone, before anything is written.
run 3 run all.cascade --ranks 16 -q -o wrong.png
says err "the 15 rows of the grid cannot be divided among 16 ranks"
[ "$(grep -c 'error' err)" = 1 ] || fail "an error is told more than once"
[ ! -e wrong.png ] || fail "a refused run writes a picture"
run 2 run nowhere.cascade --ranks 2 -q
[ "$(grep -c 'error' err)" = 1 ] || fail "a missing script is told more than once"
run 64 run all.cascade --ranks 0
printf 'domain { surface: sphere; cells: 200 }\nstage skin: scales { founders: 5; duration: 1 }\n' >skin.cascade
run 3 run skin.cascade --ranks 2 -q -o skin.png
says err 'cells that crawl are not divided among ranks'
PATH=$PWD run 3 run all.cascade --ranks 2 -q
says err 'mpiexec of Open MPI, which starts the ranks, is not installed'
cp "$CASCADE" alone
OMPI_COMM_WORLD_SIZE=2 ./alone run all.cascade >out 2>err </dev/null && fail "a rank without its module runs"
says err 'Open MPI could not be loaded'
says err 'install libopenmpi-dev'
on 2 run all.cascade --ranks 3 -q && fail "--ranks 3 is accepted on 2 ranks"
says err '--ranks 3 does not fit the 2 ranks that mpiexec has started'
# With --json one rank writes one object, also if the run fails. Ranks cannot share standard input.
one_object() { python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["status"] == int(sys.argv[2])' out "$1"; }
run 0 run all.cascade --ranks 2 -q -o again.png --json
one_object 0 || fail "--json does not write one object"
on 2 run all.cascade -q -o again.png --json || fail "--json fails with mpiexec"
one_object 0 || fail "--json does not write one object with mpiexec"
run 3 run skin.cascade --ranks 2 -q -o skin.png --json
one_object 3 || fail "--json does not write one object after a failure"
run 64 run - --ranks 2 <all.cascade
says err 'standard input reaches only one of several ranks'
timeout 60 "${launch[@]}" -n 2 "$CASCADE" run - -q >out 2>err <all.cascade
[ $? = 64 ] || fail "ranks read standard input"
says err 'standard input reaches only one of several ranks'

# One rank has another script, other arguments, or does not see the folder.
mkdir one two
cp all.cascade one/all.cascade
sed 's/0.037/0.038/' all.cascade >two/all.cascade
apart() {
    "${launch[@]}" -n 1 --wdir "$PWD/one" "$CASCADE" "$@" : -n 1 --wdir "$PWD/two" "$CASCADE" "$@" \
        >out 2>err </dev/null
}
apart run all.cascade -q
[ $? = 3 ] || fail "another script is accepted"
says err 'rank 1 of 2 on'
says err 'this rank and rank 0 do not have the same script'
rm two/all.cascade
apart run all.cascade -q && fail "a missing folder is accepted"
says err 'rank 1 of 2 on'
[ ! -e one/all.png ] || fail "a run without its second rank writes a picture"

# A failure of the run: the message of one process, once.
printf 'system s { u: 1; u'"'"' = u^3 }\nstage s: s { iterations: 300; speed: 0.1 }\n' >grows.cascade
run 3 run grows.cascade -q
mv err alone.err
run 3 run grows.cascade --ranks 2 -q
cmp err alone.err || fail "a failure is told in other words"

# Ctrl-C ends all ranks. What has been saved can be continued with the same bits.
printf 'domain { grid: 64, 48 }\nstage long: gray_scott { iterations: 100000000 }\n' >long.cascade
begin() {
    rm -rf kept
    "$CASCADE" run long.cascade --ranks 2 -q --save kept --checkpoint 0.2s -o long.png >out 2>err </dev/null &
    starter=$!
    for ((k = 0; k < 300; ++k)); do
        [ -e kept/run.json ] && return
        sleep 0.1
    done
    fail "nothing is saved while ranks run"
}
steps_of() { grep -oE '"steps": *[0-9]+' "$1/run.json" | head -n 1 | grep -oE '[0-9]+'; }
same_as_one_process() {
    local steps
    steps=$(steps_of kept)
    [ "${steps:-0}" -gt 0 ] || fail "no steps are saved"
    run 0 run long.cascade -q --stop-at "long:$steps" --save single -o single.png
    cmp kept/long.u.npy single/long.u.npy && cmp kept/long.v.npy single/long.v.npy || fail "$1: other bits"
}
begin
kill -INT $starter
wait $starter
[ $? = 130 ] || fail "an interrupted run has another status"
says err 'interrupted at stage'
[ -e long.png ] || fail "an interrupted run draws nothing"
same_as_one_process "interrupted"

# A rank is killed.
begin
rank=$(pgrep -P "$(pgrep -P $starter)" | tail -n 1)
kill -9 "$rank"
wait $starter
[ $? = 3 ] || fail "a killed rank gives another status"
says err 'was killed by signal 9'
[ "$(grep -c error err)" = 1 ] || fail "a killed rank is told more than once"
same_as_one_process "killed"
