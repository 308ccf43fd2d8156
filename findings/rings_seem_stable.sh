#!/usr/bin/env bash
# numeric.js calls the symmetric repressilator stable: its eigenvalues of a ring of species are wrong.
#
# Expected. The Jacobian of three genes that repress each other in a ring is -1 on the diagonal and -k in a cycle. Its
# eigenvalues are -1 - k w for the three cube roots w of 1. For k = 3 they are -4 and .5 +- 2.598 i: the steady
# state is unstable and the genes oscillate. A library that computes eigenvalues of real matrices should find them.
#
# What happens. numeric.eig returns -1, -1, -1 without an imaginary part or a warning, so the ring seems stable. It
# does the same for rings in which each species activates the next, and for unequal k, as long as all species decay
# equally fast. If the decay rates differ (last matrix), the result is right. mathjs throws "failed to converge"
# for the first three. ml-matrix is right throughout.
#
# Workaround: ml-matrix, or compare the sum of the squared eigenvalues with the trace of A * A.
#
# Seen with numeric 1.2.6, mathjs 15.2.0, ml-matrix 6.15.1 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts numeric@1.2.6 mathjs@15.2.0 ml-matrix@6.15.1 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import numeric from 'numeric';
import { eigs } from 'mathjs';
import { EVD, Matrix } from 'ml-matrix';
const matrices = {
  'three that repress each other': [[-1, 0, -3], [-3, -1, 0], [0, -3, -1]],
  'three that activate each other': [[-1, 1, 0], [0, -1, 1], [1, 0, -1]],
  'unequal repression': [[-1, 0, -3], [-2.9, -1, 0], [0, -3, -1]],
  'unequal decay': [[-1, 0, -3], [-3, -1.1, 0], [0, -3, -0.9]],
};
const list = (re, im) => [...re].map((r, i) => [r, Math.abs(im?.[i] ?? 0)]).sort((a, b) => a[0] - b[0])
  .map(([r, i]) => (r + 1e-9).toFixed(2) + (i > 1e-6 ? `+-${i.toFixed(2)}i` : '')).join(' ');
for (const [name, A] of Object.entries(matrices)) {
  const { x, y } = numeric.eig(A).lambda;
  const evd = new EVD(new Matrix(A));
  let says;
  try {
    const v = eigs(A).values.map((z) => (typeof z === 'number' ? { re: z, im: 0 } : z));
    says = list(v.map((z) => z.re), v.map((z) => z.im));
  } catch (error) {
    says = 'an error';
  }
  console.log(`${name}: numeric ${list(x, y)} | mathjs ${says} | `
    + `ml-matrix ${list(evd.realEigenvalues, evd.imaginaryEigenvalues)}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
three that repress each other: numeric -1.00 -1.00 -1.00 | mathjs an error | ml-matrix -4.00 0.50+-2.60i 0.50+-2.60i
three that activate each other: numeric -1.00 -1.00 -1.00 | mathjs an error | ml-matrix -1.50+-0.87i -1.50+-0.87i 0.00
unequal repression: numeric -1.00 -1.00 -1.00 | mathjs an error | ml-matrix -3.97 0.48+-2.57i 0.48+-2.57i
unequal decay: numeric -4.00 0.50+-2.60i 0.50+-2.60i | mathjs -4.00 0.50+-2.60i 0.50+-2.60i | ml-matrix -4.00 0.50+-2.60i 0.50+-2.60i
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
