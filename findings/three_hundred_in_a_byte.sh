#!/usr/bin/env bash
# In h5py 300 becomes 255 or 44 as a byte, depending on how it is assigned.
#
# Expected. A data set of bytes takes numbers from 0 to 255. What happens to others is one rule for the library: they
# wrap, as in numpy, or they stop at the limit, as in HDF5.
#
# What happens. It is both. A numpy array that is assigned to a data set, or from which one is created with dtype, goes
# to HDF5 as it is, which stops at the limits: -5 becomes 0 and 300 becomes 255. A list or a single number is first
# made an array of bytes by numpy: -5 becomes 251 and 300 becomes 44. So u[0] = 300 and u[0:1] = numpy.array([300])
# store different numbers. In reading it is the brackets: u.astype("u1")[:] stops, and u[:].astype("u1") wraps. A count
# that is too large is white in one frame and dark in the next. Nothing warns.
#
# Workaround: numpy.clip before, whichever way is taken.
#
# Seen with python3-h5py 3.7.0 and python3-numpy 1.24.2 of Debian 12.
set -eu
for p in python3-h5py=3.7.0 python3-numpy=1.24.2; do
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
import h5py
import numpy
counts = numpy.array([-5, 0, 255, 300, 70000])
def row(numbers):
    return " ".join(str(v) for v in numbers)
with h5py.File("counts.h5", "w") as file:
    stored = file.create_dataset("bytes", (5,), "u1")
    stored[:] = counts
    print("array assigned:", row(stored[:]))
    print("created from an array:", row(file.create_dataset("from array", data=counts, dtype="u1")[:]))
    print("created from a list:", row(file.create_dataset("from list", data=counts.tolist(), dtype="u1")[:]))
    for i, count in enumerate(counts.tolist()):
        stored[i] = count
    print("assigned one by one:", row(stored[:]))
    stored[0:1] = numpy.array([300])
    print("an array of one number, 300:", stored[0])
    stored[0] = 300
    print("the number 300:", stored[0])
    whole = file.create_dataset("whole", data=counts)
    for kind in "u1", "i2":
        print(f"read as {kind} before the brackets:", row(whole.astype(kind)[:]))
        print(f"read as {kind} after the brackets:", row(whole[:].astype(kind)))
    into = numpy.zeros(5, "u1")
    whole.read_direct(into)
    print("read into an array of bytes:", row(into))
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
array assigned: 0 0 255 255 255
created from an array: 0 0 255 255 255
created from a list: 251 0 255 44 112
assigned one by one: 251 0 255 44 112
an array of one number, 300: 255
the number 300: 44
read as u1 before the brackets: 0 0 255 255 255
read as u1 after the brackets: 251 0 255 44 112
read as i2 before the brackets: -5 0 255 300 32767
read as i2 after the brackets: -5 0 255 300 4464
read into an array of bytes: 0 0 255 255 255
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
