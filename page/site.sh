#!/usr/bin/env bash
# page/site.sh FOLDER [CASCADE]: writes a static site: tutorials, help, gallery, library and specification, in which
# every script can be run. It needs no server; docs/site.md describes it. Needs node and cmark-gfm.
set -eu
[ $# -ge 1 ] || { echo "usage: page/site.sh FOLDER [CASCADE]" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cascade=$(realpath "${2:-$root/cascade}")
for needed in node cmark-gfm; do
    command -v $needed >/dev/null || { echo "page/site.sh: $needed is missing; cmake/packages.txt names its package" >&2; exit 1; }
done
mkdir -p "$1"
folder=$(cd "$1" && pwd)
"$cascade" export "$root/page/film.cascade" --html "$folder/live.html"
# With fewer cells than in the picture, for the size of the file.
"$cascade" export "$root/examples/on_models/leopard.cascade" --cells 24000 --html "$folder/animal.html"
node "$root/page/site/make.mjs" "$root" "$folder" "$cascade"
