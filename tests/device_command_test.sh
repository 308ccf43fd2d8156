#!/usr/bin/env bash
# `cascade run --device`: the same bits as without it, notes on stages that run on threads, and messages for everything
# that can be missing. Runs on a driver that computes on the processor (PoCL).
set -u

fail() { echo "device command: $*"; cat err; exit 1; }
says() { grep -qF -- "$1" err || fail "no message '$1'"; }
refuses() {  # STATUS WORDS COMMAND…
    local status=$1 words=$2
    shift 2
    "$@" >out 2>err
    [ $? = "$status" ] || fail "$*: another status than $status"
    says "$words"
    [ ! -e never.png ] || fail "$*: a picture was written"
}
export POCL_CACHE_DIR=$BUILD/tests/pocl_cache
"$CASCADE" run --device list >list 2>err || { cat err; exit 77; }
grep -q '^0  cpu  ' list || fail "no device is listed"
grep -q '^   the same bits$' list || fail "the device is not bit-exact"

cat >two.cascade <<'SCRIPT'
domain { grid: 48, 32 }
stage first: gray_scott { iterations: 40 }
stage second: gray_scott { u: u; v: v; iterations: 30; solver: imex }
SCRIPT
"$CASCADE" run two.cascade -o here.png --save here -q 2>err || fail "the run on threads fails"
"$CASCADE" run two.cascade -o there.png --save there --device 0 --timing 2>err || fail "the run on a device fails"
says 'a stage runs on threads instead of'
says 'because its solver filters waves'
says 'one step a launch on'
cmp here.png there.png && diff -r here there || fail "the device has other bits"
cat >crawling.cascade <<'SCRIPT'
domain { surface: sphere }
stage grow: scales { founders: 10; r: 0.1; duration: 0.2 }
SCRIPT
"$CASCADE" run crawling.cascade --device 0 >out 2>err || fail "cells that crawl do not run"
says 'a stage of cells that crawl runs on threads, not on the device'

# A limit ends the run, and what was computed is saved.
"$CASCADE" run two.cascade --set first.iterations=2000000 --device 0 --limit-time 1s --save cut >out 2>err
[ $? = 124 ] && [ -s cut/first.u.npy ] || fail "a limit does not end the run"

refuses 3 'there is no device 7' "$CASCADE" run two.cascade --device 7 -o never.png
refuses 3 'no device is a graphics processor' "$CASCADE" run two.cascade --device gpu -o never.png
refuses 64 "'fast' is not a device" "$CASCADE" run two.cascade --device fast -o never.png
refuses 64 '--ranks excludes --device' "$CASCADE" run two.cascade --device 0 --ranks 2 -o never.png
refuses 3 'OpenCL finds no device' env OCL_ICD_VENDORS=/nowhere "$CASCADE" run two.cascade --device 0 -o never.png
mkdir -p empty && : >empty/libOpenCL.so.1
refuses 3 'but its loader libOpenCL.so.1 is missing' env LD_LIBRARY_PATH="$PWD/empty" "$CASCADE" run two.cascade --device 0 -o never.png
