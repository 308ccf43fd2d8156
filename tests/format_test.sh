#!/usr/bin/env bash
# Every .cpp and .h has the layout of .clang-format. Needs no build: reads $SOURCE. Releases of clang-format differ in
# details, so the test uses that of Debian 12.
set -u
cd "${SOURCE:-$(dirname "${BASH_SOURCE[0]}")/..}" || exit 1

folders=$(sed -nE 's/^([a-z]+)[/:].*/\1/p' cmake/rooms.txt | sort -u)
# shellcheck disable=SC2086  # One word for each folder.
mapfile -t sources < <(find $folders include examples bench tests -name node_modules -prune -o \
    \( -name '*.cpp' -o -name '*.h' \) -print)
((${#sources[@]} > 100)) || { echo "found only ${#sources[@]} sources"; exit 1; }

wrong=$(printf '%s\0' "${sources[@]}" |
    xargs -0 clang-format-14 --dry-run 2>&1 | sed -nE 's/^([^:]+):.*clang-format-violations.*/\1/p' | sort -u)
[[ -z $wrong ]] && exit 0
echo "$wrong"
echo "these are laid out otherwise than .clang-format says: run clang-format-14 -i on them"
exit 1
