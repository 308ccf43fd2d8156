#!/usr/bin/env bash
# ssim.js calls a fine pattern identical to plain grey if the picture is large enough.
#
# Expected. SSIM compares the structure of two pictures within small windows: 1 means identical, and black and white
# checks compared with plain grey are close to 0. The size of the pictures should not matter if both consist of the
# same small tile.
#
# What happens. By default, ssim.js first averages and thins out pictures until the smaller side has about 256 pixels.
# Up to 383 pixels nothing happens. From 384 on, each pixel is the mean of 2 x 2 pixels and every second one is left
# out: checks of one pixel and stripes of two become grey, and the SSIM jumps from .004 to 1. The inventors of SSIM do
# so as well in the later version of their program, for pictures that are seen from a distance. So a test that
# compares rendered patterns passes on large pictures although the pattern is missing. Nothing warns.
#
# Workaround: the option downsample: false.
#
# Seen with ssim.js 3.5.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts ssim.js@3.5.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import module from 'ssim.js';
const ssim = module.ssim ?? module.default ?? module;
const picture = (n, f) => {
  const data = new Uint8ClampedArray(4 * n * n);
  for (let y = 0; y < n; y++) for (let x = 0; x < n; x++) data.set([f(x, y), f(x, y), f(x, y), 255], 4 * (y * n + x));
  return { data, width: n, height: n };
};
const patterns = {
  'checks of 1 pixel': (x, y) => 255 * ((x + y) % 2),
  'stripes of 2 pixels': (x) => 255 * ((x >> 1) % 2),
};
for (const [name, f] of Object.entries(patterns)) {
  for (const n of [256, 383, 384, 600, 1024]) {
    const [a, b] = [picture(n, f), picture(n, () => 128)];
    console.log(`${name}, ${n} x ${n}, against grey: ${ssim(a, b).mssim.toFixed(3)}, `
      + `without downsample ${ssim(a, b, { downsample: false }).mssim.toFixed(3)}`);
  }
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
checks of 1 pixel, 256 x 256, against grey: 0.004, without downsample 0.004
checks of 1 pixel, 383 x 383, against grey: 0.004, without downsample 0.004
checks of 1 pixel, 384 x 384, against grey: 1.000, without downsample 0.004
checks of 1 pixel, 600 x 600, against grey: 1.000, without downsample 0.004
checks of 1 pixel, 1024 x 1024, against grey: 1.000, without downsample 0.004
stripes of 2 pixels, 256 x 256, against grey: 0.004, without downsample 0.004
stripes of 2 pixels, 383 x 383, against grey: 0.004, without downsample 0.004
stripes of 2 pixels, 384 x 384, against grey: 0.995, without downsample 0.004
stripes of 2 pixels, 600 x 600, against grey: 0.997, without downsample 0.004
stripes of 2 pixels, 1024 x 1024, against grey: 0.996, without downsample 0.004
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
