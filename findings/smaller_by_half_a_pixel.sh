#!/usr/bin/env bash
# vtkImageShrink3D moves an image by up to half of its new pixels.
#
# Expected. vtkImageShrink3D with Averaging, which is on by default, replaces blocks of f pixels by their mean. The
# mean of pixels 0 to 3 belongs in the middle, at 1.5. VTK images have an origin, so that the small image can lie
# exactly on the large one, and a field u = x should remain u = x.
#
# What happens. The origin stays that of the first pixel. With a factor of 4 the value 1.5 is at x = 0, and 5.5 at x =
# 4: everything has moved by 1.5 old pixels towards 0. Contours of both images are apart, and a pyramid of images
# drifts with each level. Factors of 2 shift by .5. Without averaging the first pixel of each block is taken, which is
# at the right place. Nothing warns.
#
# Workaround: move the origin by (f - 1) / 2 spacings; or AveragingOff after a smoothing filter.
#
# Seen with python3-vtk9 9.1.0 of Debian 12.
set -eu
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
cat > try.py <<'EOF_PY'
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
n = 16
image = vtk.vtkImageData()
image.SetDimensions(n, n, 1)
u = numpy.tile(numpy.arange(float(n)), n)
image.GetPointData().SetScalars(numpy_to_vtk(u, deep=1))
def contour(data):  # x of the line u = 6
    lines = vtk.vtkFlyingEdges2D()
    lines.SetInputData(data)
    lines.SetValue(0, 6)
    lines.Update()
    return lines.GetOutput().GetBounds()[0]
print(f"u = x: the line u = 6 is at x = {contour(image):g}")
for averaging in 1, 0:
    for f in 2, 4:
        shrink = vtk.vtkImageShrink3D()
        shrink.SetInputData(image)
        shrink.SetShrinkFactors(f, f, 1)
        if not averaging:
            shrink.AveragingOff()
        shrink.Update()
        small = shrink.GetOutput()
        row = vtk_to_numpy(small.GetPointData().GetScalars())[:3]
        places = [small.GetPoint(i)[0] for i in range(3)]
        print(f"factor {f}, averaging {averaging}: u {row} at x {places}, the line at x = {contour(small):g}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
u = x: the line u = 6 is at x = 6
factor 2, averaging 1: u [0.5 2.5 4.5] at x [0.0, 2.0, 4.0], the line at x = 5.5
factor 4, averaging 1: u [1.5 5.5 9.5] at x [0.0, 4.0, 8.0], the line at x = 4.5
factor 2, averaging 0: u [0. 2. 4.] at x [0.0, 2.0, 4.0], the line at x = 6
factor 4, averaging 0: u [0. 4. 8.] at x [0.0, 4.0, 8.0], the line at x = 6
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
