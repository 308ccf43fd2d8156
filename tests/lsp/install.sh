#!/usr/bin/env bash
# Installs the packages of tests/lsp/package.json into node_modules of the current folder. Installed packages
# are used again. Exit code 77 means that they cannot be installed.
set -eu
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cmp -s "$tests/package-lock.json" node_modules/installed && exit 0
rm -rf node_modules
cp "$tests/package.json" "$tests/package-lock.json" .
npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1 || { tail -n 5 npm.log; exit 77; }
cp package-lock.json node_modules/installed
