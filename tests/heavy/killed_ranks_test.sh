#!/usr/bin/env bash
# A rank is killed at a random moment of a run that saves checkpoints, and the run is resumed: what has been saved is
# never lost, and the resumed run ends with the bits of a run without ranks. KILLS sets the number of moments, SEED the
# moments.
set -u
rm -rf ./*
unset NO_COLOR

about="killed ranks"
source "$SOURCE/tests/support/program_runs.bash"
source "$SOURCE/tests/support/open_mpi.bash"
kills=${KILLS:-100}
RANDOM=${SEED:=$RANDOM}
echo "$about: seed $SEED"

printf 'domain { grid: 96, 300 }\nstage long: gray_scott { iterations: %s }\n' "${STEPS:=6000}" >run.cascade
steps_of() { grep -oE '"steps": *[0-9]+' "$1/run.json" 2>/dev/null | head -n 1 | grep -oE '[0-9]+'; }
run 0 run run.cascade -q --save whole -o whole.png

# The time of a run on ranks, from which the moments are drawn.
began=$(date +%s%N)
run 0 run run.cascade --ranks 3 -q --save timed --checkpoint 0.05s -o timed.png
took=$((($(date +%s%N) - began) / 1000000))

killed=0 saved=0 ended=0
for ((k = 0; k < kills; ++k)); do
    ranks=$((2 + RANDOM % 2))
    pause=$((RANDOM * took / 32768))
    rm -rf kept
    "$CASCADE" run run.cascade --ranks $ranks -q --save kept --checkpoint 0.05s -o kept.png >out 2>err </dev/null &
    starter=$!
    sleep "$((pause / 1000)).$(printf '%03d' $((pause % 1000)))"
    launcher=$(pgrep -P $starter | head -n 1)
    mapfile -t pids < <([ -z "$launcher" ] || pgrep -P "$launcher")
    before=$(steps_of kept)
    if [ ${#pids[@]} -gt 0 ] && kill -9 "${pids[RANDOM % ${#pids[@]}]}" 2>/dev/null; then
        killed=$((killed + 1))
    fi
    wait $starter
    status=$?
    [ $status = 0 ] || [ $status = 3 ] || fail "kill $k after $pause ms: status $status"
    [ $status = 0 ] && ended=$((ended + 1))
    after=$(steps_of kept)
    [ "${after:-0}" -ge "${before:-0}" ] || fail "kill $k after $pause ms: $before steps were saved, then ${after:-0}"
    if [ -z "$after" ]; then
        [ -z "$before" ] || fail "kill $k after $pause ms: a saved run is lost"
        continue
    fi
    saved=$((saved + 1))
    run 0 run --resume kept --ranks $((1 + RANDOM % 3)) -q --save kept -o kept.png
    for file in whole/*.npy; do
        cmp "$file" "kept/${file#*/}" || fail "kill $k after $pause ms: the resumed run has other bits"
    done
done
echo "$about: $kills runs of $took ms, $killed ranks killed, $ended runs ended before, $saved resumed from a checkpoint"
[ "$saved" -gt 0 ] || fail "no run has saved anything before a rank was killed"
