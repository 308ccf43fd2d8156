#!/usr/bin/env bash
# CMakeLists.txt contains the version. The program, the module of Python, CITATION.cff, the newest entry of CHANGELOG.md
# and exported pages have the same.
set -u
version=$(sed -nE 's/^project\(cascade VERSION ([0-9.]+) .*/\1/p' "$SOURCE/CMakeLists.txt")
[ -n "$version" ] || { echo "CMakeLists.txt has no version"; exit 1; }

expect() {
    [ "$2" = "$version" ] || { echo "version: $1 has '$2', not $version"; exit 1; }
}
expect "the program" "$("$CASCADE" --version | sed -n '1s/^cascade //p')"
expect CITATION.cff "$(sed -n 's/^version: //p' "$SOURCE/CITATION.cff")"
expect CHANGELOG.md "$(sed -nE '/^## /{s/^## ([0-9.]+).*/\1/p;q}' "$SOURCE/CHANGELOG.md")"
python=$(sed -n 's/^Python3_EXECUTABLE:.*=//p' "$BUILD/CMakeCache.txt")
if [ -z "$SANITIZE" ] && compgen -G "$BUILD/python/cascade/_core*.so" >/dev/null && "$python" -c 'import numpy' 2>/dev/null; then
    expect "the module of Python" "$(PYTHONPATH=$BUILD/python PYTHONDONTWRITEBYTECODE=1 "$python" -c 'import cascade; print(cascade.__version__)')"
fi
if [ -f "$BUILD/engine.wasm" ]; then
    printf 'stage s: turing_spots { iterations: 1 }\n' >one.cascade
    "$CASCADE" export one.cascade >/dev/null || exit 1
    expect "an exported page" "$(sed -nE 's/^<meta name="generator" content="Cascade (.*)">$/\1/p' one.html)"
fi
