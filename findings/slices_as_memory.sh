#!/usr/bin/env bash
# OpenVDB for Python reads the memory of an array instead of the array.
#
# Expected. copyFromArray of pyopenvdb takes a numpy array and stores a[i, j, k] in voxel i, j, k. Transposed arrays,
# arrays in Fortran order (as from readers of NIfTI or MATLAB files), and slices such as a[::2, ::2, ::2] are arrays
# like others in numpy, which describes them by strides. A library that cannot read strides refuses such arrays, or
# copies them first.
#
# What happens. copyFromArray takes the numbers as they follow each other in memory. A transposed array is stored as
# the one before the transposition, and a slice with steps as the beginning of the whole array. copyToArray writes in
# the same way into an array in Fortran order. Shapes are right and nothing warns; for a symmetric field, such as a
# sphere, the result is even right.
#
# Workaround: numpy.ascontiguousarray(a) before each call.
#
# Seen with python3-openvdb 10.0.1 of Debian 12.
set -eu
for p in python3-openvdb=10.0.1; do
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
import pyopenvdb
def stored(array):
    grid = pyopenvdb.FloatGrid(-1)
    grid.copyFromArray(array)
    voxel = grid.getConstAccessor()
    return numpy.array([voxel.getValue(place) for place in numpy.ndindex(array.shape)]).reshape(array.shape)
def show(name, array):
    for way, a in ("as it is", array), ("made contiguous", numpy.ascontiguousarray(array)):
        seen = stored(a)
        print(f"{name}, {way}: {'right' if (seen == array).all() else 'wrong'},",
              f"the first line is {seen[0, 0].astype(int).tolist()}, should be {array[0, 0].astype(int).tolist()}")
cube = numpy.arange(64, dtype="f4").reshape(4, 4, 4)
show("C order", cube)
show("Fortran order", numpy.asfortranarray(cube))
show("transposed", cube.transpose(2, 1, 0))
show("every second", cube[::2, ::2, ::2])
show("a layer", cube[:, :, :1])
show("a block", cube[:2, :2, :2])
back = numpy.zeros((4, 4, 4), "f4", order="F")
grid = pyopenvdb.FloatGrid(-1)
grid.copyFromArray(cube)
grid.copyToArray(back)
print(f"copyToArray into Fortran order: {'right' if (back == cube).all() else 'wrong'},",
      f"the first line is {back[0, 0].astype(int).tolist()}, should be {cube[0, 0].astype(int).tolist()}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
C order, as it is: right, the first line is [0, 1, 2, 3], should be [0, 1, 2, 3]
C order, made contiguous: right, the first line is [0, 1, 2, 3], should be [0, 1, 2, 3]
Fortran order, as it is: wrong, the first line is [0, 16, 32, 48], should be [0, 1, 2, 3]
Fortran order, made contiguous: right, the first line is [0, 1, 2, 3], should be [0, 1, 2, 3]
transposed, as it is: wrong, the first line is [0, 1, 2, 3], should be [0, 16, 32, 48]
transposed, made contiguous: right, the first line is [0, 16, 32, 48], should be [0, 16, 32, 48]
every second, as it is: wrong, the first line is [0, 1], should be [0, 2]
every second, made contiguous: right, the first line is [0, 2], should be [0, 2]
a layer, as it is: wrong, the first line is [0], should be [0]
a layer, made contiguous: right, the first line is [0], should be [0]
a block, as it is: wrong, the first line is [0, 1], should be [0, 1]
a block, made contiguous: right, the first line is [0, 1], should be [0, 1]
copyToArray into Fortran order: wrong, the first line is [0, 16, 32, 48], should be [0, 1, 2, 3]
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
