#!/usr/bin/env bash
# Readers of PLY files cut polygons to one triangle or leave them out, without a word.
#
# Expected. The faces of a PLY file are lists of any length. A reader that needs triangles should divide a polygon
# into triangles, or say that it cannot.
#
# What happens. ctmconv of OpenCTM keeps the first three corners of each face: half of each quad and more than half
# of each pentagon or hexagon is gone, and a model of quads looks as if it were perforated. PLYLoader of three.js,
# and the loader of loaders.gl, divide quads, but leave out faces with five or more corners, so the caps of prisms
# and honeycombs are missing. assimp divides all of them.
#
# Workaround: write triangles, or send the file through assimp first.
#
# Seen with openctm-tools 1.0.3 and assimp-utils 5.2.5 of Debian 12, three 0.187.0, @loaders.gl/core and ply 4.4.5
# (npm), Node.js 20.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
for p in openctm-tools=1.0.3 assimp-utils=5.2.5; do
  name=${p%%=*}
  if ! dpkg-query -W -f '${Version}' "$name" 2>/dev/null | grep -q .; then
    apt-get update -qq >/dev/null 2>&1 || true
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$name" >/dev/null 2>&1 ||
      { echo "could not install $name (Debian 12, as root)"; exit 2; }
  fi
  version=$(dpkg-query -W -f '${Version}' "$name" 2>/dev/null || true)
  case "${version#*:}" in
    "${p#*=}"[-+~]*) echo "$name $version" ;;
    *) echo "this was seen with $name ${p#*=}; here it is '${version:-not the one of Debian}'"; exit 2 ;;
  esac
done
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
echo '{"private":true,"type":"module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 @loaders.gl/core@4.4.5 @loaders.gl/ply@4.4.5 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import fs from 'node:fs';
import { execFileSync } from 'node:child_process';
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';
import { parse } from '@loaders.gl/core';
import { PLYLoader as PLYOfLoaders } from '@loaders.gl/ply';
// A regular polygon of area 1 as one face.
function polygon(n) {
  const r = Math.sqrt(2 / (n * Math.sin(2 * Math.PI / n)));
  const corners = Array.from({ length: n }, (_, i) => `${r * Math.cos(2 * Math.PI * i / n)} `
    + `${r * Math.sin(2 * Math.PI * i / n)} 0\n`);
  return `ply\nformat ascii 1.0\nelement vertex ${n}\nproperty float x\nproperty float y\nproperty float z\n`
    + 'element face 1\nproperty list uchar int vertex_indices\nend_header\n' + corners.join('')
    + `${n} ${[...corners.keys()].join(' ')}\n`;
}
function area(p, index) {
  let sum = 0;
  for (let i = 0; i + 2 < (index?.length ?? 0); i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [p[3 * index[i + k]], p[3 * index[i + k] + 1]]);
    sum += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  return sum.toFixed(2);
}
function obj(tool, args) { // the area of an OBJ file that a tool writes
  execFileSync(tool, args, { stdio: 'ignore' });
  const lines = fs.readFileSync('out.obj', 'utf8').split('\n').map((l) => l.trim().split(/\s+/));
  const faces = lines.filter((l) => l[0] === 'f').map((l) => l.slice(1).map((s) => parseInt(s) - 1));
  return area(lines.filter((l) => l[0] === 'v').flatMap((l) => l.slice(1, 4).map(Number)),
    faces.flatMap((f) => f.slice(2).flatMap((c, i) => [f[0], f[i + 1], c])));
}
for (const n of [3, 4, 5, 6]) {
  fs.writeFileSync('in.ply', polygon(n));
  const g = new PLYLoader().parse(polygon(n));
  const m = await parse(polygon(n), PLYOfLoaders);
  console.log(`area 1 with ${n} corners: ctmconv ${obj('ctmconv', ['in.ply', 'out.obj'])}, `
    + `three ${area(g.attributes.position.array, g.index?.array)}, `
    + `loaders.gl ${area(m.attributes.POSITION.value, m.indices?.value)}, `
    + `assimp ${obj('assimp', ['export', 'in.ply', 'out.obj', '-tri'])}`);
}
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
area 1 with 3 corners: ctmconv 1.00, three 1.00, loaders.gl 1.00, assimp 1.00
area 1 with 4 corners: ctmconv 0.50, three 1.00, loaders.gl 1.00, assimp 1.00
area 1 with 5 corners: ctmconv 0.28, three 0.00, loaders.gl 0.00, assimp 1.00
area 1 with 6 corners: ctmconv 0.17, three 0.00, loaders.gl 0.00, assimp 1.00
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
