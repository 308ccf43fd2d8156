#!/usr/bin/env bash
# page/npm/pack.sh ENGINE [FOLDER]: packs the npm package cascade-patterns with the engine ENGINE (engine.wasm of a
# build) into FOLDER (by default the current folder), and prints the name of the file. Needs npm, but no network.
set -eu
npm=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
engine=$1
into=$(cd "${2:-.}" && pwd)

package=$(mktemp -d)
trap 'rm -rf "$package"' EXIT
cp "$npm/index.d.ts" "$npm/README.md" "$npm/../../LICENSE" "$package"
cp "$npm/../built/package.js" "$package/index.js"
cp "$engine" "$package/engine.wasm"
version=$(sed -n 's/^project(cascade VERSION \([0-9.]*\).*/\1/p' "$npm/../../CMakeLists.txt")
sed "s/\"version\": \".*\"/\"version\": \"$version\"/" "$npm/package.json" >"$package/package.json"
cd "$package"
npm pack --silent --pack-destination "$into"
