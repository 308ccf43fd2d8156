#!/usr/bin/env bash
# gltfpack cuts the weights of morph targets to the range from 0 to 1, in animations only.
#
# Expected. The weight of a morph target is any number: glTF 2.0 sets no limits, and players take 2.5 for two and a
# half times the difference and -1 for the opposite. A packer may choose bytes for weights if they lie between 0 and 1;
# otherwise it has to keep floats. -noq switches quantisation off.
#
# What happens. gltfpack writes animated weights as normalised bytes without a look at their range, with -noq as well:
# 0, 2.5, -1 become 0, 1, 0. A shape that grows beyond its target stops there, and one that swings to both sides swings
# to one. Weights of .001 become 0, as a byte has 256 steps. The weights of a mesh at rest are not changed: a mesh that
# stands at 2.5 stays there until its animation begins. Nothing warns.
#
# Workaround: scale the differences of the target, so that the weights stay between 0 and 1; use two targets for two
# directions.
#
# Seen with gltfpack 1.3.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts gltfpack@1.3.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import * as gltfpack from 'gltfpack';
import { readFileSync, writeFileSync } from 'node:fs';
// A triangle with one morph target, its weight at rest, and its weights at 0, 0.1 and 0.2 seconds.
function film(rest, weights) {
  const numbers = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0.1, 0.2, ...weights);
  const view = (byteOffset, byteLength) => ({ buffer: 0, byteOffset, byteLength });
  const floats = (bufferView, type, count) => ({ bufferView, componentType: 5126, type, count });
  return JSON.stringify({
    asset: { version: '2.0' },
    buffers: [{
      byteLength: numbers.byteLength,
      uri: `data:application/octet-stream;base64,${Buffer.from(numbers.buffer).toString('base64')}`,
    }],
    bufferViews: [view(0, 36), view(36, 36), view(72, 12), view(84, 12)],
    accessors: [
      { ...floats(0, 'VEC3', 3), min: [0, 0, 0], max: [1, 1, 0] },
      { ...floats(1, 'VEC3', 3), min: [0, 0, 1], max: [0, 0, 1] },
      { ...floats(2, 'SCALAR', 3), min: [0], max: [Math.fround(0.2)] },
      floats(3, 'SCALAR', 3),
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, targets: [{ POSITION: 1 }] }], weights: [rest] }],
    nodes: [{ mesh: 0 }],
    scenes: [{ nodes: [0] }],
    scene: 0,
    animations: [{
      samplers: [{ input: 2, output: 3 }],
      channels: [{ sampler: 0, target: { node: 0, path: 'weights' } }],
    }],
  });
}
const files = { read: (path) => readFileSync(path), write: (path, data) => writeFileSync(path, data) };
for (const [rest, weights] of [[0, [0, 0.5, 1]], [2.5, [0, 2.5, -1]], [0, [0, 0.001, 0.0015]]]) {
  for (const options of [[], ['-noq'], ['-noq', '-af', '0']]) {
    writeFileSync('film.gltf', film(rest, weights));
    await gltfpack.pack(['-i', 'film.gltf', '-o', 'packed.gltf', ...options], files);
    const packed = JSON.parse(readFileSync('packed.gltf'));
    const text = `weights ${weights.join(' ')}, at rest ${rest}, options "${options.join(' ')}": `
      + `at rest ${packed.meshes[0].weights}, `;
    if (!packed.animations) {
      console.log(`${text}no animation`);
      continue;
    }
    const accessor = packed.accessors[packed.animations[0].samplers[0].output];
    const { buffer, byteOffset = 0, byteStride } = packed.bufferViews[accessor.bufferView];
    const bytes = readFileSync(packed.buffers[buffer].uri);
    const kind = accessor.normalized && accessor.componentType === 5121 ? 'normalised bytes' : 'another type';
    const list = Array.from({ length: accessor.count }, (_, i) =>
      bytes[byteOffset + (accessor.byteOffset ?? 0) + i * (byteStride ?? 1)]);
    console.log(`${text}${kind} ${list.join(' ')}`);
  }
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
weights 0 0.5 1, at rest 0, options "": at rest 0, normalised bytes 0 43 85 128 170 213 255
weights 0 0.5 1, at rest 0, options "-noq": at rest 0, normalised bytes 0 43 85 128 170 213 255
weights 0 0.5 1, at rest 0, options "-noq -af 0": at rest 0, normalised bytes 0 128 255
weights 0 2.5 -1, at rest 2.5, options "": at rest 2.5, normalised bytes 0 213 255 255 255 42 0
weights 0 2.5 -1, at rest 2.5, options "-noq": at rest 2.5, normalised bytes 0 213 255 255 255 42 0
weights 0 2.5 -1, at rest 2.5, options "-noq -af 0": at rest 2.5, normalised bytes 0 255 0
weights 0 0.001 0.0015, at rest 0, options "": at rest 0, normalised bytes 0 0 0 0 0 0 0
weights 0 0.001 0.0015, at rest 0, options "-noq": at rest 0, normalised bytes 0 0 0 0 0 0 0
weights 0 0.001 0.0015, at rest 0, options "-noq -af 0": at rest 0, normalised bytes 0 0 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
