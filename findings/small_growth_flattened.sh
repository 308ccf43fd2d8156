#!/usr/bin/env bash
# resample() of glTF-Transform flattens the growth of small things.
#
# Expected. resample() takes keyframes away that linear interpolation gives anyway. A key that is twice as large as its
# neighbours is none of these, whatever the unit is.
#
# What happens. A key goes if it differs by less than .0001 from the straight line between its neighbours, whatever the
# numbers mean. glTF counts in metres, so this is a tenth of a millimetre: a cell of 10 micrometres that swings by
# twice its size stands still, and a scale that pulses between .00001 and .00004, for a model that was built in
# micrometres, is constant. The tolerance is the same for the weights of morph targets: of 100 frames of exponential
# growth the first 61 become one straight line. Nothing warns.
#
# Workaround: resample({ tolerance: 0 }), or build in larger units below a parent that is not animated.
#
# Seen with @gltf-transform/core 4.5.1 and @gltf-transform/functions 4.5.1 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts @gltf-transform/core@4.5.1 @gltf-transform/functions@4.5.1 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { Document, Logger } from '@gltf-transform/core';
import { resample } from '@gltf-transform/functions';
async function keys(path, times, values, options) {
  const document = new Document().setLogger(new Logger(Logger.Verbosity.SILENT));
  const buffer = document.createBuffer();
  const accessor = (type, numbers) =>
    document.createAccessor().setType(type).setArray(Float32Array.from(numbers)).setBuffer(buffer);
  const corners = accessor('VEC3', [0, 0, 0, 1, 0, 0, 0, 1, 0]);
  const target = document.createPrimitiveTarget().setAttribute('POSITION', corners);
  const primitive = document.createPrimitive().setAttribute('POSITION', corners).addTarget(target);
  const node = document.createNode().setMesh(document.createMesh().addPrimitive(primitive));
  document.createScene().addChild(node);
  const sampler = document.createAnimationSampler().setInterpolation('LINEAR').setInput(accessor('SCALAR', times))
    .setOutput(accessor(path === 'weights' ? 'SCALAR' : 'VEC3', values));
  const channel = document.createAnimationChannel().setTargetNode(node).setTargetPath(path).setSampler(sampler);
  document.createAnimation().addSampler(sampler).addChannel(channel);
  await document.transform(resample(options));
  const array = (kept) => Array.from(kept.getArray(), (v) => +v.toPrecision(4));
  return { times: array(sampler.getInput()), values: array(sampler.getOutput()) };
}
const times = [0, 1, 2, 3, 4];
for (const unit of [1, 1e-3, 1e-5]) {
  const swing = await keys('translation', times, [0, 1, 0, 2, 0].flatMap((v) => [v * unit, 0, 0]));
  const pulse = await keys('scale', times, [1, 2, 1, 4, 1].flatMap((v) => [v * unit, v * unit, v * unit]));
  console.log(`unit ${unit}: x ${swing.values.filter((_, i) => i % 3 === 0).join(' ')}, `
    + `scale ${pulse.values.filter((_, i) => i % 3 === 0).join(' ')}`);
}
const exact = await keys('translation', times, [0, 1, 0, 2, 0].flatMap((v) => [v * 1e-5, 0, 0]), { tolerance: 0 });
console.log(`unit 0.00001, tolerance 0: x ${exact.values.filter((_, i) => i % 3 === 0).join(' ')}`);
const frames = Array.from({ length: 100 }, (_, i) => i);
const growth = await keys('weights', frames, frames.map((i) => Math.exp((i - 99) / 5)));
console.log(`growth by exp(t / 5), frames 0 to 99: kept ${growth.times.slice(0, 4).join(' ')} and so on`);
console.log(`weights there: ${growth.values.slice(0, 4).join(' ')}, a factor of `
  + `${(growth.values[1] / growth.values[0]).toPrecision(3)} in one straight line`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
unit 1: x 0 1 0 2 0, scale 1 2 1 4 1
unit 0.001: x 0 0.001 0 0.002 0, scale 0.001 0.002 0.001 0.004 0.001
unit 0.00001: x 0 0, scale 0.00001 0.00001
unit 0.00001, tolerance 0: x 0 0.00001 0 0.00002 0
growth by exp(t / 5), frames 0 to 99: kept 0 61 66 69 and so on
weights there: 2.517e-9 0.0005005 0.00136 0.002479, a factor of 1.99e+5 in one straight line
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
