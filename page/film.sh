#!/usr/bin/env bash
# page/film.sh [CASCADE [CHROMIUM]]: makes README's first picture, page/film.webp, by steering the page of
# `cascade view page/film.cascade`. Needs node, Chromium and img2webp (Debian: webp).
set -eu
page=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cascade=$(realpath "${1:-$page/../cascade}") browser=${2:-chromium-headless-shell}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
node "$page/film.mjs" "$browser" "$cascade" "$page/film.cascade"
# The last picture stays for two seconds.
pictures=(./*.png)
img2webp -loop 0 -lossy -q 45 -m 6 -d 100 "${pictures[@]:0:${#pictures[@]}-1}" -d 2000 "${pictures[-1]}" -o "$page/film.webp"
