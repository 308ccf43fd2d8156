#!/usr/bin/env bash
# page/tutorial_pictures.sh [CASCADE [CHROMIUM]]: makes the pictures of docs/tutorial.md, by following it on the page.
set -eu
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cascade=$(realpath "${1:-$root/cascade}") browser=${2:-chromium-headless-shell}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
node "$root/tests/page/tutorial.mjs" "$browser" "$cascade" "$root/docs/tutorial.md"
mkdir -p "$root/docs/tutorial"
cp ./*.webp "$root/docs/tutorial"
