#!/usr/bin/env bash
# distance_transform_edt of SciPy measures the distance to a point outside if there is no background.
#
# Expected. The function gives each pixel that is not 0 its distance to the nearest 0. If a picture has no 0 at all
# there is no distance. The sisters in the same module say so: distance_transform_cdt gives -1, distance_transform_bf
# 1e154; OpenCV gives 8192 everywhere.
#
# What happens. The result looks like a distance: from the pixel above the first one, which is not in the picture. A
# row gives 1 2 3 4 5; a plane has lines of equal distance around its first corner. Indices are returned as well: -1
# and 0, the last pixel if used as an index. So in a film of a growing pattern the frame in which the last hole has
# closed has distances of a healthy size, and a mean width or a skeleton computed from them. Nothing warns.
#
# Workaround: test mask.all() first.
#
# Seen with python3-scipy 1.10.1 and python3-opencv 4.6.0 of Debian 12.
set -eu
for p in python3-scipy=1.10.1 python3-opencv=4.6.0; do
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
def rows(a):
    return " | ".join(" ".join(f"{v:.4g}" for v in row) for row in a)
full = numpy.ones((3, 5))
print("edt of a full picture:", rows(ndimage.distance_transform_edt(full)))
distance, index = ndimage.distance_transform_edt(full, return_indices=True)
print("its nearest 0 is at", index[:, 2, 2])
print("edt of a full row:", rows([ndimage.distance_transform_edt(numpy.ones(5))]))
print("edt of a row with a 0 at the end:", rows([ndimage.distance_transform_edt([1, 1, 1, 1, 0])]))
print("cdt:", rows(ndimage.distance_transform_cdt(full)))
print("bf:", rows(ndimage.distance_transform_bf(full)[:, :2]))
print("OpenCV:", rows(cv2.distanceTransform(full.astype(numpy.uint8), cv2.DIST_L2, 5)))
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
edt of a full picture: 1 1.414 2.236 3.162 4.123 | 2 2.236 2.828 3.606 4.472 | 3 3.162 3.606 4.243 5
its nearest 0 is at [-1  0]
edt of a full row: 1 2 3 4 5
edt of a row with a 0 at the end: 4 3 2 1 0
cdt: -1 -1 -1 -1 -1 | -1 -1 -1 -1 -1 | -1 -1 -1 -1 -1
bf: 1.341e+154 1.341e+154 | 1.341e+154 1.341e+154 | 1.341e+154 1.341e+154
OpenCV: 8192 8192 8192 8192 8192 | 8192 8192 8192 8192 8192 | 8192 8192 8192 8192 8192
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
