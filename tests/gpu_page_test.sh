#!/usr/bin/env bash
# Exported pages compute by WebGPU: in headless Chromium, on a driver that computes on the processor (SwiftShader), the
# page has the pixels of `cascade run` and the bits of WebAssembly. Where the GPU cannot be used, the page says why.
set -u

fail() { echo "gpu_page: $*"; exit 1; }

[ -z "${SANITIZE:-}" ] || { echo "gpu_page: builds with sanitizers have no engine"; exit 77; }
browser=$(command -v chromium-headless-shell || command -v chromium) || fail "chromium is missing; cmake/packages.txt names its package"
command -v node >/dev/null || fail "node is missing; cmake/packages.txt names its package"

cat >spots.cascade <<'SCRIPT'
domain { grid: 260, 256 }
system spots {
  feed: 0.037 in 0.01 .. 0.08 step 0.001
  u: 1 - 0.5 * disc(0.5, 0.5, 0.2)
  v: 0.25 * disc(0.5, 0.5, 0.2) + random(0.01, 0.01)
  u' = 0.16 * lap(u) - u * v^2 + feed * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - 0.097 * v
}
stage grow: spots { iterations: 40 }
stage more: spots { u: u; v: v; frozen: u < 0.6; feed: 0.05; iterations: 20; solver: rk4 }
SCRIPT
cat >dot.cascade <<'SCRIPT'
domain { grid: 32, 32 }
system dot { u: disc(0.3, 0.3, 0.1); u' = 0 }
stage only: dot { iterations: 1 }
SCRIPT
"$CASCADE" run spots.cascade --palette leopard -o spots.png --quiet || fail "the picture was not drawn"
for script in spots dot; do "$CASCADE" export $script.cascade >/dev/null || fail "the page of $script was not written"; done
rm -rf profile_with_gpu profile_without_gpu
node "$SOURCE/tests/page/gpu.mjs" "$browser" || fail "see above"
