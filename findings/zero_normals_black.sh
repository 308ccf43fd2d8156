#!/usr/bin/env bash
# three.js and assimp leave STL parts without normals black.
#
# Expected. Each triangle of an STL file has a normal and three corners. The normal says nothing that the order of the
# corners does not say, so many writers put 0 0 0, and readers compute it.
#
# What happens. STLLoader of three.js copies 0 0 0 to all three corners, in ASCII and binary files. Light from any
# direction falls on such a triangle with the factor 0: the model is black with each material that is lit, and has the
# right outline. assimp does the same, and its options -gn and -gsn, which generate normals, change nothing, since
# they work only if there are none: an OBJ file that is made from the STL file is black in all programs. Nothing
# warns.
#
# Workaround: call computeVertexNormals() on each geometry that comes from STLLoader; its triangles share no corners,
# so the edges stay sharp. For assimp, write true normals into the file, or use a format without normals, such as OFF.
#
# Seen with three 0.187.0 (npm), Node.js 20, and assimp-utils 5.2.5 of Debian 12.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
for p in assimp-utils=5.2.5; do
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
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';
const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0];
const ascii = (normal) => `solid a\nfacet normal ${normal}\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n`
  + 'endloop\nendfacet\nendsolid a\n';
const binary = Buffer.alloc(134); // a header of 80 bytes, the count, a normal of zeros, the corners, two more bytes
binary.writeUInt32LE(1, 80);
corners.forEach((v, i) => binary.writeFloatLE(v, 96 + 4 * i));
const show = (name, data) => {
  const geometry = new STLLoader().parse(data);
  const normal = [...geometry.attributes.normal.array].slice(0, 3).join(' ');
  const light = Math.max(0, geometry.attributes.normal.getZ(0)); // from a lamp straight above
  geometry.computeVertexNormals();
  console.log(`${name}: normal ${normal}, light ${light}, `
    + `after computeVertexNormals ${[...geometry.attributes.normal.array].slice(0, 3).join(' ')}`);
};
show('ASCII, normal 0 0 1', ascii('0 0 1'));
show('ASCII, normal 0 0 0', ascii('0 0 0'));
show('binary, normal 0 0 0', new Uint8Array(binary).buffer);
writeFileSync('a.stl', ascii('0 0 0'));
const assimp = (from, to, ...options) => {
  execFileSync('assimp', ['export', from, to, ...options], { stdio: 'ignore' });
  return to;
};
const normals = (file) => readFileSync(file, 'utf8').match(/^vn .*$/gm);
for (const option of ['-gn', '-gsn']) {
  console.log(`assimp ${option}: ${normals(assimp('a.stl', 'a.obj', option))}`);
}
writeFileSync('b.off', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n');
console.log(`assimp, the same triangle in an OFF file: ${normals(assimp('b.off', 'b.obj', '-gn'))}`);
EOF_JS
node try.js | tee seen
cat > expected <<'EOF_TXT'
ASCII, normal 0 0 1: normal 0 0 1, light 1, after computeVertexNormals 0 0 1
ASCII, normal 0 0 0: normal 0 0 0, light 0, after computeVertexNormals 0 0 1
binary, normal 0 0 0: normal 0 0 0, light 0, after computeVertexNormals 0 0 1
assimp -gn: vn 0 0 0
assimp -gsn: vn 0 0 0
assimp, the same triangle in an OFF file: vn 0 0 1
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
