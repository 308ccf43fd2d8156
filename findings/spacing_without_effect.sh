#!/usr/bin/env bash
# vtkImageEuclideanDistance ignores the spacing although it has a switch for it.
#
# Expected. The filter computes the Euclidean distance from each voxel to the nearest voxel with 0. It has a switch
# ConsiderAnisotropy, on by default, for images whose voxels are not cubes. With a spacing of 2 in x the neighbour in
# x is at 2, and the neighbour in y at 1.
#
# What happens. Both are at 1: the switch changes nothing, with either algorithm. In a stack of slices 5 units apart a
# distance across the slices is too small by a factor of 5, and the nearest voxel is often another one. The manual
# says that the result is the square of the distance, in contrast to the name; that is why the numbers below are 1 4 9
# 16. Nothing warns.
#
# Workaround: scipy.ndimage.distance_transform_edt with sampling=(dz, dy, dx), which takes the spacing into account.
#
# Seen with python3-vtk9 9.1.0 and python3-scipy 1.10.1 of Debian 12.
set -eu
for p in python3-vtk9=9.1.0 python3-scipy=1.10.1; do
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
from scipy import ndimage
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
mask = numpy.ones((9, 9, 9))
mask[4, 4, 4] = 0
image = vtk.vtkImageData()
image.SetDimensions(9, 9, 9)
image.SetSpacing(2, 1, 1)
image.GetPointData().SetScalars(numpy_to_vtk(mask.ravel()))
def text(a):
    return " ".join(f"{v:g}" for v in a)
for algorithm in "Saito", "SaitoCached":
    for anisotropy in 0, 1:
        transform = vtk.vtkImageEuclideanDistance()
        transform.SetInputData(image)
        transform.SetConsiderAnisotropy(anisotropy)
        getattr(transform, "SetAlgorithmTo" + algorithm)()
        transform.Update()
        u = vtk_to_numpy(transform.GetOutput().GetPointData().GetScalars()).reshape(9, 9, 9)
        print(f"{algorithm}, ConsiderAnisotropy {anisotropy}, squares: along x {text(u[4, 4, 4:])}, along y {text(u[4, 4:, 4])}")
print("on by default:", vtk.vtkImageEuclideanDistance().GetConsiderAnisotropy())
u = ndimage.distance_transform_edt(mask, sampling=(1, 1, 2))
print(f"SciPy: along x {text(u[4, 4, 4:])}, along y {text(u[4, 4:, 4])}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
Saito, ConsiderAnisotropy 0, squares: along x 0 1 4 9 16, along y 0 1 4 9 16
Saito, ConsiderAnisotropy 1, squares: along x 0 1 4 9 16, along y 0 1 4 9 16
SaitoCached, ConsiderAnisotropy 0, squares: along x 0 1 4 9 16, along y 0 1 4 9 16
SaitoCached, ConsiderAnisotropy 1, squares: along x 0 1 4 9 16, along y 0 1 4 9 16
on by default: 1
SciPy: along x 0 2 4 6 8, along y 0 1 2 3 4
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
