#!/usr/bin/env bash
# Thousands of random kernels, all systems of the library and random scripts have the same bits on a device as in the
# interpreter.
set -eu
[ -x "$BUILD/tests/device_tests" ] || { echo "built without OpenCL"; exit 77; }
POCL_CACHE_DIR=$PWD CASCADE_DEVICE_KERNELS=200 exec "$BUILD/tests/device_tests" --gtest_brief=1 --gtest_filter='*.FromNewSeeds:ScriptsOnADevice.*'
