#!/usr/bin/env bash
# The program on the command line: exit statuses, streams, files, Ctrl-C.
set -u
rm -rf ./* && mkdir kept
unset NO_COLOR

about="command line"
source "$SOURCE/tests/support/program_runs.bash"

cat >spots.cascade <<'END'
stage large: turing_spots { iterations: 400; interval: 100; ka: 1/80 }
stage small: turing_spots { iterations: 200; ka: 1/20; beta: beta; a: a; b: b }
END
printf 'stage s: turing_spots {\n  betta: 2\n}\n' >wrong.cascade
printf 'stage s: turing_spots { iterations: 100000000 }\n' >long.cascade
printf 'system s { u: 1; u'"'"' = u^3 }\nstage s: s { iterations: 1000 }\n' >explodes.cascade

# What is written to standard output and standard error.
run 0 run spots.cascade
says out 'wrote spots.png'
says err "stage 1/2 'large': 400 of 400 steps"
says err "stage 2/2 'small': 200 of 200 steps"
grep -q $'\r\|\x1b' out err && fail "control characters in a pipe"
cp spots.png first.png
run 0 run spots.cascade --quiet --threads 1 --backend interp -o second.png
[ ! -s out ] && [ ! -s err ] || fail "quiet is not quiet"
cmp -s first.png second.png || fail "another backend, another picture"
mkdir again && cp first.png again/
(cd again && "$CASCADE" run first.png -q && cmp -s first-again.png ../first.png) ||
    fail "a picture does not make itself again"
"$CASCADE" run - -q <spots.cascade && [ -s cascade.png ] || fail "standard input is no script"

# --fast: the code contains fused operations, and the picture has other numbers and contains the option.
if grep -qw fma /proc/cpuinfo; then
    run 0 run spots.cascade --fast --dump ir
    says out 'multiply_add'
    run 0 run spots.cascade --dump ir
    ! grep -q multiply_add out || fail "multiply_add without --fast"
    run 0 run spots.cascade -q --fast -o fast.png
    cmp -s first.png fast.png && fail "--fast changes nothing"
    run 0 run spots.cascade -q --fast --backend interp --threads 1 -o fast_again.png
    cmp -s fast.png fast_again.png || fail "another backend, another picture with --fast"
    run 0 run fast.png -q -o fast_again.png
    cmp -s fast.png fast_again.png || fail "a picture forgets --fast"
fi

# Files beside the picture.
run 0 run spots.cascade --sheet sheet.png --frames film --save kept --scale 2
says out 'wrote sheet.png'
says out 'pictures in film'
[ -s kept/small.b.npy ] && [ -s kept/run.json ] || fail "nothing was saved"
run 0 run spots.cascade -q --save half --stop-at large:150 -o half.png
run 0 run --resume half -q -o resumed.png
run 0 run --resume half -q --save all
cmp all/small.b.npy kept/small.b.npy || fail "a resumed run has other bits"
run 2 run explodes.cascade --resume half
says err 'differs from the script of the run saved in half'
run 2 run --resume half --set small.ka=1/50
says err '--steps, --until-stage and --allow-read can change, and --mesh'
run 0 run --resume half -o resumed.png
grep -q 'another text' err && fail "the script of the saved run is as it was"
mkdir edited && cp -r half edited/half && sed 's/^/ /' spots.cascade >edited/spots.cascade
(cd edited && "$CASCADE" run --resume half -o resumed.png >../out 2>../err) || fail "an edited script stops the resumed run"
says err 'spots.cascade differs from the script of the saved run, so the run continues with its own script'
cmp -s edited/resumed.png resumed.png || fail "an edited script changes the resumed run"

# Scripts with errors: status 2, and nothing is written.
rm -f wrong.png
run 2 run wrong.cascade
says err "wrong.cascade:2:3: error: 'betta' is not a parameter of turing_spots"
says err "did you mean 'beta'?"
[ ! -e wrong.png ] && [ ! -s out ] || fail "a wrong script was run"
run 2 check spots.cascade wrong.cascade
says out 'spots.cascade: no errors (2 stages, 600 steps, 64 × 64 cells)'
run 2 run missing.cascade
says err 'missing.cascade'
[ "$(grep -c error: err)" = 1 ] || fail "one fault, one message"
run 2 run kept
: >empty.cascade
run 2 check empty.cascade
run 2 run spots.cascade --set large.kaa=1
run 2 run spots.cascade --until-stage larg
run 2 run spots.cascade --show 'large.c'

# Failed runs: status 3.
run 3 run explodes.cascade
says err "stage 's' (s): u is not finite any more at column 0, row 0, after step 6"
run 3 run spots.cascade -o no_such_folder/spots.png
says err 'no_such_folder'
[ -c /dev/full ] && { "$CASCADE" systems >/dev/full 2>err && fail "a full disk is no success"; }

# Wrong use: status 64.
run 64
run 64 run spots.cascade --pallete tan
says err 'did you mean --palette?'
run 64 fly

# --dump of every form; a script with errors still has tokens and a tree.
for stage in tokens ast program graph ir wgsl; do
    run 0 check spots.cascade --dump "$stage"
    [ -s out ] && [ ! -s err ] || fail "--dump $stage"
done
if [ "$CASCADE_JIT" = 1 ]; then
    for stage in llvm asm; do
        run 0 run spots.cascade --dump "$stage"
        [ -s out ] || fail "--dump $stage"
    done
fi
run 0 check spots.cascade --dump wgsl
says out 'fn c_kernel_0('
run 3 check spots.cascade --dump wgsl --precision double
says err 'WGSL has no double precision'
run 2 check wrong.cascade --dump tokens
[ -s out ] || fail "no tokens of a wrong script"
run 2 check wrong.cascade --dump ir
[ ! -s out ] || fail "kernels of a wrong script"

run 0 systems
for name in turing_spots autocatalysis stripes; do says out "$name"; done
[ "$(wc -l <out)" -gt 30 ] && grep -q '^gray_scott  *Gray-Scott: ' out || fail "a line for each system"
run 0 systems turing_spots
grep -Eq '^  parameter beta +random\(12, ?0\.1\)' out || fail "a default as its author wrote it"
says out '∂a/∂t = ka (16 − a b) + diff_a ∇²a'
says out 'A. M. Turing, Philosophical Transactions'
run 0 systems PEARSON science
grep -q '^gray_scott ' out && ! grep -q '^turing_spots' out || fail "systems by word"
run 64 systems zebrafish
says err "'zebra' is mentioned by "
run 64 systems brusselater
says err "did you mean 'brusselator'?"
run 0 systems explodes.cascade
says out '∂u/∂t = u³'
run 64 systems explodes.cascade other
run 0 new brusselator
cp out brusselator.cascade
run 0 run brusselator.cascade --steps 5 -q
run 0 new brusselator -o new.cascade
cmp -s new.cascade brusselator.cascade || fail "a file and standard output differ"
run 3 new brusselator -o new.cascade
run 64 new
run 64 new brusselater
says err "did you mean 'brusselator'?"
run 0 --help
run 0 --version
says out 'cascade '

# Remarks from the equations of a stage before it runs.
cat >faint.cascade <<'END'
stage one: brusselator { decay: 6; u: [feed] + random(0, 0.01); v: [decay] / [feed] + random(0, 0.01); iterations: 10 }
stage two: brusselator { u: [feed] + random(0, 0.01); v: [decay] / [feed] + random(0, 0.01); iterations: 10000 }
END
run 0 check faint.cascade
says err "stage 'one': nothing will grow: no wave grows from its flat state u = 4.5, v = 1.3333"
[ "$(grep -c 'nothing will grow' err)" = 1 ] || fail "a word too many before the run"
run 0 run faint.cascade --steps 10 -o faint.png
says err "stage 'one': nothing will grow"
says err "stage 'two': nothing will grow: it ends before anything can grow"

# Closed pipes on standard output and standard error.
"$CASCADE" systems 2>err | head -n 1 >out
[ "${PIPESTATUS[0]}" = 0 ] && [ ! -s err ] || fail "cascade systems | head"
"$CASCADE" run spots.cascade -o pipe.png 2>&1 >/dev/null | true
[ "${PIPESTATUS[0]}" = 0 ] && [ -s pipe.png ] || fail "nobody reads the progress"

# Ctrl-C: the results so far are written, and the program says so.
timeout --preserve-status -s INT 2 "$CASCADE" run long.cascade --save stopped >out 2>err
[ $? = 130 ] || fail "Ctrl-C is not 130"
says err "interrupted at stage 's', step"
[ -s long.png ] && [ -s stopped/s.b.npy ] || fail "Ctrl-C lost the picture"
timeout --preserve-status -s TERM 2 "$CASCADE" run long.cascade -q >out 2>err
[ $? = 143 ] || fail "SIGTERM is not 143"

# A terminal: a bar, colours, and neither with NO_COLOR or TERM=dumb.
in_terminal() { TERM=$1 script -qec "$2" /dev/null >out 2>err </dev/null; }
if command -v script >/dev/null; then
    in_terminal xterm "timeout --preserve-status -s INT 2 '$CASCADE' run long.cascade"
    grep -q "stage 's' ▕" out || fail "no bar in a terminal"
    in_terminal xterm "'$CASCADE' check wrong.cascade"
    grep -q $'\x1b\\[1;31m' out || fail "no colours in a terminal"
    NO_COLOR=1 in_terminal xterm "'$CASCADE' check wrong.cascade"
    grep -q $'\x1b' out && fail "colours in spite of NO_COLOR"
    in_terminal dumb "'$CASCADE' run spots.cascade -o dumb.png"
    grep -q $'\x1b' out && fail "control characters for a dumb terminal"
fi
echo "command line: right"
