#!/usr/bin/env bash
# The same convolution with a kernel of two lies one pixel apart in NumPy and in Octave, and within SciPy.
#
# Expected. A convolution of "the same" size takes the middle of the full result. A kernel with an odd number of
# entries has a middle; for an even one, such as the difference 1 -1 or the mean .5 .5, programs have to choose the
# left or the right entry of the middle pair, and all should follow MATLAB, from which they have the name "same".
#
# What happens. For a single 1 and the kernel 1 2, NumPy, scipy.signal and OpenCV's filter2D (with the kernel
# reversed, as it correlates) begin at the place of the 1. scipy.ndimage and conv and conv2 of Octave begin one pixel
# further left. So a difference is the slope half a pixel to the left of a pixel in one and half a pixel to the right
# in the other. Applied a hundred times, an average of neighbours moves a pattern by 50 pixels to the left or to the
# right. scipy.signal and scipy.ndimage are parts of one package. Nothing warns.
#
# Workaround: pad the kernel with a 0 to an odd number: 0 1 2 or 1 2 0.
#
# Seen with the packages of Debian 12 whose versions are below.
set -eu
for p in python3-scipy=1.10.1 python3-numpy=1.24.2 python3-opencv=4.6.0 octave=7.3.0; do
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
import cv2
import numpy
from scipy import ndimage, signal
row, kernel = numpy.array([0.0, 0, 0, 1, 0, 0, 0]), numpy.array([1.0, 2])
def show(name, values):
    print(f"{name}:", " ".join(f"{v:.0f}" for v in numpy.ravel(values)))
show("numpy.convolve", numpy.convolve(row, kernel, "same"))
show("scipy.signal.convolve", signal.convolve(row, kernel, "same"))
show("scipy.signal.convolve2d", signal.convolve2d([row], [kernel], "same"))
show("scipy.ndimage.convolve", ndimage.convolve(row, kernel))
show("OpenCV, filter2D, reversed", cv2.filter2D(numpy.float32([row]), -1, numpy.float32([kernel[::-1]])))
show("numpy, kernel 0 1 2", numpy.convolve(row, [0, 1, 2], "same"))
show("scipy.ndimage, kernel 0 1 2", ndimage.convolve(row, [0, 1, 2]))
x = numpy.arange(401)
bump = numpy.exp(-((x - 200) / 20) ** 2)
for name, mean in (("numpy", lambda u: numpy.convolve(u, [0.5, 0.5], "same")),
                   ("scipy.ndimage", lambda u: ndimage.convolve(u, [0.5, 0.5]))):
    u = bump
    for step in range(100):
        u = mean(u)
    print(f"a bump at 200 after 100 means of two by {name}: at {(u * x).sum() / u.sum():.0f}")
EOF_PY
cat > try.m <<'EOF_M'
row = [0 0 0 1 0 0 0];
printf ("Octave, conv: %s\n", num2str (conv (row, [1 2], "same")));
printf ("Octave, conv2: %s\n", num2str (conv2 (row, [1 2], "same")));
EOF_M
{ /usr/bin/python3 try.py; octave-cli --norc try.m 2> log; } | tee seen
cat > expected <<'EOF_TXT'
numpy.convolve: 0 0 0 1 2 0 0
scipy.signal.convolve: 0 0 0 1 2 0 0
scipy.signal.convolve2d: 0 0 0 1 2 0 0
scipy.ndimage.convolve: 0 0 1 2 0 0 0
OpenCV, filter2D, reversed: 0 0 0 1 2 0 0
numpy, kernel 0 1 2: 0 0 0 1 2 0 0
scipy.ndimage, kernel 0 1 2: 0 0 0 1 2 0 0
a bump at 200 after 100 means of two by numpy: at 250
a bump at 200 after 100 means of two by scipy.ndimage: at 150
Octave, conv: 0  0  1  2  0  0  0
Octave, conv2: 0  0  1  2  0  0  0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
