#!/usr/bin/env bash
# The spectrum of RFFT in dsp.js mixes each wave number with its neighbour.
#
# Expected. A cosine of wave number k has a spectrum with one peak, at k. RFFT, the fast class of dsp.js for real
# data, should give the same field "spectrum" as its class FFT.
#
# What happens. RFFT takes the real part of F(k) together with the imaginary part of F(k+1). A cosine is right
# by chance. A sine of wave number k appears at k - 1: stripes seem longer than they are. A wave with both parts
# appears as two peaks, neither with its height. The list "trans", with the transform itself, is right. The spectrum
# has the usual shape, and nobody sees that it is wrong.
#
# Workaround: compute the spectrum from "trans" (first the real parts, then the imaginary parts backwards), or use FFT.
#
# Seen with dsp.js 1.0.1 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts dsp.js@1.0.1 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import dsp from 'dsp.js';
const n = 16;
const show = (v) => [...v].map((x) => x.toFixed(2).replace('-0.00', '0.00')).join(' ');
for (const [name, phase] of [['cosine', 0], ['sine', Math.PI / 2], ['phase of 45 degrees', Math.PI / 4]]) {
  const wave = Float64Array.from({ length: n }, (_, j) => Math.cos(2 * Math.PI * 4 * j / n - phase));
  const slow = new dsp.FFT(n, n), fast = new dsp.RFFT(n, n);
  slow.forward(wave);
  fast.forward(wave);
  const own = Array.from({ length: n / 2 }, (_, k) => 2 / n * Math.hypot(fast.trans[k], k ? fast.trans[n - k] : 0));
  console.log(`${name} of wave number 4, FFT:  ${show(slow.spectrum)}`);
  console.log(`${name} of wave number 4, RFFT: ${show(fast.spectrum)}`);
  console.log(`${name} of wave number 4, from trans: ${show(own)}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
cosine of wave number 4, FFT:  0.00 0.00 0.00 0.00 1.00 0.00 0.00 0.00
cosine of wave number 4, RFFT: 0.00 0.00 0.00 0.00 1.00 0.00 0.00 0.00
cosine of wave number 4, from trans: 0.00 0.00 0.00 0.00 1.00 0.00 0.00 0.00
sine of wave number 4, FFT:  0.00 0.00 0.00 0.00 1.00 0.00 0.00 0.00
sine of wave number 4, RFFT: 0.00 0.00 0.00 1.00 0.00 0.00 0.00 0.00
sine of wave number 4, from trans: 0.00 0.00 0.00 0.00 1.00 0.00 0.00 0.00
phase of 45 degrees of wave number 4, FFT:  0.00 0.00 0.00 0.00 1.00 0.00 0.00 0.00
phase of 45 degrees of wave number 4, RFFT: 0.00 0.00 0.00 0.71 0.71 0.00 0.00 0.00
phase of 45 degrees of wave number 4, from trans: 0.00 0.00 0.00 0.00 1.00 0.00 0.00 0.00
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
