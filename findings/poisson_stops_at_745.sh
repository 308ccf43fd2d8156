#!/usr/bin/env bash
# The Poisson numbers of randgen and prob.js never go far beyond 745.
#
# Expected. A Poisson random number of mean m has the mean m and the variance m, for each m. Stochastic simulations
# draw the number of reactions or births in a step from it, with means from 0 to thousands.
#
# What happens. The two packages multiply random numbers until the product is below exp(-m). For m above 745 this is 0
# in doubles, and the product becomes 0 after about 745 factors. So the mean is 745 for each m above that, with the
# variance of 745, and a reaction that should happen 5000 times per step happens 745 times. Up to m = 700 the numbers
# are right, so small tests pass, and nothing warns. jstat and d3-random are right throughout.
#
# Workaround: d3-random or jstat, or the sum of several numbers with means below 700.
#
# Seen with randgen 0.1.0, prob.js 1.0.6, jstat 1.9.6 and d3-random 3.0.2 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts randgen@0.1.0 prob.js@1.0.6 jstat@1.9.6 d3-random@3.0.2 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
// Uniform random numbers that are the same in each run; some packages take Math.random when they are loaded.
let state = 1;
Math.random = () => {
  state = (state + 0x6d2b79f5) | 0;
  let x = Math.imul(state ^ (state >>> 15), 1 | state);
  x = (x + Math.imul(x ^ (x >>> 7), 61 | x)) ^ x;
  return ((x ^ (x >>> 14)) >>> 0) / 4294967296;
};
const { default: randgen } = await import('randgen');
const { default: Prob } = await import('prob.js');
const { default: jStat } = await import('jstat');
const { randomPoisson } = await import('d3-random');
const packages = {
  randgen: (mean) => () => randgen.rpoisson(mean),
  'prob.js': (mean) => Prob.poisson(mean),
  jstat: (mean) => () => jStat.poisson.sample(mean),
  'd3-random': (mean) => randomPoisson(mean),
};
for (const mean of [10, 700, 1000, 5000]) {
  const means = Object.entries(packages).map(([name, make]) => {
    const draw = make(mean), count = 2000;
    let sum = 0;
    for (let i = 0; i < count; ++i) sum += draw();
    const error = 5 * Math.sqrt(mean / count);
    if (Math.abs(sum / count - mean) < error) return `${name} right`;
    return `${name} ${Math.abs(sum / count - 745) < 5 ? 'about 745' : (sum / count).toFixed(0)}`;
  });
  console.log(`mean ${mean}: ${means.join(', ')}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
mean 10: randgen right, prob.js right, jstat right, d3-random right
mean 700: randgen right, prob.js right, jstat right, d3-random right
mean 1000: randgen about 745, prob.js about 745, jstat right, d3-random right
mean 5000: randgen about 745, prob.js about 745, jstat right, d3-random right
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
