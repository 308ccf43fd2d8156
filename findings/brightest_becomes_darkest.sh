#!/usr/bin/env bash
# rescale_intensity of scikit-image makes the largest count the most negative.
#
# Expected. rescale_intensity(image) stretches an image to the whole range of its type: 0 5 10 become 0 127 255 as
# bytes and 0 2147483647 4294967295 as uint32. Arrays of whole numbers in numpy are int64 unless one says otherwise,
# so counts and labels are usually of this type, and the largest should become 9223372036854775807.
#
# What happens. It becomes -9223372036854775808, and with uint64 it becomes 0: the range is computed in doubles, which
# round the limit up by one, and the number turns over when it is cast. Only the maximum is hit, and the other numbers
# are right: a picture of counts gets black specks on its brightest places, and a picture of two levels is inverted.
# If such an image is shown, all the rest is bright. There is at most a warning of numpy about a cast, depending on
# its version.
#
# Workaround: out_range=(0, 255), or image.astype(float) before.
#
# Seen with python3-skimage 0.19.3 of Debian 12.
set -eu
for p in python3-skimage=0.19.3; do
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
import numpy
from skimage import exposure
print("type of numpy.array([0, 5, 10]):", numpy.array([0, 5, 10]).dtype)
for kind in "uint8", "int16", "uint32", "int32", "int64", "uint64", "float64":
    print(f"{kind}:", *exposure.rescale_intensity(numpy.array([0, 5, 10], kind)))
print("int64, out_range=(0, 255):", *exposure.rescale_intensity(numpy.array([0, 5, 10]), out_range=(0, 255)))
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
type of numpy.array([0, 5, 10]): int64
uint8: 0 127 255
int16: 0 16383 32767
uint32: 0 2147483647 4294967295
int32: 0 1073741823 2147483647
int64: 0 4611686018427387904 -9223372036854775808
uint64: 0 9223372036854775808 0
float64: 0.0 0.5 1.0
int64, out_range=(0, 255): 0.0 127.5 255.0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
