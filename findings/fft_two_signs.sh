#!/usr/bin/env bash
# The forward Fourier transforms of eight npm packages differ in sign, once even within one package.
#
# Expected. FFTW, numpy, SciPy, Octave and the textbooks of signal processing compute the forward transform with
# exp(-2 pi i j k / n). Packages for JavaScript should do the same, so that code can go from one to another:
# multiply by i k for a derivative, or by a phase to move a pattern.
#
# What happens. ndarray-fft and jsfft use exp(+2 pi i j k / n) in the direction that they call forward; so does
# DFT of dsp.js, while FFT of dsp.js has the usual sign. jsfft also divides by the root of n. Each package inverts
# its own transform, and spectra of power are right, so tests of both pass. But the derivative of sin x by these
# packages is -cos x, and a pattern that should move to the right moves to the left.
#
# Workaround: transform a single 1 at j = 1; the imaginary part at k = 1 should be negative. If not, take the
# complex conjugate of the spectrum.
#
# Seen with ndarray-fft 1.0.3, ndarray 1.1.1, jsfft 0.0.4, dsp.js 1.0.1, fft.js 4.0.4, fft-js 0.0.12, ml-fft 1.3.5,
# kissfft-js 0.1.8, fftjs 0.0.4 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts ndarray@1.1.1 ndarray-fft@1.0.3 jsfft@0.0.4 dsp.js@1.0.1 \
  fft.js@4.0.4 fft-js@0.0.12 ml-fft@1.3.5 kissfft-js@0.1.8 fftjs@0.0.4 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import ndarray from 'ndarray';
import ndarrayFft from 'ndarray-fft';
import jsfft from 'jsfft';
import dsp from 'dsp.js';
import FFTjs from 'fft.js';
import fft_js from 'fft-js';
import mlfft from 'ml-fft';
import kissfft from 'kissfft-js';
import fftjs from 'fftjs';
// Each entry returns the real and the imaginary part of the forward transform.
const packages = {
  'ndarray-fft': (f) => {
    const [re, im] = [ndarray(Float64Array.from(f), [8]), ndarray(new Float64Array(8), [8])];
    ndarrayFft(1, re, im);
    return [re.data, im.data];
  },
  jsfft: (f) => {
    const c = new jsfft.ComplexArray(8);
    c.map((value, i) => { value.real = f[i]; });
    const { real, imag } = c.FFT();
    return [real, imag];
  },
  'dsp.js DFT': (f) => { const t = new dsp.DFT(8, 8); t.forward(f); return [t.real, t.imag]; },
  'dsp.js FFT': (f) => { const t = new dsp.FFT(8, 8); t.forward(f); return [t.real, t.imag]; },
  'fft.js': (f) => {
    const t = new FFTjs(8), out = t.createComplexArray();
    t.realTransform(out, f);
    return [0, 1].map((part) => out.filter((_, i) => i % 2 === part));
  },
  'fft-js': (f) => { const out = fft_js.fft(f); return [0, 1].map((part) => out.map((z) => z[part])); },
  'ml-fft': (f) => {
    const [re, im] = [f.slice(), new Array(8).fill(0)];
    mlfft.FFT.init(8);
    mlfft.FFT.fft(re, im);
    return [re, im];
  },
  'kissfft-js': (f) => {
    const out = new kissfft.FFT(8).forward(f.flatMap((x) => [x, 0]));
    return [0, 1].map((part) => [...out].filter((_, i) => i % 2 === part));
  },
  fftjs: (f) => { const { real, imag } = fftjs.fft(f); return [real, imag]; },
};
for (const [name, forward] of Object.entries(packages)) {
  const [re, im] = forward([0, 1, 0, 0, 0, 0, 0, 0]);
  const sign = im[1] < 0 ? '-' : '+';
  console.log(`${name}: exp(${sign}2 pi i j k / n), |F(0)| = ${(+re[0]).toFixed(2)}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
ndarray-fft: exp(+2 pi i j k / n), |F(0)| = 1.00
jsfft: exp(+2 pi i j k / n), |F(0)| = 0.35
dsp.js DFT: exp(+2 pi i j k / n), |F(0)| = 1.00
dsp.js FFT: exp(-2 pi i j k / n), |F(0)| = 1.00
fft.js: exp(-2 pi i j k / n), |F(0)| = 1.00
fft-js: exp(-2 pi i j k / n), |F(0)| = 1.00
ml-fft: exp(-2 pi i j k / n), |F(0)| = 1.00
kissfft-js: exp(-2 pi i j k / n), |F(0)| = 1.00
fftjs: exp(-2 pi i j k / n), |F(0)| = 1.00
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
