#!/usr/bin/env bash
# If the system refuses threads (as with a limit of processes in containers), everything is computed on the main thread,
# with the same bytes.
set -u
rm -rf ./*

about="denied threads"
source "$SOURCE/tests/support/program_runs.bash"
[ -z "$SANITIZE" ] || { echo "denied threads: sanitizers begin threads of their own"; exit 77; }

# A filter of system calls that answers clone and clone3 as if the table of processes were full.
cat >deny.py <<'END_OF_PYTHON'
import ctypes, os, platform, struct, sys

clone = {"x86_64": 56, "aarch64": 220}.get(platform.machine())
if clone is None:
    sys.exit(77)
clone3, again = 435, 11
load, equal, answer = 0x20, 0x15, 0x06
program = b"".join(struct.pack("HBBI", *line) for line in [
    (load, 0, 0, 0), (equal, 2, 0, clone), (equal, 1, 0, clone3),
    (answer, 0, 0, 0x7fff0000), (answer, 0, 0, 0x00050000 | again)])
buffer = ctypes.create_string_buffer(program, len(program))
filter_ = struct.pack("HxxxxxxP", len(program) // 8, ctypes.addressof(buffer))
libc = ctypes.CDLL(None, use_errno=True)
if libc.prctl(38, 1, 0, 0, 0) or libc.prctl(22, 2, filter_, 0, 0):
    sys.exit(77)
os.execv(sys.argv[1], sys.argv[1:])
END_OF_PYTHON
python3 deny.py /bin/true
case $? in 0) ;; *) echo "denied threads: this system filters no system calls"; exit 77 ;; esac
denied() {
    python3 deny.py "$CASCADE" "$@" >out 2>err || fail "cascade $*: exit status $?"
}

cat >two.cascade <<'END_OF_SCRIPT'
domain { grid: 400, 300 }
stage large: turing_spots { iterations: 60 }
stage small: gray_scott { iterations: 60 }
END_OF_SCRIPT
export CASCADE_KERNEL_CACHE=
frames=(--set large.interval=20 --set small.interval=20 --frames)
run 0 run two.cascade -q -o free.png "${frames[@]}" free_film
denied run two.cascade -q -o denied.png "${frames[@]}" denied_film
denied run two.cascade -q -o denied8.png --threads 8 "${frames[@]}" denied_film --limit-time 1h
cmp free.png denied.png && cmp free.png denied8.png || fail "another picture"
diff -r free_film denied_film || fail "other frames"

# The surface of a model, its picture, its baked maps.
cat >model.cascade <<'END_OF_SCRIPT'
domain { surface: torus(1, 0.42); cells: 500 }
stage s: turing_spots { iterations: 30 }
END_OF_SCRIPT
run 0 run model.cascade -q -o free.png -o free.ply
denied run model.cascade -q -o denied.png -o denied.ply
cmp free.png denied.png && cmp free.ply denied.ply || fail "another picture of a model"

# Sweeps and their progress.
printf 'domain { grid: 32, 32 }\nstage s: turing_spots { iterations: 50 }\n' >small.cascade
run 0 sweep small.cascade --vary seed=1,2,3 -o free -q
denied sweep small.cascade --vary seed=1,2,3 -o denied
cmp free/sheet.png denied/sheet.png || fail "another sheet"
printf 'stage s: turing_spots { iterations: 20 }\n:run\n:quit\n' | python3 deny.py "$CASCADE" repl >out 2>err ||
    fail "no prompt"
says out "step 20 of 20"

# A time limit needs no thread either.
printf 'stage s: turing_spots { iterations: 100000000 }\n' >long.cascade
python3 deny.py "$CASCADE" run long.cascade -q --limit-time 0.3s >out 2>err
[ $? = 124 ] || fail "no limit of time"
echo "denied threads: right"
