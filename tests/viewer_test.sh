#!/usr/bin/env bash
# GLB files in a browser: the validator of the format finds no fault, and three.js draws the expected pictures. Exit
# code 77 means that the test could not be run.
set -u

fail() { echo "viewer: $*"; exit 1; }
skip() {
    echo "viewer: not tried: $*"
    exit 77
}

command -v node >/dev/null && command -v npm >/dev/null || skip "node or npm is missing"
browser=''
for name in chromium-headless-shell chromium chromium-browser google-chrome; do
    browser=$(command -v $name) && break
done
[ -n "$browser" ] || skip "there is no Chromium"

# Installed packages are kept while the lock file is the same.
if ! cmp -s "$SOURCE/tests/viewer/package-lock.json" node_modules/installed; then
    rm -rf node_modules
    cp "$SOURCE/tests/viewer/package.json" "$SOURCE/tests/viewer/package-lock.json" .
    npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1 || {
        tail -n 5 npm.log
        skip "the packages of tests/viewer/package.json could not be installed"
    }
    cp package-lock.json node_modules/installed
fi

rm -rf models profile ./*.png
mkdir models
(cd models && "$BUILD/tests/viewer_models") || fail "the models were not written"
node "$SOURCE/tests/viewer/view.mjs" "$browser" "$PWD/models" || fail "see above"
