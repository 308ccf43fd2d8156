#!/usr/bin/env bash
# phaseCorrelate of OpenCV finds a shift of half a pixel between equal pictures of odd size.
#
# Expected. phaseCorrelate returns the shift between two pictures, with fractions of a pixel. For equal pictures it is
# 0, and for a periodic pattern that was moved by 3 pixels it is 3.
#
# What happens. If width and height are odd numbers that the Fourier transform of OpenCV takes as they are (products
# of 3 and 5: 25, 27, 45, 75, 81, 125, 135, 225, 675), the result is half a pixel too large in both directions: .5, .5
# for a picture and itself. Even sizes are right. Other odd sizes are padded to a larger size; equal pictures give 0
# then, but a periodic pattern is no longer periodic, and 3 pixels become 5.3 or 2.1. The response, at most 1, is .8
# or more in all cases, which means certainty. A drift that is measured in a film with 225 pixels per row adds up half
# a pixel per frame. Nothing warns.
#
# Workaround: cut pictures to even sizes such as 64, 100, 480; or subtract phaseCorrelate(a, a).
#
# Seen with python3-opencv 4.6.0 and python3-scipy 1.10.1 of Debian 12.
set -eu
for p in python3-opencv=4.6.0 python3-scipy=1.10.1; do
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
from scipy import ndimage
random = numpy.random.default_rng(1)
for n in 64, 100, 480, 45, 75, 225, 675, 63, 101:
    pattern = ndimage.gaussian_filter(random.random((n, n)), 2, mode="wrap")
    (x, y), response = cv2.phaseCorrelate(pattern, pattern)
    moved, _ = cv2.phaseCorrelate(pattern, numpy.roll(pattern, 3, axis=1))
    print(f"{n} pixels, transform of {cv2.getOptimalDFTSize(n)}: not moved: {x:.1f} {y:.1f} "
          f"(response {response:.1f}); moved by 3 0: {moved[0]:.1f} {moved[1]:.1f}".replace("-0.0", "0.0"))
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
64 pixels, transform of 64: not moved: 0.0 0.0 (response 0.8); moved by 3 0: 3.0 0.0
100 pixels, transform of 100: not moved: 0.0 0.0 (response 0.8); moved by 3 0: 3.0 0.0
480 pixels, transform of 480: not moved: 0.0 0.0 (response 1.0); moved by 3 0: 3.0 0.0
45 pixels, transform of 45: not moved: 0.5 0.5 (response 0.8); moved by 3 0: 3.5 0.5
75 pixels, transform of 75: not moved: 0.5 0.5 (response 0.8); moved by 3 0: 3.5 0.5
225 pixels, transform of 225: not moved: 0.5 0.5 (response 0.9); moved by 3 0: 3.5 0.5
675 pixels, transform of 675: not moved: 0.5 0.5 (response 1.0); moved by 3 0: 3.5 0.5
63 pixels, transform of 64: not moved: 0.0 0.0 (response 1.0); moved by 3 0: 5.3 -0.2
101 pixels, transform of 108: not moved: 0.0 0.0 (response 1.0); moved by 3 0: 2.1 0.0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
