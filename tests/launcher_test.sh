#!/usr/bin/env bash
# The launcher `cascade` builds if and only if it must. Small scripts that record their calls replace CMake and the
# package tools, so that no real build is needed.
set -u

fail() {
    echo "launcher: $*"
    [ -e calls ] && sed 's/^/  call: /' calls
    exit 1
}
count() { grep -c "$1" calls || true; }

rm -rf ./* && mkdir -p bin elsewhere
rooms=$(sed -nE 's#^([a-z/]+):.*#\1#p' "$SOURCE/cmake/rooms.txt")
mkdir -p tree/{app,include,page,cmake}
for room in $rooms; do mkdir -p "tree/$room" && touch "tree/$room/source.cpp"; done
cp "$SOURCE/cascade" tree/ && cp "$SOURCE"/cmake/{fresh.sh,bring_up_to_date.sh,setup.sh,packages.txt,rooms.txt} tree/cmake/
touch tree/CMakeLists.txt tree/core/a.cpp

calls=$PWD/calls
cat >bin/cmake <<END
#!/bin/bash
echo "cmake \$*" >>"$calls"
[ -e "$PWD/break_build" ] && { echo "a.cpp:1: some error"; exit 1; }
if [ "\$1" = --build ]; then
    sleep 0.3
    case "\$4" in cascade_first) made=\$2/cascade-first ;; *) made=\$2/cascade ;; esac
    printf '#!/bin/bash\necho "ran in \$PWD: \$*"\nexit 7\n' >"\$made" && chmod +x "\$made"
fi
END
cat >bin/dpkg-query <<END
#!/bin/bash
for name; do case \$name in -*) ;; libfmt-dev) [ -e "$PWD/installed" ] && echo "installed \$name:amd64" ;;
    *) echo "installed \$name" ;; esac; done
END
cat >bin/apt-get <<END
#!/bin/bash
echo "apt-get \$*" >>"$calls"
[ -e "$PWD/break_apt" ] && { echo "E: no network"; exit 100; }
[[ "\$*" == *install* ]] && touch "$PWD/installed"
exit 0
END
printf '#!/bin/bash\nexec "$@"\n' >bin/sudo
chmod +x bin/*
export PATH=$PWD/bin:$PATH
launch() { : >calls; (cd elsewhere && ../tree/cascade "$@" >../out 2>../err); }

touch break_apt
launch && fail "packages that cannot be installed are no success"
grep -q 'no network' err || fail "why apt-get failed is not shown: $(cat err)"
[ "$(count '^cmake')" = 0 ] || fail "built without its packages"
rm break_apt

launch run 'a b.cascade'
[ $? = 7 ] || fail "the program's exit status is lost"
[ "$(cat out)" = "ran in $PWD/elsewhere: run a b.cascade" ] || fail "arguments or folder: $(cat out)"
[ "$(count 'apt-get.*install.* libfmt-dev$')" = 1 ] || fail "libfmt-dev alone is missing"
[ "$(count 'cmake --build')" = 1 ] || fail "the first call builds"
[ "$(wc -l <err)" -le 4 ] || fail "too many words: $(cat err)"
grep -q 'minutes of processor time' err || fail "how long the first build takes is not said: $(cat err)"
! grep -q $'\r' err || fail "progress is drawn where nobody watches"

[ "$(count 'cmake --build.*--target cascade_first ')" = 1 ] || fail "the first call builds the first program"

launch
[ ! -s calls ] && [ ! -s err ] || fail "nothing has changed: $(cat err)"
ln -sf tree/cascade by_link
: >calls
./by_link >out 2>err
[ ! -s calls ] && [ "$(cat out)" = "ran in $PWD: " ] || fail "through a link: $(cat out err)"

# In a terminal the progress is shown.
if command -v script >/dev/null; then
    touch tree/core/a.cpp
    sed -i 's|^    sleep 0.3|    echo "[1/20] one"; sleep 0.7; echo "[17/20] two"; sleep 2|' bin/cmake
    script -qec "tree/cascade" /dev/null >out </dev/null
    grep -q '17 of 20 steps, about a minute left' out || fail "no progress in a terminal: $(cat out)"
    sed -i 's|^    echo "\[1/20.*|    sleep 0.3|' bin/cmake
fi

# In a pipe the progress is shown from time to time, and no process keeps the pipe open afterwards.
touch tree/core/a.cpp
sed -i 's|^    sleep 0.3|    echo "[5/20] one"; sleep 2.3|' bin/cmake
begin=$SECONDS
CASCADE_PROGRESS_SECONDS=1 launch
grep -q '^cascade: 5 of 20 steps, about a minute left$' err || fail "no progress in a pipe: $(cat err)"
[ $((SECONDS - begin)) -lt 20 ] || fail "the launcher waited for the end of what shows the progress"
sed -i 's|^    echo "\[5/20.*|    sleep 0.3|' bin/cmake

# The number of jobs depends on memory: a compiler takes up to 1 GiB.
root=$PWD/tree
compilers_with() { (. tree/cmake/setup.sh; awk() { echo "$memory"; }; nproc() { echo 8; }; memory=$1; compilers); }
[ "$(compilers_with 0) $(compilers_with 3) $(compilers_with 20)" = '1 3 8' ] || fail "compilers do not fit into memory"

# Known causes of a failed build are reported.
touch break_build tree/core/a.cpp
sed -i 's|some error|fatal error: No space left on device|' bin/cmake
launch && fail "a failed build is no success"
grep -q 'the disk is full' err || fail "a full disk is not named: $(cat err)"
sed -i 's|fatal error: No space left on device|some error|' bin/cmake
rm break_build

touch tree/core/a.cpp
launch
[ "$(count 'cmake --build')" = 1 ] || fail "a changed file is built"
[ "$(count apt-get)" = 0 ] || fail "packages are there"
for room in $rooms; do  # An edit in place, by an editor that keeps the time of modification.
    echo "// $room" >>"tree/$room/source.cpp" && touch -d 2001-01-01 "tree/$room/source.cpp" && launch
    [ "$(count 'cmake --build')" = 1 ] || fail "what has changed in $room is built"
done
touch tree/core/b.cpp && launch
[ "$(count 'cmake --build')" = 1 ] || fail "a new file is built"
rm tree/core/b.cpp && launch
[ "$(count 'cmake --build')" = 1 ] || fail "a file's removal is built"
touch -d '2001-01-01' tree/core/a.cpp && launch
[ "$(count 'cmake --build')" = 1 ] || fail "a copy with an old time is built"

touch break_build tree/core/a.cpp
launch && fail "a failed build is no success"
grep -q 'some error' err || fail "the log of a failed build is not shown"
rm break_build
launch
[ "$(count 'cmake --build')" = 1 ] || fail "after a failed build it is tried again"

touch tree/core/a.cpp
: >calls
for _ in 1 2 3; do tree/cascade >/dev/null 2>&1 & done
wait
[ "$(count 'cmake --build')" = 1 ] || fail "calls at the same time build once"

# The first program calls the launcher with CASCADE_WHOLE, and from then on the whole program is built and run.
CASCADE_WHOLE=1 launch run zebra.cascade
[ $? = 7 ] && [ "$(cat out)" = "ran in $PWD/elsewhere: run zebra.cascade" ] || fail "the whole program: $(cat out err)"
[ "$(count 'cmake --build.*--target cascade_program ')" = 1 ] || fail "the whole program is built"
grep -q 'the rest of Cascade, which this command needs' err || fail "the second build is not explained: $(cat err)"
rm tree/build/release/cascade-first
launch
[ ! -s calls ] && [ ! -s err ] || fail "the whole program is ready: $(cat err)"
touch tree/core/a.cpp
launch
[ "$(count 'cmake --build.*--target cascade_program ')" = 1 ] || fail "changes are built into the whole program"
