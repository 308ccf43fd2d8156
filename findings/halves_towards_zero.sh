#!/usr/bin/env bash
# three.js rounds towards zero when it makes 16-bit floats, so pictures get darker.
#
# Expected. IEEE 754 rounds a number to the nearest one that the smaller format has, as numpy, the package float16, and
# processors with an instruction for it do. DataUtils.toHalfFloat() of three.js turns numbers into 16-bit floats for
# textures and EXR files, and should do the same.
#
# What happens. It cuts the lower bits off. .9999 becomes .99951 instead of 1, and 2049.9 becomes 2048 instead of 2050;
# 5.9e-8, which rounds to the smallest number, becomes 0. The error is up to twice as large, and always has the same
# sign: of 4000 random numbers that EXRExporter writes none is above its original, and their mean is 1/4000 lower; with
# the nearest numbers the mean stays. So an amount that is conserved seems to shrink, a bound such as u < 1 holds in the
# file although it was reached, and a file differs from that of another program in half of its numbers.
#
# Workaround: make the halves with setFloat16 of float16, and pass a texture of the type HalfFloatType.
#
# Seen with three 0.187.0 and @petamoriken/float16 3.9.3 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 @petamoriken/float16@3.9.3 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { setFloat16 } from '@petamoriken/float16';
import { DataTexture, DataUtils, FloatType, HalfFloatType, RGBAFormat } from 'three';
import { EXRExporter, NO_COMPRESSION } from 'three/examples/jsm/exporters/EXRExporter.js';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';
const view = new DataView(new ArrayBuffer(2));
const nearest = (x) => (setFloat16(view, 0, x), DataUtils.fromHalfFloat(view.getUint16(0)));
for (const x of [0.5, 0.9999, -0.9999, 2049.9, 5.9e-8]) {
  console.log(`${x}: three.js ${+DataUtils.fromHalfFloat(DataUtils.toHalfFloat(x)).toPrecision(5)}, `
    + `nearest ${+nearest(x).toPrecision(5)}`);
}
let seed = 1;
const u = Float32Array.from({ length: 4000 }, () => 0.5 + (seed = (seed * 16807) % 2147483647) / 4294967294);
const picture = new DataTexture(u, 1000, 1, RGBAFormat, FloatType);
const bytes = await new EXRExporter().parse(picture, { type: HalfFloatType, compression: NO_COMPRESSION });
const written = new EXRLoader().setDataType(FloatType).parse(bytes.buffer).data;
const report = (name, v) => {
  const mean = v.reduce((sum, x, i) => sum + x - u[i], 0) / v.length;
  console.log(`${name}: ${v.filter((x, i) => x > u[i]).length} of 4000 above, `
    + `${v.filter((x, i) => x < u[i]).length} below, mean off by ${+mean.toFixed(5) || 0}`);
};
report('EXRExporter', written);
report('nearest', u.map(nearest));
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
0.5: three.js 0.5, nearest 0.5
0.9999: three.js 0.99951, nearest 1
-0.9999: three.js -0.99951, nearest -1
2049.9: three.js 2048, nearest 2050
5.9e-8: three.js 0, nearest 5.9605e-8
EXRExporter: 0 of 4000 above, 3999 below, mean off by -0.00024
nearest: 1985 of 4000 above, 2014 below, mean off by 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
