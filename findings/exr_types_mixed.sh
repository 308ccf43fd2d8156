#!/usr/bin/env bash
# If the channels of an EXR file have different types, three.js shows wrong colours without a warning.
#
# Expected. In OpenEXR each channel has a pixel type of its own, half, float or 32-bit whole number (file layout, the
# attribute "channels"), and a scan line contains the channels one after the other in the order of their names. A file
# with halves for two colours and floats for the third, which needs more precision, is valid. A reader should read each
# channel by its type, or say that it cannot, as ffmpeg does.
#
# What happens. EXRLoader of three.js computes the offset of each channel from the channel's own size, but reads all
# colours with the type of the last channel in the list, R. If B has floats, it reads the two halves of each float as
# two numbers: .25 becomes alternately 0 and 1.625. If R has floats, G and B are also read as floats: first values close
# to 0, then whatever follows in the file, partly R's values. A depth channel Z of another type does no harm. parse-exr,
# the same code without three.js, also gives 0 and 1.625.
#
# Workaround: the same type for R, G, B and A.
#
# Seen with three 0.170.0, 0.180.0 and 0.187.0, parse-exr 1.0.2 (npm), Node.js 20. The script uses 0.187.0.
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
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';
import { FloatType } from 'three';
const HALF = 1, FLOAT = 2;
const halves = new Map([[0.5, 0x3800], [0.25, 0x3400], [0.75, 0x3a00], [9, 0x4880]]);
const i32 = (...a) => Buffer.from(new Int32Array(a).buffer);
const text = (s) => Buffer.from(s + '\0');
// An uncompressed EXR of 4 x 1 pixels in which every channel has one value everywhere.
function exr(channels) {
  const names = Object.keys(channels).sort();
  const attribute = (name, type, data) => Buffer.concat([text(name), text(type), i32(data.length), data]);
  const list = names.map((n) => Buffer.concat([text(n), i32(channels[n][0], 0, 1, 1)]));
  const head = Buffer.concat([i32(20000630, 2),
    attribute('channels', 'chlist', Buffer.concat([...list, Buffer.from([0])])),
    attribute('compression', 'compression', Buffer.from([0])),
    attribute('dataWindow', 'box2i', i32(0, 0, 3, 0)),
    attribute('displayWindow', 'box2i', i32(0, 0, 3, 0)),
    attribute('lineOrder', 'lineOrder', Buffer.from([0])),
    attribute('pixelAspectRatio', 'float', Buffer.from(new Float32Array([1]).buffer)),
    attribute('screenWindowCenter', 'v2f', i32(0, 0)),
    attribute('screenWindowWidth', 'float', Buffer.from(new Float32Array([1]).buffer)),
    Buffer.from([0])]);
  const line = Buffer.concat(names.map((n) => {
    const [type, v] = channels[n];
    const array = type === HALF ? new Uint16Array(4).fill(halves.get(v)) : new Float32Array(4).fill(v);
    return Buffer.from(array.buffer);
  }));
  return Buffer.concat([head, i32(head.length + 8, 0), i32(0, line.length), line]);
}
function show(name, channels) {
  const file = exr(channels);
  let says;
  try {
    const { data } = new EXRLoader().setDataType(FloatType)
      .parse(file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
    const colour = (i) => [...data.subarray(4 * i, 4 * i + 3)].map((x) => +x.toFixed(3)).join(' ');
    says = [0, 1, 2, 3].map(colour).join(' | ');
  } catch (error) {
    says = 'an error: ' + (error.message ?? error);
  }
  console.log(`${name}: ${says}`);
}
show('all half         ', { R: [HALF, .75], G: [HALF, .5], B: [HALF, .25] });
show('all half, Z float', { R: [HALF, .75], G: [HALF, .5], B: [HALF, .25], Z: [FLOAT, 9] });
show('B float, R G half', { R: [HALF, .75], G: [HALF, .5], B: [FLOAT, .25] });
show('R float, G B half', { R: [FLOAT, .75], G: [HALF, .5], B: [HALF, .25] });
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
all half         : 0.75 0.5 0.25 | 0.75 0.5 0.25 | 0.75 0.5 0.25 | 0.75 0.5 0.25
all half, Z float: 0.75 0.5 0.25 | 0.75 0.5 0.25 | 0.75 0.5 0.25 | 0.75 0.5 0.25
B float, R G half: 0.75 0.5 0 | 0.75 0.5 1.625 | 0.75 0.5 0 | 0.75 0.5 1.625
R float, G B half: 0.75 0 0 | 0.75 0 0 | 0.75 0.75 0 | 0.75 0.75 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
