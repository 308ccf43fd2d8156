#!/usr/bin/env bash
# ml-convolution does not convolve: it applies the kernel in the reverse order.
#
# Expected. The convolution of a single 1 with a kernel is the kernel, as with numpy, SciPy, Octave, or a product
# of Fourier transforms, and as the names directConvolution and fftConvolution promise.
#
# What happens. Both functions return the kernel backwards: they compute the correlation. With a Laplacian or a
# Gaussian nobody notices. But an upwind difference, an advection kernel or a kernel with a memory of the past
# changes its direction, and a pattern drifts to the wrong side.
#
# Workaround: reverse the kernel before the call.
#
# Seen with ml-convolution 2.0.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts ml-convolution@2.0.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { directConvolution, fftConvolution } from 'ml-convolution';
const impulse = [0, 0, 0, 1, 0, 0, 0];
const show = (name, v) => console.log(`${name}: ${[...v].map((x) => Math.round(1000 * x) / 1000 + 0).join(' ')}`);
show('single 1, kernel 1 10 100, direct', directConvolution(impulse, [1, 10, 100]));
show('single 1, kernel 1 10 100, by FFT', fftConvolution(impulse, [1, 10, 100]));
// f(x) - f(x-1) as a convolution has the kernel 0 1 -1 around its centre; the slope of a ramp is 1.
show('slope of a ramp, kernel 0 1 -1', directConvolution([0, 1, 2, 3, 4, 5], [0, 1, -1], 'CUT'));
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
single 1, kernel 1 10 100, direct: 0 0 100 10 1 0 0
single 1, kernel 1 10 100, by FFT: 0 0 100 10 1 0 0
slope of a ramp, kernel 0 1 -1: -1 -1 -1 -1
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
