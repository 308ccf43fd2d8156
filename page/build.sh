#!/usr/bin/env bash
# page/build.sh [FOLDER]: bundles page/src into FOLDER (by default page/built). Needs node. Uses node_modules of the
# current folder, and installs the packages of page/package-lock.json there if they are missing.
set -eu
page=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
into=${1:-$page/built}

# Packages that are installed are used again as long as the lock file is the same.
if ! cmp -s "$page/package-lock.json" node_modules/installed; then
    rm -rf node_modules
    cp "$page/package.json" "$page/package-lock.json" .
    npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1 || { tail -n 5 npm.log; exit 77; }
    cp package-lock.json node_modules/installed
fi

mkdir -p "$into"
NODE_PATH=$PWD/node_modules node_modules/.bin/esbuild "$page/src/page.ts" "$page/src/worker.ts" "$page/src/page.css" \
    --bundle --minify --legal-comments=none --format=esm --target=es2022 --log-level=warning \
    --banner:js="$(cat "$page/src/license.js")" --outdir="$into"
# The npm package is not minified, because those who use it read it and bundle it again. Its comments name files
# relative to the current folder.
modules=$PWD/node_modules
(cd "$page" && "$modules/.bin/esbuild" src/package.ts --bundle --format=esm --target=es2022 --platform=neutral \
    --external:node:fs/promises --log-level=warning) >"$into/package.js"
cp "$page/src/index.html" "$into/index.html"
