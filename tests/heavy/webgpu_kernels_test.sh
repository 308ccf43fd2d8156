#!/usr/bin/env bash
# Hundreds of random kernels, all systems of the library and random scripts have the same bits on WebGPU as in the
# interpreter.
WEBGPU_CASES=all exec bash "$SOURCE/tests/webgpu_test.sh"
