#!/usr/bin/env bash
# PCDLoader of loaders.gl swaps the red and blue of point clouds.
#
# Expected. In a PCD file the field rgb holds a colour as the whole number 0xRRGGBB, stored either as such (type U) or
# in the bits of a float (type F, the older way, PCD file format 0.7 and PointXYZRGB of PCL). In binary files on the
# usual processors blue is therefore the first of the four bytes. PCDLoader of three.js reads all three kinds.
#
# What happens. loaders.gl takes the first byte for red and the third for blue: orange becomes blue. In ASCII files of
# type U it also converts the number to a float first, whose bits are another colour: the orange 200 100 50 becomes 50
# 100 72. Nothing warns; positions are right, and greens, greys and purples look right, too.
#
# Workaround: swap the first and third number of each colour in COLOR_0, and write type F.
#
# Seen with @loaders.gl/pcd and core 4.4.2, three 0.187.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts \
  @loaders.gl/core@4.4.2 @loaders.gl/pcd@4.4.2 @math.gl/types@4.1.0 three@0.187.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { parse } from '@loaders.gl/core';
import { PCDLoader } from '@loaders.gl/pcd';
import { Color, SRGBColorSpace } from 'three';
import { PCDLoader as ThreeLoader } from 'three/addons/loaders/PCDLoader.js';
const colours = [[200, 100, 50], [250, 5, 10]];
const packed = colours.map(([r, g, b]) => (r << 16) | (g << 8) | b);
const asFloat = (bits) => new Float32Array(new Uint32Array([bits]).buffer)[0];
const header = (type, data) => `# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F ${type}\n`
  + `COUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ${data}\n`;
const text = (type) => header(type, 'ascii')
  + packed.map((bits, i) => `${i} 2 3 ${type === 'U' ? bits : asFloat(bits)}\n`).join('');
function binary() {
  const head = new TextEncoder().encode(header('U', 'binary')), file = new Uint8Array(head.length + 32);
  const view = new DataView(file.buffer);
  file.set(head);
  packed.forEach((bits, i) => {
    [i, 2, 3].forEach((x, k) => view.setFloat32(head.length + 16 * i + 4 * k, x, true));
    view.setUint32(head.length + 16 * i + 12, bits, true);
  });
  return file;
}
function byThree(file) {
  const { color } = new ThreeLoader().parse(file).geometry.attributes;
  return colours.map((_, i) => {
    const { r, g, b } = new Color().fromBufferAttribute(color, i).getRGB({}, SRGBColorSpace);
    return [r, g, b].map((x) => Math.round(255 * x)).join(' ');
  }).join(', ');
}
console.log(`the colours: ${colours.map((c) => c.join(' ')).join(', ')}`);
for (const [name, file] of [['ASCII, type F', text('F')], ['ASCII, type U', text('U')], ['binary', binary()]]) {
  const { buffer } = typeof file === 'string' ? new TextEncoder().encode(file) : file;
  const three = byThree(buffer.slice(0));
  const { value } = (await parse(buffer.slice(0), PCDLoader, { worker: false })).attributes.COLOR_0;
  console.log(`${name}: three.js ${three}; loaders.gl ${value.slice(0, 3).join(' ')}, ${value.slice(3, 6).join(' ')}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
the colours: 200 100 50, 250 5 10
ASCII, type F: three.js 200 100 50, 250 5 10; loaders.gl 50 100 200, 10 5 250
ASCII, type U: three.js 200 100 50, 250 5 10; loaders.gl 50 100 72, 10 5 122
binary: three.js 200 100 50, 250 5 10; loaders.gl 50 100 200, 10 5 250
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
