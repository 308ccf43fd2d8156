#!/usr/bin/env bash
# Kills runs at single system calls (SIGKILL by strace): runs that save over an older run, and runs with checkpoints.
# There is always a run to resume, which ends with the bits of an uninterrupted run, and no file of the killed runs
# remains. `KILLS=500 ctest -R killed_runs` kills 500 times.
set -u
rm -rf ./*

about="killed runs"
source "$SOURCE/tests/support/program_runs.bash"
skip() { echo "killed runs: $*"; exit 77; }
command -v strace >/dev/null || skip "strace is not there"
strace -o /dev/null true 2>/dev/null || skip "nobody may trace here"
[ -z "$SANITIZE" ] || skip "sanitizers look for leaks in a way that cannot be traced"
kills=${KILLS:-40}

cat >two.cascade <<'END_OF_SCRIPT'
domain { grid: 16, 8; seed: 5 }
stage large: turing_spots { iterations: 300; ka: 1/80 }
stage small: turing_spots { iterations: 200; a: a; b: b; beta: beta; ka: 0.2/16 }
END_OF_SCRIPT
plain=(-q --threads 1 --backend interp --no-kernel-cache -o picture.png)
run 0 run two.cascade "${plain[@]}" --save whole
run 0 run two.cascade "${plain[@]}" --save old --stop-at large:50

saving=(run --resume work "${plain[@]}" --save work --stop-at small:20)
keeping=(run two.cascade "${plain[@]}" --save work --checkpoint 0.000001s)
renew() { rm -rf work && cp -r old work; }

# All system calls at which to kill: calls about files, in both kinds of runs. A program's first calls only load
# libraries.
calls='openat|write|fsync|renameat|unlinkat|flock|close|newfstatat'
places=()
for kind in saving keeping; do
    declare -n arguments=$kind
    renew
    strace -o trace -e "trace=${calls//|/,}" "$CASCADE" "${arguments[@]}" >out 2>err || fail "a traced run failed"
    first=$(grep -nE 'work' trace | head -n 1 | cut -d: -f1)
    for call in ${calls//|/ }; do
        before=$(head -n "$((first - 1))" trace | grep -c "^$call(")
        all=$(grep -c "^$call(" trace)
        for ((n = before + 1; n <= all; ++n)); do places+=("$kind $call $n"); done
    done
done
count=${#places[@]}
[ "$count" -gt 100 ] || fail "only $count places to kill at"
[ "$kills" -le "$count" ] || kills=$count

killed=0
for ((k = 0; k < kills; ++k)); do
    read -r kind call n <<<"${places[$((k * count / kills))]}"
    declare -n arguments=$kind
    renew
    # Hides the shell's message about each killed program.
    { strace -o trace -e "inject=$call:signal=SIGKILL:when=$n" "$CASCADE" "${arguments[@]}" >out 2>err; } 2>/dev/null
    [ $? = 137 ] && killed=$((killed + 1))
    # After an hour, a temporary file of a killed writer is removed.
    find work -name '.cascade-*.tmp' -exec touch -d '2 hours ago' {} +
    "$CASCADE" run --resume work "${plain[@]}" --save work >out 2>err ||
        fail "nothing to resume after a kill of '$kind' at $call $n"
    for file in whole/*.npy; do
        cmp "$file" "work/${file##*/}" || fail "other bits after a kill of '$kind' at $call $n"
    done
    diff <(ls -A work) <(ls -A whole) || fail "something stays after a kill of '$kind' at $call $n"
done
[ "$killed" -ge $((kills * 9 / 10)) ] || fail "only $killed of $kills runs were killed"
echo "killed runs: $killed kills of $count places, no run lost"
