#!/usr/bin/env bash
# h5diff says that files are equal if it could not compare them.
#
# Expected. h5diff compares HDF5 files as diff compares texts. Its help says that the status is 0 if no differences were
# found, and 1 if some were. A field that has three numbers in one file and four in the other is different, and so is
# one of whole numbers that are not those of the floats in the other file.
#
# What happens. If the shapes differ, or whole numbers stand against floats, h5diff prints that some objects are not
# comparable, and returns 0, even if no number is the same. With -q only this status is left. So a test that a run has
# written the same fields passes if the run ended early and the series is shorter, or if the grid has another shape.
# Only a missing field and another number give 1. With -p, a relative limit, the order matters too: each number is
# within 10 % of an infinite one if that stands in the first file.
#
# Workaround: let the test fail as well if h5diff -c prints "not comparable" (last line).
#
# Seen with hdf5-tools 1.10.8 and python3-h5py 3.7.0 of Debian 12.
set -eu
for p in hdf5-tools=1.10.8 python3-h5py=3.7.0; do
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
/usr/bin/python3 - <<'EOF_PY'
import h5py
import numpy
inf = float("inf")
for name, u in {"reference": [0.0, 1, 2, 3], "another_number": [0.0, 1, 2, 9], "shorter": [7.0, 8, 9],
                "other_shape": [[7.0, 8], [9, 10]], "whole_numbers": numpy.array([7, 8, 9, 10]),
                "infinite": [0, 1, 2, inf]}.items():
    with h5py.File(f"{name}.h5", "w") as file:
        file["u"] = u
with h5py.File("missing.h5", "w") as file:
    file["v"] = [0.0, 1, 2, 3]
EOF_PY
status() {
  local status=0
  "$@" > /dev/null 2>&1 || status=$?
  echo "$status"
}
{
  for name in reference another_number missing shorter other_shape whole_numbers; do
    echo "reference and $name: status $(status h5diff reference.h5 $name.h5)," \
      "-q $(status h5diff -q reference.h5 $name.h5)"
  done
  echo "-p .1 reference and infinite: status $(status h5diff -p .1 reference.h5 infinite.h5)"
  echo "-p .1 infinite and reference: status $(status h5diff -p .1 infinite.h5 reference.h5)"
  told=$(h5diff -c reference.h5 shorter.h5 | grep -ic 'not comparable')
  echo "-c reference and shorter: $told lines with 'not comparable'"
} | tee seen
cat > expected <<'EOF_TXT'
reference and reference: status 0, -q 0
reference and another_number: status 1, -q 1
reference and missing: status 1, -q 1
reference and shorter: status 0, -q 0
reference and other_shape: status 0, -q 0
reference and whole_numbers: status 0, -q 0
-p .1 reference and infinite: status 1
-p .1 infinite and reference: status 0
-c reference and shorter: 1 lines with 'not comparable'
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
