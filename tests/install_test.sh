#!/usr/bin/env bash
# `cmake --install` into an empty prefix gives a program that runs from there, also when the prefix
# has moved, and a library that find_package(Cascade) finds: examples/embed is built on it and run.
set -eu
rm -rf prefix moved embed
cmake --install "$BUILD" --prefix "$PWD/prefix" >install.log
mv prefix moved
prefix=$PWD/moved

"$prefix/bin/cascade" --version | grep -q '^cascade [0-9]*\.[0-9]*\.[0-9]*' ||
    { echo "the installed program does not tell its version"; exit 1; }
printf 'stage s: turing_spots { iterations: 20 }\n' >dots.cascade
"$prefix/bin/cascade" run dots.cascade --no-kernel-cache -o dots.png 2>dots.err
[ -s dots.png ] || { echo "the installed program drew nothing"; exit 1; }
if [ "$CASCADE_JIT" = 1 ] && grep 'could not be loaded' dots.err; then
    echo "the installed program does not find its code generator"
    exit 1
fi

# Only the public headers are installed, and the library exports only what they declare.
headers=$(cd "$prefix/include" && find . -type f | sort | xargs)
[ "$headers" = './cascade/cascade.h ./cascade/cascade_c.h' ] || { echo "unexpected headers: $headers"; exit 1; }
library=$(echo "$prefix"/lib*/libcascade.so)
exported=$(nm -DC --defined-only "$library" | awk '$2 ~ /[TDBR]/' | cut -d' ' -f3-)
extra=$(grep -vE '^(cascade::(Pattern::|library_version)|cascade_[a-z_]+$|_init$|_fini$|__bss_start$|_edata$|_end$)' \
    <<<"$exported" || true)
if [ -z "$SANITIZE" ] && [ -n "$extra" ]; then
    echo "the library exports more than its headers declare:"
    echo "$extra"
    exit 1
fi
grep -q 'cascade::Pattern::step' <<<"$exported" || { echo "Pattern::step is not exported"; exit 1; }

# The Python module also runs from there, if it is built.
python=$(sed -n 's/^Python3_EXECUTABLE:.*=//p' "$BUILD/CMakeCache.txt")
if [ -z "$SANITIZE" ] && [ -d "$prefix/lib/python3" ] && "$python" -c 'import numpy' 2>/dev/null; then
    PYTHONPATH=$prefix/lib/python3/dist-packages "$python" -c '
import cascade
assert cascade.Pattern("stage one: turing_spots { iterations: 3 }").run()["b"].mean() > 0' ||
        { echo "the installed module of Python does not work"; exit 1; }
fi

flags=${SANITIZE:+-fsanitize=$SANITIZE}
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$BUILD/CMakeCache.txt")
cmake -G "$generator" -S "$SOURCE/examples/embed" -B embed -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_FLAGS="$flags" >embed.log
cmake --build embed >>embed.log
embed/embed >embed.out
cat embed.out
grep -q "did you mean 'beta'" embed.out || { echo "no hint about 'betta'"; exit 1; }
grep -q '^spots: 6000 steps$' embed.out || { echo "the example did not run to its end"; exit 1; }
[ "$(tail -n 16 embed.out | grep -c '^[@#*+. -]\{64\}$')" = 16 ] || { echo "no picture"; exit 1; }
tail -n 16 embed.out | grep -q '@@' || { echo "no spots in the picture"; exit 1; }
