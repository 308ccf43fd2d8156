#!/usr/bin/env bash
# The mode "wrap" of scipy.ndimage has two periods, one of them a pixel too short.
#
# Expected. mode="wrap" is for periodic fields: what leaves on the right comes in on the left, and n pixels have the
# period n. So shift(u, 1, mode="wrap") equals numpy.roll, as gaussian_filter, laplace and convolve with the same mode
# treat the field.
#
# What happens. Filters have the period n. Interpolation (shift, zoom, rotate, map_coordinates, affine_transform) has
# the period n - 1: the last pixel is taken for the first one. A wave that is moved to the right loses a pixel in each
# round, and at the border a copy of the neighbour is inserted. Position -1 of 0 1 2 3 4 5 6 7 is 6, and 7.5 is .5.
# The manual says so in one sentence, and the name is the same. Nothing warns.
#
# Workaround: mode="grid-wrap" for interpolation.
#
# Seen with python3-scipy 1.10.1 of Debian 12.
set -eu
for p in python3-scipy=1.10.1; do
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
from scipy import ndimage
row = numpy.arange(8.0)
def text(a):
    return " ".join(f"{v:.3g}" for v in a)
print("numpy.roll by 1:", text(numpy.roll(row, 1)))
for mode in "wrap", "grid-wrap":
    print(f"shift by 1, {mode}:", text(ndimage.shift(row, 1, order=1, mode=mode)))
    print(f"positions -1, 7, 7.5, 8, {mode}:", text(ndimage.map_coordinates(row, [[-1, 7, 7.5, 8]], order=1, mode=mode)))
ends = numpy.array([0.0, 0, 0, 0, 0, 0, 0, 3])
print("mean of three neighbours by uniform_filter, wrap:", text(ndimage.uniform_filter(ends, 3, mode="wrap")))
wave = numpy.sin(2 * numpy.pi * numpy.arange(16) / 16)
for mode in "wrap", "grid-wrap":
    u = wave
    for step in range(16):
        u = ndimage.shift(u, 1, order=1, mode=mode)
    print(f"error of a wave after one round, {mode}: {abs(u - wave).max():.2f}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
numpy.roll by 1: 7 0 1 2 3 4 5 6
shift by 1, wrap: 6 0 1 2 3 4 5 6
positions -1, 7, 7.5, 8, wrap: 6 7 0.5 1
shift by 1, grid-wrap: 7 0 1 2 3 4 5 6
positions -1, 7, 7.5, 8, grid-wrap: 7 7 3.5 0
mean of three neighbours by uniform_filter, wrap: 1 0 0 0 0 0 1 1
error of a wave after one round, wrap: 0.71
error of a wave after one round, grid-wrap: 0.00
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
