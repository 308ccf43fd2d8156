#!/usr/bin/env bash
# Bad input as a user might give it: sizes, files, disks, options. Each gives the right exit status and message, and
# leaves no files. spec/messages.md tests messages about statements with errors.
set -u
rm -rf ./* .cascade-*
unset NO_COLOR

fail() {
    echo "bad input: $*"
    echo "--- out"; head -c 2000 out
    echo "--- err"; head -c 2000 err
    exit 1
}
# refused STATUS TEXT ARGUMENTS…: the command ends with this status and one error that contains TEXT, and writes
# nothing.
refused() {
    local wanted=$1 text=$2 got
    shift 2
    touch before
    timeout 300 "$CASCADE" "$@" >out 2>err </dev/null
    got=$?
    [ "$got" = "$wanted" ] || fail "cascade $* gave $got, not $wanted"
    grep -qF -- "$text" err || fail "cascade $* does not say '$text'"
    [ ! -s out ] || fail "cascade $* prints on standard output"
    [ "$(grep -c ' error: ' err)" -le 1 ] || fail "cascade $*: one fault, one message"
    [ -z "$(find . -newer before -name '*.png' -o -name '.cascade-*')" ] || fail "left behind by $*"
}
runs() {
    timeout 300 "$CASCADE" run "$@" -q >out 2>err </dev/null || fail "cascade run $* gave $?"
}
stage() { printf 'stage s: turing_spots { %s }\n' "$1" >"$2"; }
repeat() { head -c "$1" /dev/zero | tr '\0' "$2"; }

stage 'iterations: 20' good.cascade

# Files that are not scripts.
: >empty.cascade
mkdir folder.cascade
head -c 20000000 /dev/zero | tr '\0' '#' >large.cascade
printf 'stage s: turing_spots { ka: 1\0 }\n' >nul.cascade
printf 'stage s: turing_spots { ka: \xff }\n' >bytes.cascade
refused 2 'empty.cascade:1:1: error: this script is empty' run empty.cascade
refused 2 "cannot read 'folder.cascade': Is a directory" run folder.cascade
refused 2 "cannot read 'missing.cascade': No such file or directory" run missing.cascade
refused 2 'this script has 20000000 bytes, but at most' run large.cascade
refused 2 'nul.cascade:1:30: error: a NUL byte' run nul.cascade
refused 2 'bytes.cascade:1:29: error: byte 0xff is not valid UTF-8' run bytes.cascade
if [ "$(id -u)" != 0 ]; then
    cp good.cascade secret.cascade
    chmod 000 secret.cascade
    refused 2 "cannot read 'secret.cascade': Permission denied" run secret.cascade
fi

# Deep and long expressions in a value, a rate and a setting run or get a message.
{ printf 'stage s: turing_spots { iterations: 2; ka: '; repeat 100000 '('; printf 'x*0.01'; repeat 100000 ')'; echo ' }'; } >deep.cascade
{ printf "system t { u: 1; u' = lap(u) - "; repeat 100001 '-'; echo 'u }'; echo 'stage s: t { iterations: 2 }'; } >signs.cascade
{ printf "system t { u: 1; u' = lap(u) - 0.0000001*(u"; yes '+u' | head -n 1000000 | tr -d '\n'; echo ') }'; echo 'stage s: t { iterations: 2 }'; } >chain.cascade
{ printf 'stage s: turing_spots { iterations: '; repeat 100000 '('; echo ' }'; } >open.cascade
runs deep.cascade
runs signs.cascade
runs chain.cascade
refused 2 'open.cascade:1:100036: error: this' run open.cascade
rm -f ./*.png

# Numbers with which nothing can run.
for bad in '-1|at least 0' '2.5|a whole number' '1e30|at most' 'x|varies by cell'; do
    stage "iterations: ${bad%|*}" number.cascade
    refused 2 "number.cascade:1:37: error: iterations must be" run number.cascade
    grep -qF "${bad#*|}" err || fail "iterations: ${bad%|*}"
done
refused 2 '<--grid>:1:1: error: a side of the grid must be' run good.cascade --grid 0x4
refused 2 '<--grid>:1:1: error: a grid needs more than one cell' run good.cascade --grid 1x1
refused 2 '<--grid>:1:1: error: the grid is too large' run good.cascade --grid 1000000x1000000
refused 3 'needs' run good.cascade --grid 46000x46000
stage 'speed: x - 0.5' slow.cascade
refused 3 'but a time step must be above 0' run slow.cascade -q

# Options with nonsense.
refused 2 "<--set>:1:5: error: one value ends before ';'" run good.cascade --set 'ka=1;a=2'
refused 2 "<--show>:1:1: error: the expression is missing" run good.cascade --show '}'
refused 2 "<--stop-at>:1:3: error: stage 's' has only 20 steps" run good.cascade --stop-at s:21
refused 2 "<--until-stage>:1:1: error: no stage is called 't'" run good.cascade --until-stage t
for nonsense in '--range 1' '--range 1,1' '--scale 0' '--detail 0' '--detail 9' '--depth 9' '--palette nope' '--seed -1' '--size 0x9' '--size 9x' '--copies 0' '--copies 17' '--copies 2x2x2' '--quality best' '--light moon' '--fov 0' '--ground maybe' '--background white' \
    '--steps 1.5' '--threads 0' '--lanes 5' '--backend gpu' '--stop-at s' \
    '--dump nope' '-o picture.jpg' '--volume volume.txt' '--log-file numbers.csv' '--log-every 5'; do
    # shellcheck disable=SC2086
    refused 64 "'cascade run --help' shows how to use it." run good.cascade $nonsense
done
refused 64 "the number '50'" run good.cascade -o film.gif --frames 50
refused 64 'write maps/u, or maps/u.png/ for a folder' sweep good.cascade --vary seed=1,2 -o maps/u.png
refused 64 'write a, or a.glb/ for a folder' run good.cascade --save a.glb
refused 64 '--save FOLDER writes each species' run good.cascade -o numbers.npy
refused 3 'would both be written to' run good.cascade -o a.png --sheet ./a.png
refused 64 'would both be written to' compile good.cascade -o a.h
refused 64 'a script is missing' compile
refused 64 'is not an odd number' compile good.cascade --stages 4
refused 64 'euler has no stages to choose' compile good.cascade --stages 5
refused 64 'use --stages N with an odd number' compile good.cascade --set solver=rkl1
refused 64 'solver=rkl1, which keeps the speed' compile good.cascade --solver rkl1

# Outputs that cannot be written are refused before the first step.
touch file
refused 3 "there is no folder 'nowhere'" run good.cascade -o nowhere/a.png
refused 3 'the folder file cannot be made' run good.cascade --frames file
refused 3 'the folder file cannot be made' run good.cascade --save file
grep -q 'steps/s' err && fail "an output was tried after the run"
if [ -c /dev/full ]; then
    for command in systems 'check good.cascade' 'run good.cascade -q --dump ir' --help --version; do
        # shellcheck disable=SC2086
        "$CASCADE" $command >/dev/full 2>err
        [ $? = 3 ] || fail "$command on a full disk"
        grep -q 'standard output cannot be written' err || fail "$command on a full disk"
    done
fi
# A full disk: one of 48 KiB, if this user may mount one.
mkdir disk
if mount -t tmpfs -o size=48k tmpfs disk 2>/dev/null; then
    trap 'umount disk' EXIT
    for output in '--save disk/run' '--frames disk/film' '--sheet disk/sheet.png'; do
        # shellcheck disable=SC2086
        "$CASCADE" run good.cascade -q --grid 300x300 --scale 2 -o kept.png $output >out 2>err
        [ $? = 3 ] || fail "$output on a full disk"
        grep -q 'No space left on device' err || fail "$output on a full disk"
        [ -z "$(find disk -name '.cascade-*' -o -name run.json)" ] || fail "half a file of $output"
        rm -rf disk/*
    done
    umount disk
    trap - EXIT
fi

# Damaged pictures and saved runs.
runs good.cascade -o picture.png --save saved
head -c 300 picture.png >cut.png
sed 's/Cascade script/Dascade script/' picture.png >changed.png
printf '\x89PNG\r\n\x1a\n' >signature.png
refused 2 "cannot read 'cut.png'" run cut.png -o o.png
refused 2 'changed.png' run changed.png -o o.png
refused 2 "cannot read 'signature.png'" run signature.png -o o.png
refused 2 'holds no saved run' run --resume nowhere
mv saved/s.a.npy saved/s.c.npy
refused 3 'the saved run in saved is damaged' run --resume saved -q
cp file saved/s.a.npy
refused 3 's.a.npy has changed since the run was saved' run --resume saved -q
echo '{' >saved/run.json
refused 2 'this is not a manifest of a saved run' run --resume saved -q
stage 'b: field("good.cascade")' field.cascade
refused 2 "field.cascade:1:34: error: cannot read 'good.cascade': it is not a .npy file" \
    run field.cascade
mkfifo pipe.npy
stage 'b: field("pipe.npy")' pipe.cascade
refused 2 "pipe.cascade:1:34: error: 'pipe.npy' is a pipe or a device, not a file" run pipe.cascade

# Non-finite values for another reason than the length of steps.
printf "system q { u: 1; k: log(x - 1); u' = k + lap(u) }\nstage s: q { iterations: 9; speed: 0.1 }\n" >log.cascade
refused 3 'u is not finite any more at column 0, row 0, after step 1' run log.cascade -q
grep -qF 'no value was above 1 before that step: look for a division by zero' err || fail "log.cascade"
echo "bad input: right"
