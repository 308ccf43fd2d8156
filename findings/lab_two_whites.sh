#!/usr/bin/env bash
# Eight npm packages have two kinds of Lab colours.
#
# Expected. CIE Lab is defined relative to a white. Screens and sRGB have the white D65, so Lab numbers, legends and
# colour differences should be the same in all packages.
#
# What happens. d3-color, culori (lab), colorjs.io (lab) and color-space adapt the colour to the white D50, that of
# printing and of lab() in CSS. chroma-js, color-convert, rgb-lab and color-diff keep D65, as do scikit-image and
# MATLAB; culori calls this one lab65. Greys are equal in both, and white is (100, 0, 0) in both, so quick tests pass.
# Pure green differs by 7 and pure blue by 12, several times what the eye can tell. Pure green that is taken as Lab
# from d3-color to chroma-js becomes (72, 253, 26), and blue (0, 34, 254), and a colour map with equal steps in one
# package is uneven in the other.
#
# Workaround: use one package for both directions; lab65 of culori and lab-d65 of colorjs.io are the second kind.
#
# Seen with d3-color 3.1.1, culori 4.0.2, colorjs.io 0.7.1, color-space 3.1.0, chroma-js 3.2.0, color-convert 3.1.3,
# rgb-lab 1.0.0, color-diff 1.4.0 (npm), Node.js 20.
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
  d3-color@3.1.1 culori@4.0.2 colorjs.io@0.7.1 color-space@3.1.0 chroma-js@3.2.0 color-convert@3.1.3 \
  rgb-lab@1.0.0 color-diff@1.4.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { lab as d3lab, rgb as d3rgb } from 'd3-color';
import { lab as culoriLab, lab65 } from 'culori';
import Color from 'colorjs.io';
import space from 'color-space';
import chroma from 'chroma-js';
import convert from 'color-convert';
import rgbLab from 'rgb-lab';
import * as colorDiff from 'color-diff';
const list = (c) => [c.l ?? c.L, c.a, c.b];
const mode = ([r, g, b]) => ({ mode: 'rgb', r: r / 255, g: g / 255, b: b / 255 });
const packages = {
  'd3-color': (c) => list(d3lab(d3rgb(...c))),
  'culori lab': (c) => list(culoriLab(mode(c))),
  'colorjs.io': (c) => new Color('srgb', c.map((v) => v / 255)).to('lab').coords,
  'color-space': (c) => space.rgb.lab(c),
  'culori lab65': (c) => list(lab65(mode(c))),
  'chroma-js': (c) => chroma(c).lab(),
  'color-convert': (c) => convert.rgb.lab.raw(c),
  'rgb-lab': (c) => (rgbLab.rgb2lab ?? rgbLab)(c),
  'color-diff': (c) => list(colorDiff.rgb_to_lab({ R: c[0], G: c[1], B: c[2] })),
};
const colours = { green: [0, 255, 0], blue: [0, 0, 255], grey: [128, 128, 128] };
const text = (v) => [...v].map((x) => Math.round(x) + 0).join(' ');
for (const [name, f] of Object.entries(packages)) {
  console.log(`${name}: ${Object.entries(colours).map(([colour, c]) => `${colour} ${text(f(c))}`).join(', ')}`);
}
for (const colour of ['green', 'blue']) {
  const [a, b] = [packages['d3-color'](colours[colour]), packages['chroma-js'](colours[colour])];
  console.log(`${colour}: the two are ${Math.hypot(...a.map((v, i) => v - b[i])).toFixed(1)} apart; `
    + `from d3-color to chroma-js it becomes ${chroma.lab(...a).rgb().join(' ')}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
d3-color: green 88 -79 81, blue 30 68 -112, grey 54 0 0
culori lab: green 88 -79 81, blue 30 68 -112, grey 54 0 0
colorjs.io: green 88 -79 81, blue 30 68 -112, grey 54 0 0
color-space: green 88 -79 81, blue 30 68 -112, grey 54 0 0
culori lab65: green 88 -86 83, blue 32 79 -108, grey 54 0 0
chroma-js: green 88 -86 83, blue 32 79 -108, grey 54 0 0
color-convert: green 88 -86 83, blue 32 79 -108, grey 54 0 0
rgb-lab: green 88 -86 83, blue 32 79 -108, grey 54 0 0
color-diff: green 88 -86 83, blue 32 79 -108, grey 54 0 0
green: the two are 7.2 apart; from d3-color to chroma-js it becomes 72 253 26
blue: the two are 12.0 apart; from d3-color to chroma-js it becomes 0 34 254
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
