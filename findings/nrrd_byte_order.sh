#!/usr/bin/env bash
# NRRDLoader of three.js ignores the byte order of the file.
#
# Expected. The header of an NRRD file says "endian: big" or "endian: little" if its numbers have several bytes,
# because scanners and older machines write big-endian volumes. A reader should swap the bytes, or refuse the file.
#
# What happens. NRRDLoader reads the field, but always takes the numbers as little-endian. 1 2 3 becomes 256 512
# 768; of floats, 1 becomes 4.6e-41, so the volume looks empty. min and max of the volume, from which viewers
# choose their window, are wrong as well. There is no warning. nrrd-js reads the same file correctly.
#
# Workaround: swap the bytes before the call, and say "endian: little" in the header.
#
# Seen with three 0.187.0, nrrd-js 0.2.1 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 nrrd-js@0.2.1 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { NRRDLoader } from 'three/examples/jsm/loaders/NRRDLoader.js';
import nrrd from 'nrrd-js';
console.log = console.warn = () => {}; // the loader reports its progress
const print = (s) => process.stdout.write(s + '\n');
const put = { short: [2, 'Int16'], float: [4, 'Float'] };
function file(type, order, values) {
  const [bytes, kind] = put[type];
  const data = Buffer.alloc(bytes * values.length);
  values.forEach((v, i) => data[`write${kind}${order === 'big' ? 'BE' : 'LE'}`](v, bytes * i));
  const head = `NRRD0004\ntype: ${type}\ndimension: 3\nsizes: 3 1 1\nendian: ${order}\nencoding: raw\n\n`;
  const all = Buffer.concat([Buffer.from(head), data]);
  return all.buffer.slice(all.byteOffset, all.byteOffset + all.length);
}
for (const type of ['short', 'float']) {
  for (const order of ['little', 'big']) {
    const three = new NRRDLoader().parse(file(type, order, [1, 2, 3]));
    const other = nrrd.parse(file(type, order, [1, 2, 3]));
    const show = (a) => Array.from(a, (x) => +x.toPrecision(2)).join(' ');
    print(`${order} ${type} 1 2 3: three ${show(three.data)}, from ${+three.min.toPrecision(2)} to `
      + `${+three.max.toPrecision(2)}; nrrd-js ${show(other.data)}`);
  }
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
little short 1 2 3: three 1 2 3, from 1 to 3; nrrd-js 1 2 3
big short 1 2 3: three 260 510 770, from 260 to 770; nrrd-js 1 2 3
little float 1 2 3: three 1 2 3, from 1 to 3; nrrd-js 1 2 3
big float 1 2 3: three 4.6e-41 9e-44 2.3e-41, from 9e-44 to 4.6e-41; nrrd-js 1 2 3
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
