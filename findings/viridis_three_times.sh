#!/usr/bin/env bash
# Three npm packages have three different colour maps called "viridis".
#
# Expected. Viridis is a published table of 256 colours (from matplotlib). Packages that offer it by name should contain
# this table, or interpolate it with an error of at most three levels, so that a picture made with one package can be
# read back, or get a legend, with another.
#
# What happens. d3-scale-chromatic has the table. colormap and chroma-js have nine colours each and interpolate linearly
# between them. Of their 256 colours only 4 and 1 are those of the table, and a channel differs by up to 18 and 17
# levels of 255. If the values of a picture are read back from its colours by the table, they differ by up to 5 and 19
# steps of 256: with chroma-js this is 7 % of the range.
#
# Workaround: use the same package for pictures and legends, or pass the table itself, chroma.scale(list).
#
# Seen with d3-scale-chromatic 3.1.0, colormap 2.3.2, chroma-js 3.2.0 (npm), Node.js 20; chroma-js 3.1.2 behaves in the
# same way.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts d3-scale-chromatic@3.1.0 d3-color@3.1.0 colormap@2.3.2 \
  chroma-js@3.2.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { interpolateViridis } from 'd3-scale-chromatic';
import { rgb } from 'd3-color';
import colormap from 'colormap';
import chroma from 'chroma-js';
const steps = [...Array(256).keys()];
const table = steps.map((i) => rgb(interpolateViridis(i / 255))).map((c) => [c.r, c.g, c.b]);
const far = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));
const nearest = (c) => steps.reduce((best, i) => (far(table[i], c) < far(table[best], c) ? i : best), 0);
console.log(`the table: ${table[0]} ... ${table[128]} ... ${table[255]}`);
const others = {
  colormap: colormap({ colormap: 'viridis', nshades: 256, format: 'rgba' }).map((c) => c.slice(0, 3)),
  'chroma-js': steps.map((i) => chroma.scale('viridis')(i / 255).rgb()),
};
for (const [name, map] of Object.entries(others)) {
  const same = steps.filter((i) => String(map[i]) === String(table[i])).length;
  const off = steps.map((i) => Math.max(...map[i].map((x, k) => Math.abs(x - table[i][k]))));
  const read = steps.map((i) => Math.abs(nearest(map[i]) - i));
  const i = off.indexOf(Math.max(...off));
  console.log(`${name}: ${same} of 256 the same; most off at ${i}, ${map[i]} for ${table[i]}; `
    + `read back up to ${Math.max(...read)} steps off`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
the table: 68,1,84 ... 33,145,140 ... 253,231,37
colormap: 4 of 256 the same; most off at 239, 210,225,44 for 213,226,26; read back up to 5 steps off
chroma-js: 1 of 256 the same; most off at 155, 32,153,139 for 36,170,131; read back up to 19 steps off
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
