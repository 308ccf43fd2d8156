#!/usr/bin/env bash
# SIGTERM and --limit-time while steps are taken: the run is saved, its numbers are written, and an output that would
# take long is left out and named. Each output here takes at least five times as long as may be waited for.
set -u
rm -rf ./*

about="last moments"
source "$SOURCE/tests/support/program_runs.bash"
[ -z "$SANITIZE" ] || { echo "$about: a sanitizer's work counts as the program's"; exit 77; }

plane='domain { grid: 64, 64 } stage s: turing_spots { iterations: 100000000; interval: 100000 }'
model='domain { surface: torus; cells: 2000 } stage s: turing_spots { iterations: 100000000; interval: 200 }'
cells='domain { surface: sphere; cells: 500 } stage s: scales { founders: 300; r: 0.05; duration: 100000 }'
# interrupt NAME SCRIPT OPTIONS…: SIGTERM once a checkpoint shows that steps are taken.
interrupt() {
    local name=$1 script=$2 status
    shift 2
    echo "$script" >"$name.cascade"
    "$CASCADE" run "$name.cascade" --threads 1 --save "$name" --checkpoint 0.2s --log t "$@" >out 2>err </dev/null &
    local process=$!
    until [ -e "$name/run.json" ] || ! kill -0 "$process" 2>/dev/null; do sleep 0.05; done
    kill -TERM "$process"
    wait "$process"
    status=$?
    [ "$status" = 143 ] || fail "$name: status $status"
    grep -qE "and at |ended at once" err || fail "$name: nothing is left out"
    compgen -G '.cascade-*' >/dev/null && fail "$name: a temporary file is left"
    [ -s "$name.csv" ] || fail "$name: the numbers are lost"
    "$CASCADE" run --resume "$name" --steps 1 -q -o resumed.png >resumed.out 2>resumed.err ||
        fail "$name: the run is not saved"
}
no_file() { [ ! -e "$1" ] || fail "$1 is written, so it did not take long"; }

interrupt plane "$plane" -o plane.png --size 12000x12000
no_file plane.png
interrupt traced "$model" -o traced.png --size 4000x3000 --quality fine
no_file traced.png
interrupt baked "$model" -o baked.glb --bake 8192
no_file baked.glb
interrupt crawling "$cells" -o crawling.png --size 4000x3000 --quality fine
no_file crawling.png
interrupt turning "$model" -o turning.gif --turntable 400 --quality fine
# Films end after the present frame.
if [ -e turning.gif ]; then
    [ "$(tail -c 1 turning.gif)" = ';' ] || fail "the film has no end"
fi
# The first step of many cells takes many attempts.
crowd='domain { surface: sphere; cells: 2000 } stage s: scales { founders: 20000; r: 0.01; duration: 2000 }'
echo "$crowd" >crowd.cascade
run 124 run crowd.cascade --threads 1 -o crowd.npz --save crowd --limit-time 2s
says err "the limit of 2 s is reached at stage 's', step"
[ -e crowd/run.json ] || fail "the limit lost the crowd"

# A limit of time, too: a tenth of it, but at least as long as after SIGTERM.
echo "$plane" >limited.cascade
run 124 run limited.cascade --threads 1 -o limited.png --size 12000x12000 --save limited --log t --limit-time 2s
grep -qE "and at the drawing of limited.png|ended at once" err || fail "the picture does not know of the limit"
no_file limited.png
[ -e limited/run.json ] && [ -s limited.csv ] || fail "the limit lost the run"

# Nothing is lost before the first step. The weights of this convolution take longer than may be waited for, unless
# they end just then. The stage warns of a product that single precision loses just before it computes them.
cat >weights.cascade <<'END'
system n { u: random(0, 1); a: 1e-20; k: 1e21; u' = convolve(exp(-(distance / 500)^2), u) - u; a' = -k * (a * a) }
domain { grid: 4096, 4096 }
stage s: n { speed: 0.1; iterations: 100 }
END
"$CASCADE" run weights.cascade --threads 1 -o weights.png >out 2>err </dev/null &
process=$!
until grep -q "too small for single precision" err || ! kill -0 "$process" 2>/dev/null; do sleep 0.05; done
kill -TERM "$process"
wait "$process"
[ $? = 143 ] || fail "weights: the status is wrong"
grep -qE "cascade: (ended at once|interrupted at stage 's', step 0 of 100)" err || fail "weights: $(cat err)"
no_file weights.png

# An output that takes little time is written as usual.
echo "$plane" >quick.cascade
timeout --preserve-status -s TERM 2 "$CASCADE" run quick.cascade -o quick.png -o quick.gif >out 2>err
[ $? = 143 ] && [ -s quick.png ] && [ -s quick.gif ] || fail "quick outputs are lost"

# Work without a run: a model, and a sweep.
cp "$SOURCE/tests/support/octahedron.off" .
timeout --preserve-status -s TERM 1 "$CASCADE" mesh octahedron.off --subdivide 6 --cells 3000000 >out 2>err
[ $? = 143 ] || fail "mesh does not end by SIGTERM"
timeout --preserve-status -s TERM 1 "$CASCADE" sweep quick.cascade --vary ka=1/80,1/60 >out 2>err
[ $? = 143 ] || fail "sweep does not end by SIGTERM"
echo "last moments: right"
