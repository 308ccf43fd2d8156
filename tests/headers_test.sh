#!/usr/bin/env bash
# The 20 headers that are included most are small, since every file that includes one compiles all of its text. The
# bound is for preprocessed lines, nearly all of which are the standard library's.
set -u
cd "${SOURCE:-$(dirname "${BASH_SOURCE[0]}")/..}" || exit 1
bound=95000  # The largest, run/simulation/simulation.h, has 89,000 with g++ 12; <vector> alone has 20,000.

# lines_of HEADER: prints the number of its preprocessed lines.
lines_of() { "${CXX:-g++}" -std=c++20 -I. -isystem /usr/include/eigen3 -E -P -x c++ "$1" 2>/dev/null | wc -l; }

folders=$(sed -nE 's/^([a-z]+)[/:].*/\1/p' cmake/rooms.txt | sort -u)
# shellcheck disable=SC2086  # One word for each folder.
mapfile -t most < <(grep -rhoE --include='*.h' --include='*.cpp' '^#include "[^"]+\.h"' $folders |
    sort | uniq -c | sort -rn | head -n 20 | cut -d'"' -f2)
sum=0
for header in "${most[@]}"; do
    lines=$(lines_of "$header")
    sum=$((sum + lines))
    [ "$lines" -le "$bound" ] || { echo "$header has $lines lines, more than $bound"; exit 1; }
done
[ "${#most[@]}" = 20 ] && [ "$sum" -gt 500000 ] || { echo "the check itself does not work ($sum lines)"; exit 1; }
[ "$sum" -le 1000000 ] || { echo "the 20 headers have $sum lines, more than 1,000,000"; exit 1; }
echo "${#most[@]} headers, $sum preprocessed lines"
