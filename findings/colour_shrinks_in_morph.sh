#!/usr/bin/env bash
# Two packers of glTF files lose the negative colour differences of morph targets.
#
# Expected. In glTF 2.0 a morph target may contain COLOR_0. Its values are differences, which are multiplied by the
# weight of the target and added to the colours of the mesh (section on morph targets). A pattern that grows from red to
# blue has negative differences in red. The standard allows signed or unsigned normalised integers or floats for
# differences, so a packer should use signed integers, or leave these floats unchanged.
#
# What happens. quantize() of glTF-Transform and gltfpack both write the differences as UNSIGNED normalised bytes: -1,
# -0.5 and -0.1 all become 0. There is no warning, and the validator reports nothing. A colour that changed from (1, .5,
# .2) to (0, 1, .1) now ends at (1, 1, .2). gltfpack does the same with -noq, which should switch quantisation off.
#
# Workaround: give the mesh the darkest colours, so that all differences are positive; or call quantize() with a pattern
# that excludes COLOR, as the last line of the output shows.
#
# Seen with @gltf-transform/core, extensions and functions 4.5.1, gltfpack 1.3.0 (npm), Node.js 20. The older 4.1.1
# and 0.22.0 behaved alike.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts @gltf-transform/core@4.5.1 \
  @gltf-transform/extensions@4.5.1 @gltf-transform/functions@4.5.1 gltfpack@1.3.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > make.js <<'EOF_JS'
// One triangle, its colours, and one target that only changes the colours.
import fs from 'node:fs';
const floats = [[0, 0, 0, 1, 0, 0, 0, 1, 0],
  [1, .5, .2, 1, 1, .5, .2, 1, 1, .5, .2, 1],
  [-1, .5, -.1, 0, -.5, .25, .3, 0, -1, .5, .8, 0]].map((a) => Buffer.from(new Float32Array(a).buffer));
const corners = Buffer.from(new Uint16Array([0, 1, 2, 0]).buffer);
const bin = Buffer.concat([...floats, corners]);
let at = 0;
const views = [...floats, corners].map((b, i) => {
  const v = { buffer: 0, byteOffset: at, byteLength: i === 3 ? 6 : b.length, target: i === 3 ? 34963 : 34962 };
  at += b.length;
  return v;
});
const accessor = (bufferView, type, more) => ({ bufferView, componentType: 5126, count: 3, type, ...more });
fs.writeFileSync('in.gltf', JSON.stringify({
  asset: { version: '2.0' },
  buffers: [{ byteLength: bin.length, uri: 'data:application/octet-stream;base64,' + bin.toString('base64') }],
  bufferViews: views,
  accessors: [accessor(0, 'VEC3', { min: [0, 0, 0], max: [1, 1, 0] }), accessor(1, 'VEC4'), accessor(2, 'VEC4'),
    { bufferView: 3, componentType: 5123, count: 3, type: 'SCALAR' }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0, COLOR_0: 1 }, indices: 3, targets: [{ COLOR_0: 2 }] }],
    weights: [1] }],
  nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
}));
EOF_JS
cat > show.js <<'EOF_JS'
import { NodeIO, Logger } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { quantize } from '@gltf-transform/functions';
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
const show = (name, doc) => {
  const a = doc.getRoot().listMeshes()[0].listPrimitives()[0].listTargets()[0].getAttribute('COLOR_0');
  const rgb = [0, 1, 2].map((i) => a.getElement(i, []).slice(0, 3).map((x) => +x.toFixed(2)).join(' '));
  console.log(`${name}: ${a.getArray().constructor.name} ${rgb.join(' | ')}`);
};
const quantized = async (options) => {
  const doc = await io.read('in.gltf');
  doc.setLogger(new Logger(Logger.Verbosity.SILENT));
  await doc.transform(quantize(options));
  return io.readBinary(await io.writeBinary(doc)); // as somebody reads the file that was written
};
show('as written', await io.read('in.gltf'));
show('quantize()', await quantized({}));
show('gltfpack', await io.read('packed.glb'));
show('gltfpack -noq', await io.read('noq.glb'));
show('quantize() without COLOR', await quantized({ pattern: /^(POSITION|NORMAL|TEXCOORD_\d+)$/ }));
EOF_JS
node make.js
npx --no-install gltfpack -i in.gltf -o packed.glb
npx --no-install gltfpack -i in.gltf -o noq.glb -noq
node show.js | tee seen
cat > expected <<'EOF_TXT'
as written: Float32Array -1 0.5 -0.1 | -0.5 0.25 0.3 | -1 0.5 0.8
quantize(): Uint8Array 0 0.5 0 | 0 0.25 0.3 | 0 0.5 0.8
gltfpack: Uint8Array 0 0.5 0 | 0 0.25 0.3 | 0 0.5 0.8
gltfpack -noq: Uint8Array 0 0.5 0 | 0 0.25 0.3 | 0 0.5 0.8
quantize() without COLOR: Float32Array -1 0.5 -0.1 | -0.5 0.25 0.3 | -1 0.5 0.8
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
