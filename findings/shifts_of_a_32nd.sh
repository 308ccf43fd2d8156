#!/usr/bin/env bash
# OpenCV moves pictures in steps of 1/32 pixel only.
#
# Expected. warpAffine, warpPerspective and remap move a picture by any distance, with floats for the map and the
# pixels. A straight ramp that is moved by s pixels with linear interpolation changes by exactly s.
#
# What happens. Positions are rounded to 1/32 pixel. A shift by .015 does nothing, one by .016 moves by .031. So a
# pattern that flows by .01 pixel per frame stands still for ever, and one that flows by .02 is half again too fast.
# It is the same with INTER_CUBIC and with doubles. INTER_CUBIC also bends straight ramps: .1 becomes .128, since its
# kernel has the parameter -.75, and only -.5 would keep them straight. getRectSubPix is exact. Nothing warns.
#
# Workaround: scipy.ndimage.map_coordinates; or move the original by the whole way for each frame, not the last frame.
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
ramp = numpy.tile(numpy.arange(32, dtype=numpy.float32), (8, 1))
y, x = numpy.mgrid[:8, :32].astype(numpy.float32)
def line(name, move):
    shifts = 0.01, 0.015, 0.016, 0.02, 0.1, 0.5
    print(f"{name}: " + ", ".join(f"{s}: {move(s)[4, 10] - 10:.4f}" for s in shifts))
def warp(image, s, flag=cv2.INTER_LINEAR):
    return cv2.warpAffine(image, numpy.float64([[1, 0, -s], [0, 1, 0]]), (32, 8), flags=flag)
line("warpAffine", lambda s: warp(ramp, s))
line("the same, doubles", lambda s: warp(ramp.astype(float), s))
line("the same, cubic", lambda s: warp(ramp, s, cv2.INTER_CUBIC))
line("remap", lambda s: cv2.remap(ramp, x + numpy.float32(s), y, cv2.INTER_LINEAR))
line("SciPy", lambda s: ndimage.map_coordinates(ramp, [y, x + s], order=1))
for s in 0.01, 0.02:
    film = ramp
    for frame in range(100):
        film = warp(film, s)
    print(f"100 frames with {s} each: moved by {film[4, 10] - 10:.3f}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
warpAffine: 0.01: 0.0000, 0.015: 0.0000, 0.016: 0.0312, 0.02: 0.0312, 0.1: 0.0938, 0.5: 0.5000
the same, doubles: 0.01: 0.0000, 0.015: 0.0000, 0.016: 0.0312, 0.02: 0.0312, 0.1: 0.0938, 0.5: 0.5000
the same, cubic: 0.01: 0.0000, 0.015: 0.0000, 0.016: 0.0454, 0.02: 0.0454, 0.1: 0.1283, 0.5: 0.5000
remap: 0.01: 0.0000, 0.015: 0.0000, 0.016: 0.0312, 0.02: 0.0312, 0.1: 0.0938, 0.5: 0.5000
SciPy: 0.01: 0.0100, 0.015: 0.0150, 0.016: 0.0160, 0.02: 0.0200, 0.1: 0.1000, 0.5: 0.5000
100 frames with 0.01 each: moved by 0.000
100 frames with 0.02 each: moved by 3.125
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
