#!/bin/sh
# Writes a C++ file with the functions of Cascade that object files call but do not contain. Each calls
# cascade_left_out() (app/left_out.cpp).
#
#   left_out.sh OUTPUT NM OBJECT…
set -eu
output=$1 nm=$2
shift 2
"$nm" -P "$@" 2>/dev/null | awk '
    $1 !~ /7cascade/ || $2 == "" { next }
    $2 == "U" || $2 == "w" { called[$1] = 1; next }
    { here[$1] = 1 }
    END { for (name in called) if (!(name in here)) print name }' | LC_ALL=C sort >"$output.names"
if c++filt <"$output.names" | grep -v '('; then
    echo "cmake/later.txt leaves out these data, but the first program can replace only functions" >&2
    exit 1
fi
{
    echo '// Made by cmake/left_out.sh.'
    echo 'extern "C" {'
    echo '[[noreturn]] void cascade_left_out();'
    sed 's/.*/void &() { cascade_left_out(); }/' "$output.names"
    echo '}'
} >"$output"
