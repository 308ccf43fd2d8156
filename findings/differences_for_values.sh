#!/usr/bin/env bash
# zarr.js returns the differences that a Zarr array stores instead of its values, and zarrita mixes up their size.
#
# Expected. A Zarr array of version 2 lists the filters through which its numbers went. The filter "delta" of numcodecs
# stores the first number and then differences, usually in a smaller type: dtype is that of the numbers and astype
# that of the differences. A reader adds the differences up, or refuses a filter that it does not know.
#
# What happens. zarr.js never looks at the filters. If both types have the same size, it returns the differences as
# values: a line 100, 101, 102 becomes 100, 1, 1. zarrita knows delta and is right in this case. If astype is smaller,
# zarr.js throws, and zarrita takes the stored bytes for numbers of the larger type: int16 differences that should be
# int32 numbers become half as many large ones, and the rest of the chunk is 0. Neither warns.
#
# Workaround: with zarr.js, do not use filters; with zarrita, give delta no astype. A compressor after it finds the
# small differences as well.
#
# Seen with zarr 0.6.3 and zarrita 0.7.5 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts zarr@0.6.3 zarrita@0.7.5 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import * as zarr from 'zarr';
import * as zarrita from 'zarrita';
const text = (object) => new TextEncoder().encode(JSON.stringify(object));
const bytes = (array) => new Uint8Array(array.buffer);
const meta = (dtype, filters) => text({
  zarr_format: 2, shape: [6], chunks: [6], dtype, fill_value: 0, order: 'C', compressor: null, filters,
});
const delta = (dtype, astype) => [{ id: 'delta', dtype, astype }];
const steps = [100, 1, 1, 1, 1, 1]; // 100 101 102 103 104 105
const files = {
  'plain/.zarray': meta('<i4', null),
  'plain/0': bytes(Int32Array.of(100, 101, 102, 103, 104, 105)),
  'i4 as i4/.zarray': meta('<i4', delta('<i4', '<i4')),
  'i4 as i4/0': bytes(Int32Array.from(steps)),
  'i4 as i2/.zarray': meta('<i4', delta('<i4', '<i2')),
  'i4 as i2/0': bytes(Int16Array.from(steps)),
  'f8 as f8/.zarray': meta('<f8', delta('<f8', '<f8')),
  'f8 as f8/0': bytes(Float64Array.from(steps)),
};
const store = {
  get: async (key) => files[key.slice(1)],
  async getItem(key) {
    if (!(key in files)) throw new zarr.KeyError(key);
    return files[key].slice().buffer;
  },
  containsItem: async (key) => key in files,
};
for (const path of ['plain', 'i4 as i4', 'f8 as f8', 'i4 as i2']) {
  let old;
  try {
    old = [...(await (await zarr.openArray({ store, path, mode: 'r' })).get(null)).data].join(' ');
  } catch (error) {
    old = 'an error';
  }
  const array = await zarrita.open.v2(zarrita.root(store).resolve(path), { kind: 'array' });
  console.log(`${path}: zarr.js ${old} | zarrita ${[...(await zarrita.get(array)).data].join(' ')}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
plain: zarr.js 100 101 102 103 104 105 | zarrita 100 101 102 103 104 105
i4 as i4: zarr.js 100 1 1 1 1 1 | zarrita 100 101 102 103 104 105
f8 as f8: zarr.js 100 1 1 1 1 1 | zarrita 100 101 102 103 104 105
i4 as i2: zarr.js an error | zarrita 65636 131173 196710 0 0 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
