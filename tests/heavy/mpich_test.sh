#!/usr/bin/env bash
# Ranks with MPICH write the bytes of one process, and failures are told as with Open MPI.
set -u
rm -rf ./*
unset NO_COLOR

about="mpich"
source "$SOURCE/tests/support/program_runs.bash"
skip() { echo "mpich: $*"; exit 77; }
[ -e "$BUILD/libcascade_mpich.so" ] || skip "this build has no MPICH"
command -v mpiexec.mpich >/dev/null || skip "mpiexec.mpich is not installed"

cat >all.cascade <<'END'
system gs {
  u: 1 - 0.5 * disc(0.5, 0.5, 0.3)
  v: 0.25 * disc(0.5, 0.4, 0.3) + random(0, 0.02)
  u' = 0.16 * lap(u) - u * v^2 + 0.037 * (1 - u) + 0.01 * (0.1 - mean(v over domain))
  v' = 0.08 * lap(v) + u * v^2 - 0.097 * v
}
stage plain: gs { iterations: 30 }
stage steps: gs { duration: 6; solver: rk45; u: plain.u; v: plain.v }
stage stable: gs { duration: 12; speed: 3; solver: rkl2; u: steps.u; v: steps.v }
END
# Planes, volumes and models.
while IFS='|' read -r name options; do
    run 0 run all.cascade $options -q --save whole -o whole.png
    for ranks in 2 3; do
        mpiexec.mpich -n $ranks "$CASCADE" run all.cascade $options -q --save shared -o shared.png >out 2>err </dev/null ||
            fail "MPICH fails with $name"
        cmp whole.png shared.png || fail "$ranks ranks differ with $name"
        for file in whole/*.npy; do
            cmp "$file" "shared/${file#*/}" || fail "$ranks ranks differ with $name"
        done
    done
    rm -r whole shared
done <<'END'
a plane|--grid 21x18
a volume|--grid 9x8x6
a model|--mesh sphere --cells 500
END

# --mpi chooses the library, and both give the same bytes. A message names the library that is missing.
run 0 run all.cascade --grid 21x18 -q -o whole.png
for mpi in mpich openmpi; do
    [ -e "$BUILD/libcascade_$mpi.so" ] || continue
    run 0 run all.cascade --grid 21x18 --ranks 3 --mpi $mpi -o $mpi.png
    [ "$(cat out)" = "wrote $mpi.png" ] || fail "another output with $mpi"
    [ "$(grep -c 'steps in' err)" = 1 ] || fail "steps are not told once with $mpi"
    cmp whole.png $mpi.png || fail "$mpi differs"
done
run 3 run all.cascade --grid 21x18 --ranks 30 --mpi mpich -q
says err 'the 18 rows of the grid cannot be divided among 30 ranks'
[ "$(grep -c . err)" -le 3 ] || fail "MPICH explains an error that Cascade has told"
PATH=$PWD run 3 run all.cascade --grid 21x18 --ranks 2 --mpi mpich -q
says err 'mpiexec of MPICH, which starts the ranks, is not installed'
says err 'install libmpich-dev and mpich'
mpiexec.mpich -n 2 "$CASCADE" run all.cascade --grid 21x18 --mpi openmpi -q >out 2>err </dev/null &&
    fail "another library than the launcher's is accepted"

# Sweeps.
run 0 sweep all.cascade --grid 21x18 --vary seed=1,2,3,4,5 -q -o swept
mpiexec.mpich -n 3 "$CASCADE" sweep all.cascade --grid 21x18 --vary seed=1,2,3,4,5 -q -o shared >out 2>err </dev/null ||
    fail "a sweep fails with MPICH"
cmp swept/sheet.png shared/sheet.png && cmp swept/features.csv shared/features.csv || fail "a sweep differs"

# A rank is killed, and Ctrl-C.
printf 'domain { grid: 64, 48 }\nstage long: gray_scott { iterations: 100000000 }\n' >long.cascade
begin() {
    rm -rf kept
    "$CASCADE" run long.cascade --ranks 2 --mpi mpich -q --save kept --checkpoint 0.2s -o long.png >out 2>err </dev/null &
    starter=$!
    for ((k = 0; k < 300; ++k)); do
        [ -e kept/run.json ] && return
        sleep 0.1
    done
    fail "nothing is saved while ranks run"
}
# ranks_of PROCESS: the processes of ranks below it.
ranks_of() {
    local child
    for child in $(pgrep -P "$1"); do
        [ "$(readlink "/proc/$child/exe")" = "$CASCADE" ] && echo "$child"
        ranks_of "$child"
    done
}
begin
kill -9 "$(ranks_of $starter | tail -n 1)"
wait $starter
[ $? = 3 ] || fail "a killed rank gives another status"
says err 'rank 1 on '
says err 'was killed by signal 9'
[ "$(grep -c error err)" = 1 ] || fail "a killed rank is told more than once"
grep -q 'BAD TERMINATION' out err && fail "MPICH explains a killed rank, too"
begin
kill -INT $starter
wait $starter
[ $? = 130 ] || fail "an interrupted run has another status"
says err 'interrupted at stage'
echo "mpich: right"
