#!/usr/bin/env bash
# Kernels and steps as WGSL compute the same bits as the interpreter on WebGPU, in node, on a driver that computes on the
# processor (SwiftShader, which belongs to Chromium). Writes what could not be tried. Exit code 77 means that the test
# could not be run. WEBGPU_CASES=all tries many more.
set -u

fail() { echo "webgpu: $*"; exit 1; }
skip() {
    echo "webgpu: not tried: $*"
    exit 77
}

command -v node >/dev/null && command -v npm >/dev/null || fail "node or npm is missing; cmake/packages.txt names its package"
driver=/usr/lib/chromium
[ -e $driver/vk_swiftshader_icd.json ] || fail "SwiftShader is missing; the package chromium-headless-shell brings it"

# Installed packages are kept while the lock file is the same.
if ! cmp -s "$SOURCE/tests/webgpu/package-lock.json" node_modules/installed; then
    rm -rf node_modules
    cp "$SOURCE/tests/webgpu/package.json" "$SOURCE/tests/webgpu/package-lock.json" .
    npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1 || {
        tail -n 5 npm.log
        skip "the packages of tests/webgpu/package.json could not be installed"
    }
    cp package-lock.json node_modules/installed
fi

"$BUILD/tests/webgpu_cases" "${WEBGPU_CASES:-sample}" webgpu.cases || fail "the cases were not written"
LD_LIBRARY_PATH=$driver VK_ICD_FILENAMES=$driver/vk_swiftshader_icd.json \
    node "$SOURCE/tests/webgpu/run_cases.mjs" webgpu.cases || fail "see above"
