#!/usr/bin/env bash
# Compiled kernels on disk: where they are stored, that LLVM is not loaded if they are found, and that no state of the
# folder changes a picture or makes a run fail.
set -u
[ "$CASCADE_JIT" = 1 ] || exit 77
rm -rf ./*

about="kernel cache"
source "$SOURCE/tests/support/program_runs.bash"
unset CASCADE_KERNEL_CACHE XDG_CACHE_HOME
export HOME=$PWD/home
mkdir "$HOME"

cat >two.cascade <<'END'
stage large: turing_spots { iterations: 60 }
stage small: gray_scott { iterations: 60 }
END
cat >short.cascade <<'END'
domain { grid: 64, 64 }
stage large: turing_spots { iterations: 1 }
stage small: gray_scott { iterations: 1 }
END
cascade_run() { run 0 run two.cascade -q -o "$@"; }
kernels() { find "$1" -name '*.kernel' | wc -l; }
loads_llvm() {
    LD_DEBUG=files "$CASCADE" run two.cascade -q -o traced.png "$@" 2>trace >out ||
        fail "a traced run failed"
    grep -q 'libLLVM' trace
}

# Nothing is stored with --no-kernel-cache.
cascade_run first.png --no-kernel-cache
[ ! -e "$HOME/.cache" ] || fail "--no-kernel-cache keeps kernels"
CASCADE_KERNEL_CACHE='' cascade_run none.png
[ ! -e "$HOME/.cache" ] || fail "an empty CASCADE_KERNEL_CACHE keeps kernels"
XDG_CACHE_HOME=relative cascade_run relative.png
[ ! -e relative ] && [ ! -e "$HOME/.cache" ] || fail "a relative XDG_CACHE_HOME is used"

# Nothing is stored in another user's home, as with sudo.
if [ "$(id -u)" = 0 ]; then
    mkdir guest && chown 1 guest
    HOME=$PWD/guest cascade_run guest.png
    [ ! -e guest/.cache ] || fail "root leaves a folder in another user's home"
fi

# Where they are.
loads_llvm || fail "a first run makes code without LLVM"
folder=$HOME/.cache/cascade/kernels
[ "$(stat -c %a "$folder")" = 700 ] || fail "the folder is not the user's alone"
count=$(kernels "$folder")
[ "$count" -ge 2 ] || fail "$count kernels of two systems are kept"
XDG_CACHE_HOME=$PWD/xdg cascade_run xdg.png
[ "$(kernels xdg/cascade/kernels)" = "$count" ] || fail "XDG_CACHE_HOME is not used"
CASCADE_KERNEL_CACHE=$PWD/named cascade_run named.png
[ "$(kernels named)" = "$count" ] || fail "CASCADE_KERNEL_CACHE is not used"

# A run that finds its kernels needs no LLVM.
loads_llvm && fail "LLVM is loaded though all kernels are there"
loads_llvm --no-kernel-cache || fail "--no-kernel-cache finds kernels"
[ "$(kernels "$folder")" = "$count" ] || fail "kernels were made again"
cmp traced.png first.png || fail "another picture with kept kernels"

# A run that ends before its code could be compiled does not load LLVM either, and stores nothing.
LD_DEBUG=files CASCADE_KERNEL_CACHE=$PWD/short "$CASCADE" run short.cascade -q -o short.png 2>trace >out ||
    fail "a short run failed"
grep -q 'libLLVM' trace && fail "LLVM is loaded for two steps"
[ ! -e short ] || fail "a run that compiles nothing keeps kernels"
run 0 run short.cascade -q -o interpreted_short.png --backend interp
cmp short.png interpreted_short.png || fail "another picture of two steps"

# Damaged files and unusable folders.
for file in "$folder"/*.kernel; do truncate -s 1000 "$file"; done
cascade_run damaged.png
cmp damaged.png first.png || fail "another picture with damaged kernels"
loads_llvm && fail "damaged kernels were not written again"
chmod 777 "$folder"
loads_llvm || fail "kernels are taken from a folder that others may write to"
chmod 700 "$folder"
: >file
CASCADE_KERNEL_CACHE=$PWD/file/folder cascade_run file.png
if [ -w /dev/full ]; then
    CASCADE_KERNEL_CACHE=/dev/full cascade_run full.png
    cmp full.png first.png || fail "another picture with a device for a folder"
fi

# Many runs at once with an empty folder.
export CASCADE_KERNEL_CACHE=$PWD/shared
for n in 1 2 3 4; do "$CASCADE" run two.cascade -q -o "at_once_$n.png" & done
wait
for n in 1 2 3 4; do cmp "at_once_$n.png" first.png || fail "runs at once disturb each other"; done
[ "$(kernels shared)" = "$count" ] || fail "runs at once kept $(kernels shared) of $count kernels"
[ "$(find shared -type f | wc -l)" = "$count" ] || fail "something unfinished is left"

# Large grids have their starting values and pictures computed by native code, too.
cat >large.cascade <<'END'
system s {
  u: 0.5 + 0.3 * random(0.5, 0.5) * noise(0.1) + sin(12*x) * cos(9*y) - tanh(x*y) + exp(-x*x)
  u' = 0.1 * lap(u)
}
domain { grid: 512, 513 }
stage s: s { iterations: 1 }
END
run 0 run large.cascade -q -o large.png
[ "$(kernels shared)" -ge $((count + 2)) ] || fail "the start of a large grid is interpreted"
run 0 run large.cascade -q -o again.png
run 0 run large.cascade -q -o interpreted.png --backend interp
cmp large.png interpreted.png || fail "another picture by the interpreter"
cmp large.png again.png || fail "another picture from kept kernels"
echo "kernel cache: right"
