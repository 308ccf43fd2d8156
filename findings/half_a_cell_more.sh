#!/usr/bin/env bash
# In vtk.js an image is one cell larger than the same image in VTK.
#
# Expected. vtk.js follows VTK: an image of 5 x 4 x 3 points at origin 10 with spacing 2 begins at its first point,
# 10, and ends at its last one, 18. getBounds() of VTK says so, and grids, contours and probes of both libraries
# use these points.
#
# What happens. getBounds() of vtkImageData in vtk.js adds half a cell on each side: 9 to 19. The contours of vtk.js
# lie on the points as in VTK, so a box, a slider of a cutting plane or a ruler that is made from the bounds is too
# long by one cell, and a picture that is stretched over them is off by half a cell at its edges. A flat picture
# has a thickness of one cell instead of 0. On coarse grids the difference is large: 25 % here.
#
# Workaround: compute the bounds from getExtent() by indexToWorld().
#
# Seen with @kitware/vtk.js 37.4.3 (npm), Node.js 20, and python3-vtk9 9.1.0 of Debian 12.
set -eu
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "this script needs Node.js and npm"
  exit 2
fi
for p in python3-vtk9=9.1.0; do
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
npm install --silent --no-audit --no-fund --ignore-scripts @kitware/vtk.js@37.4.3 ||
  { echo "npm could not install the packages"; exit 2; }
cat > try.js <<'EOF_JS'
import vtkImageData from '@kitware/vtk.js/Common/DataModel/ImageData.js';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray.js';
import vtkImageMarchingCubes from '@kitware/vtk.js/Filters/General/ImageMarchingCubes.js';
console.time = console.timeEnd = () => {}; // the filter prints its times
const image = (...n) => vtkImageData.newInstance({ origin: [10, 0, 0], spacing: [2, 2, 2],
  extent: n.flatMap((m) => [0, m - 1]) });
const volume = image(5, 4, 3);
volume.getPointData().setScalars(vtkDataArray.newInstance({ name: 'u',
  values: Float32Array.from({ length: 60 }, (_, i) => Math.floor(i / 5) % 4) }));
const cubes = vtkImageMarchingCubes.newInstance({ contourValue: 1.5 });
cubes.setInputData(volume);
cubes.update();
console.log(`vtk.js, 5 x 4 x 3: ${volume.getBounds().join(' ')}`);
console.log(`vtk.js, contour u = 1.5 of it: ${cubes.getOutputData().getBounds().join(' ')}`);
console.log(`vtk.js, 5 x 4 x 1: ${image(5, 4, 1).getBounds().join(' ')}`);
EOF_JS
cat > try.py <<'EOF_PY'
import vtk
for n in (5, 4, 3), (5, 4, 1):
    image = vtk.vtkImageData()
    image.SetDimensions(*n)
    image.SetOrigin(10, 0, 0)
    image.SetSpacing(2, 2, 2)
    print(f"VTK, {n[0]} x {n[1]} x {n[2]}:", *(f"{b:g}" for b in image.GetBounds()))
EOF_PY
{ node try.js; python3 try.py; } | tee seen
cat > expected <<'EOF_TXT'
vtk.js, 5 x 4 x 3: 9 19 -1 7 -1 5
vtk.js, contour u = 1.5 of it: 10 18 3 3 0 4
vtk.js, 5 x 4 x 1: 9 19 -1 7 -1 1
VTK, 5 x 4 x 3: 10 18 0 6 0 4
VTK, 5 x 4 x 1: 10 18 0 6 0 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
