#!/usr/bin/env bash
# three.js takes dark colours away from PLY files.
#
# Expected. A PLY file usually has red, green and blue of 8 bits per vertex, meant for the screen (sRGB). PLYLoader
# of three.js converts them to linear light, as the renderer needs. The renderer converts them back, so on the
# screen all 256 levels should be what they were, within one level.
#
# What happens. PLYLoader stores the linear values in 8 bits again. 256 levels become 183: the levels 0 to 6 are
# all black, 7 to 16 are all 13, and up to there a colour is off by as much as 6 levels. Dark parts of a pattern
# show bands or disappear. Colours of the type float in the same file format stay floats and are exact.
#
# Workaround: write the colours as float properties between 0 and 1, or read with setCustomPropertyNameMapping
# and convert them in floats.
#
# Seen with three 0.187.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';
import { Color, SRGBColorSpace } from 'three';
function read(type, scale) {
  const head = `ply\nformat ascii 1.0\nelement vertex 256\nproperty float x\nproperty float y\nproperty float z\n`
    + ['red', 'green', 'blue'].map((c) => `property ${type} ${c}\n`).join('') + 'end_header\n';
  const lines = [...Array(256).keys()].map((i) => `0 0 0 ${i / scale} ${i / scale} ${i / scale}\n`);
  const linear = new PLYLoader().parse(head + lines.join('')).attributes.color;
  // As the screen shows it: getX gives 0 to 1, and the renderer converts linear light to sRGB.
  const seen = lines.map((_, i) => 255 * new Color(linear.getX(i), 0, 0).getRGB({}, SRGBColorSpace).r).map(Math.round);
  const off = seen.map((v, i) => Math.abs(v - i));
  console.log(`${type}, kept as ${linear.array.constructor.name}: ${new Set(seen).size} levels of 256, `
    + `off by up to ${Math.max(...off)}; 0 to 20 are shown as ${seen.slice(0, 21).join(' ')}`);
}
read('uchar', 1);
read('float', 255);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
uchar, kept as Uint8Array: 183 levels of 256, off by up to 6; 0 to 20 are shown as 0 0 0 0 0 0 0 13 13 13 13 13 13 13 13 13 13 13 22 22 22
float, kept as Float32Array: 256 levels of 256, off by up to 0; 0 to 20 are shown as 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
