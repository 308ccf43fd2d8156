#!/usr/bin/env bash
# solveODE() of mathjs can cross the whole time span in one step, whatever the tolerance.
#
# Expected. solveODE(f, tspan, y0, options) has a tolerance, tol, and chooses its steps by it. Other solvers with these
# methods derive the size of the first step from the equation, since an estimate of the error means little for a step
# that is too long.
#
# What happens. Without firstStep, the first step is the whole span. If the two formulas of the method agree in it by
# chance, it is accepted, and the work is done. Decay, y' = -y from 0 to 1, is 1/3 instead of .368 by RK23 with every
# tolerance, since both formulas give 1/3. A growth driven by daylight, sin^2(pi t), is 0 after 8 days by RK23 and after
# 90 days by RK45, because all stages fall on midnight; 5 and 45 days are right. There is no warning; only the list of
# times has just two entries.
#
# Workaround: give firstStep, as in the last lines of the output, and maxStep if something drives the equation.
#
# Seen with mathjs 15.2.0 (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts mathjs@15.2.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { solveODE } from 'mathjs';
function show(name, f, end, start, exact, options) {
  const { t, y } = solveODE((time, state) => [f(time, state[0])], [0, end], [start], options);
  console.log(`${name} to ${end}, ${JSON.stringify(options)}: ${y.at(-1)[0].toFixed(4)} `
    + `instead of ${exact.toFixed(4)}, ` + (t.length === 2 ? '1 step' : 'more steps'));
}
const decay = (t, y) => -y, daylight = (t) => Math.sin(Math.PI * t) ** 2;
for (const tol of [1e-3, 1e-6, 1e-9]) show('decay', decay, 1, 1, Math.exp(-1), { method: 'RK23', tol });
show('decay', decay, 0.9, 1, Math.exp(-0.9), { method: 'RK23', tol: 1e-6 });
for (const days of [5, 8]) show('daylight', daylight, days, 0, days / 2, { method: 'RK23', tol: 1e-4 });
for (const days of [45, 90]) show('daylight', daylight, days, 0, days / 2, { method: 'RK45', tol: 1e-4 });
show('decay', decay, 1, 1, Math.exp(-1), { method: 'RK23', tol: 1e-6, firstStep: 0.01 });
show('daylight', daylight, 8, 0, 4, { method: 'RK23', tol: 1e-4, firstStep: 0.01 });
show('daylight', daylight, 90, 0, 45, { method: 'RK45', tol: 1e-4, firstStep: 0.01 });
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
decay to 1, {"method":"RK23","tol":0.001}: 0.3333 instead of 0.3679, 1 step
decay to 1, {"method":"RK23","tol":0.000001}: 0.3333 instead of 0.3679, 1 step
decay to 1, {"method":"RK23","tol":1e-9}: 0.3333 instead of 0.3679, 1 step
decay to 0.9, {"method":"RK23","tol":0.000001}: 0.4066 instead of 0.4066, more steps
daylight to 5, {"method":"RK23","tol":0.0001}: 2.5000 instead of 2.5000, more steps
daylight to 8, {"method":"RK23","tol":0.0001}: 0.0000 instead of 4.0000, 1 step
daylight to 45, {"method":"RK45","tol":0.0001}: 22.5000 instead of 22.5000, more steps
daylight to 90, {"method":"RK45","tol":0.0001}: 0.0000 instead of 45.0000, 1 step
decay to 1, {"method":"RK23","tol":0.000001,"firstStep":0.01}: 0.3679 instead of 0.3679, more steps
daylight to 8, {"method":"RK23","tol":0.0001,"firstStep":0.01}: 4.0000 instead of 4.0000, more steps
daylight to 90, {"method":"RK45","tol":0.0001,"firstStep":0.01}: 45.0000 instead of 45.0000, more steps
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
