#!/usr/bin/env bash
# What runs find out about tilings, as a user meets it: a long run tries some and the next one knows, and no state
# of the folder changes a picture or fails a run. No time is asserted.
set -u
[ "$CASCADE_JIT" = 1 ] || exit 77
rm -rf ./*

about="tilings"
source "$SOURCE/tests/support/program_runs.bash"
export CASCADE_KERNEL_CACHE=$PWD/cache

# Planes that are more than a second-level cache holds, and steps for a second or so.
printf 'domain { grid: 768, 768 }\nstage s: gray_scott { iterations: 10000 }\n' >long.cascade
printf 'domain { grid: 768, 768 }\nstage s: gray_scott { iterations: 8 }\n' >short.cascade
long_run() { run 0 run long.cascade -q --timing -o "$@"; }
has_tried() { grep -q ': the fastest of [0-9] ways' err || fail "nothing was tried"; }
tilings() { find "$1" -name '*.tiling' 2>/dev/null | wc -l; }

# A short run tries nothing and keeps nothing.
run 0 run short.cascade -q --timing -o short.png
[ "$(tilings cache)" = 0 ] || fail "a short run keeps a tiling"
grep -q 'the fastest' err && fail "a short run says what is the fastest"

# Long ones do, and a next one knows from its first step what was found twice in a row.
long_run first.png
has_tried
[ "$(tilings cache)" = 1 ] || fail "$(tilings cache) tilings are kept"
learn() {
    local times
    for times in 1 2 3 4 5 6 7 8; do
        run 0 run short.cascade -q --timing -o second.png
        cmp short.png second.png || fail "another picture of what was learnt"
        ! grep -q ': the fastest in an earlier run' err || return 0
        long_run again.png
        cmp first.png again.png || fail "another picture of a later run"
    done
    fail "what was found is not known"
}
learn
file=$(find cache -name '*.tiling')
[ "$(stat -c %a "$file")" = 600 ] || fail "the file is not the user's alone"

# Other threads and other grids are other steps.
run 0 run short.cascade -q --timing --threads 1 --grid 769x768 -o other.png
grep -q 'the fastest' err && fail "what is known of one grid is taken for another"

# Nothing is kept or known without the folder.
long_run without.png --no-kernel-cache
has_tried
cmp first.png without.png || fail "another picture without a folder"

# Damaged files, those of others, and what is no candidate.
cp "$file" kept
for damage in 'truncate -s 40' 'truncate -s 0' 'chmod 666' 'sed -i s/CascTil1/CascTil9/' 'cp long.cascade'; do
    rm -f "$file"
    cp kept "$file"
    chmod 600 "$file"
    $damage "$file"
    run 0 run short.cascade -q --timing -o damaged.png
    grep -q 'the fastest' err && fail "a file is read after '$damage'"
    cmp short.png damaged.png || fail "another picture after '$damage'"
done
learn

# A folder that cannot be one.
: >file
CASCADE_KERNEL_CACHE=$PWD/file/folder run 0 run short.cascade -q -o file.png
cmp short.png file.png || fail "another picture with a file for a folder"

# Many at once in an empty folder.
export CASCADE_KERNEL_CACHE=$PWD/shared
for n in 1 2; do "$CASCADE" run long.cascade -q -o "at_once_$n.png" & done
wait
for n in 1 2; do cmp "at_once_$n.png" first.png || fail "runs at once disturb each other"; done
[ "$(tilings shared)" = 1 ] || fail "runs at once kept $(tilings shared) tilings"
[ "$(find shared -name '*.new' | wc -l)" = 0 ] || fail "something unfinished is left"
echo "tilings: right"
