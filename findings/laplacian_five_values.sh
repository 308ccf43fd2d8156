#!/usr/bin/env bash
# The Laplacian of x^2 is 2, -2, 8, 128 or .5: functions of this name in SciPy, scikit-image, OpenCV and Octave
# differ.
#
# Expected. The Laplacian of x^2 is 2, and the five-point stencil on a grid with spacing 1 gives exactly this. A
# function for pictures called laplace or Laplacian should give 2, as it does in SciPy, so that u + D dt laplace(u) is
# diffusion.
#
# What happens. filters.laplace of scikit-image returns minus the Laplacian: its centre is +4. Diffusion with it runs
# backwards, and u explodes. Laplacian of OpenCV gives 2 with its default kernel, but 8 with ksize = 3, 128 with 5,
# and 2048 with 7: the larger kernels are scaled up for whole numbers. del2 of Octave divides by 2 N in N dimensions,
# so a row gives .5; its manual says so, for those who look. None of them warns, and as filters for edges all look
# alike.
#
# Workaround: scipy.ndimage.laplace, or apply the function to x^2 first and divide.
#
# Seen with the packages of Debian 12 whose versions are below.
set -eu
for p in python3-scipy=1.10.1 python3-skimage=0.19.3 python3-opencv=4.6.0 octave=7.3.0; do
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
import warnings
warnings.simplefilter("ignore")
import cv2
import numpy
from scipy import ndimage
from skimage import filters
u = numpy.tile(numpy.arange(16.0) ** 2, (16, 1))
print("SciPy:", ndimage.laplace(u)[8, 8])
print("scikit-image:", filters.laplace(u)[8, 8])
for size in 1, 3, 5, 7:
    print(f"OpenCV, ksize {size}:", cv2.Laplacian(u, cv2.CV_64F, ksize=size)[8, 8])
spot = numpy.zeros((9, 9))
spot[4, 4] = 1
for name, laplace in ("SciPy", ndimage.laplace), ("scikit-image", filters.laplace):
    v = spot
    for step in range(10):
        v = v + 0.1 * laplace(v)
    print(f"the top of a spot after 10 steps of diffusion by {name}: {v.max():.3f}")
EOF_PY
cat > try.m <<'EOF_M'
printf("Octave, del2 of a row: %g\n", del2((0:15) .^ 2)(8));
printf("Octave, del2 of a plane: %g\n", del2(repmat((0:15) .^ 2, 16, 1))(8, 8));
EOF_M
{ /usr/bin/python3 try.py; octave-cli --norc try.m 2> log; } | tee seen
cat > expected <<'EOF_TXT'
SciPy: 2.0
scikit-image: -2.0
OpenCV, ksize 1: 2.0
OpenCV, ksize 3: 8.0
OpenCV, ksize 5: 128.0
OpenCV, ksize 7: 2048.0
the top of a spot after 10 steps of diffusion by SciPy: 0.083
the top of a spot after 10 steps of diffusion by scikit-image: 61.509
Octave, del2 of a row: 0.5
Octave, del2 of a plane: 0.5
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
