#!/usr/bin/env bash
# Stored tilings on the command line: a long run tries some tilings, the next run begins with the fastest, and no state
# of the folder changes a picture or makes a run fail. No time is asserted.
set -u
[ "$CASCADE_JIT" = 1 ] || exit 77
rm -rf ./*

about="tilings"
source "$SOURCE/tests/support/program_runs.bash"
export CASCADE_KERNEL_CACHE=$PWD/cache

# Planes larger than a second-level cache. The number of threads is given, because it is also tuned, and results are
# stored for each number.
write_long() { printf 'domain { grid: 768, 768 }\nstage s: gray_scott { iterations: %d }\n' "$1" >long.cascade; }
printf 'domain { grid: 768, 768 }\nstage s: gray_scott { iterations: 8 }\n' >short.cascade
long_run() { run 0 run long.cascade -q --timing --threads 1 -o "$@"; }
short_run() { run 0 run short.cascade -q --timing --threads 1 -o "$@"; }
has_tried() { grep -q ': the fastest of [0-9] ways' err; }
# Later runs use a result if it was found twice in a row, which depends on the clock. This marks a stored result as
# found twice (in the last digit of the file; bytes 8 to 15 are FNV-1a of the bytes after them).
make_sure() {
    local byte hash=$((0xcbf29ce484222325)) shift
    truncate -s -1 "$1"
    printf 1 >>"$1"
    for byte in $(tail -c +17 "$1" | od -An -v -tu1); do hash=$(((hash ^ byte) * 0x100000001b3)); done
    for shift in 0 8 16 24 32 40 48 56; do printf "\\x$(printf %02x $((hash >> shift & 255)))"; done |
        dd of="$1" bs=1 seek=8 conv=notrunc status=none
}
tilings() { find "$1" -name '*.tiling' 2>/dev/null | wc -l; }

# A short run tries nothing and stores nothing.
short_run short.png
[ "$(tilings cache)" = 0 ] || fail "a short run keeps a tiling"
grep -q 'the fastest' err && fail "a short run says what is the fastest"

# Long runs do. How long they must be depends on the machine.
for steps in 10000 40000 160000; do
    write_long $steps
    rm -rf cache
    long_run first.png
    ! has_tried || break
done
has_tried || fail "nothing was tried"
[ "$(tilings cache)" = 1 ] || fail "$(tilings cache) tilings are kept"
long_run again.png
cmp first.png again.png || fail "another picture of a later run"
file=$(find cache -name '*.tiling')
[ "$(stat -c %a "$file")" = 600 ] || fail "the file is not the user's alone"

# The next run uses the stored result from its first step on.
knows() {
    short_run second.png
    cmp short.png second.png || fail "another picture of what was learnt"
    grep -q ': the fastest in an earlier run' err || fail "what was found is not known"
}
make_sure "$file"
knows

# With other numbers of threads or other grids, the result is not used.
run 0 run short.cascade -q --timing --threads 2 --grid 769x768 -o other.png
grep -q 'the fastest' err && fail "what is known of one grid is taken for another"

# Without the folder nothing is stored or used.
long_run without.png --no-kernel-cache
cmp first.png without.png || fail "another picture without a folder"

# Damaged files, files of other users, and tilings that are no candidates.
cp "$file" kept
for damage in 'truncate -s 40' 'truncate -s 0' 'chmod 666' 'sed -i s/CascTil1/CascTil9/' 'cp long.cascade'; do
    rm -f "$file"
    cp kept "$file"
    chmod 600 "$file"
    $damage "$file"
    short_run damaged.png
    grep -q 'the fastest' err && fail "a file is read after '$damage'"
    cmp short.png damaged.png || fail "another picture after '$damage'"
done
cp kept "$file"
chmod 600 "$file"
knows

# A folder that cannot be created.
: >file
CASCADE_KERNEL_CACHE=$PWD/file/folder short_run file.png
cmp short.png file.png || fail "another picture with a file for a folder"

# Many runs at once with an empty folder.
export CASCADE_KERNEL_CACHE=$PWD/shared
for n in 1 2; do "$CASCADE" run long.cascade -q --threads 1 -o "at_once_$n.png" & done
wait
for n in 1 2; do cmp "at_once_$n.png" first.png || fail "runs at once disturb each other"; done
[ "$(tilings shared)" = 1 ] || fail "runs at once kept $(tilings shared) tilings"
[ "$(find shared -name '*.new' | wc -l)" = 0 ] || fail "something unfinished is left"
echo "tilings: right"
