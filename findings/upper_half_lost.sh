#!/usr/bin/env bash
# Portable MPI files keep only half of each MPI_LONG.
#
# Expected. MPI_File_set_view with "external32" writes big-endian numbers of fixed sizes, which each machine can read.
# mpi4py sends numpy arrays of int64, the usual whole numbers, as MPI_LONG. A file with them should have 8 bytes per
# number, as memory has, and come back as it was; numbers that do not fit should be an error.
#
# What happens. In external32 an MPI_LONG has 4 bytes. Small numbers are right; of large ones Open MPI keeps the lower
# 32 bits without an error: 2^32 + 5 becomes 5, and seeds, hashes, counts of cells and offsets are other numbers. A
# reader that expects 8 bytes per number takes two numbers for one. MPI_Pack_external does the same in a place of 8
# bytes: 1 becomes 00000001 00000000. MPI_INT64_T and MPI_LONG_LONG have 8 bytes and are right, although they are the
# same type in C on this machine.
#
# Workaround: name the type, [array, MPI.INT64_T], for view and data.
#
# Seen with openmpi-bin 4.1.4 and python3-mpi4py 3.1.4 of Debian 12.
set -eu
for p in openmpi-bin=4.1.4 python3-mpi4py=3.1.4; do
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
from mpi4py import MPI
numbers = numpy.array([1, -2, 2 ** 32 + 5, 2 ** 40])
print("numpy:", numbers.dtype, *numbers)
file = MPI.File.Open(MPI.COMM_SELF, "a.bin", MPI.MODE_CREATE | MPI.MODE_RDWR)
for name, kind in ("MPI_LONG", MPI.LONG), ("MPI_LONG_LONG", MPI.LONG_LONG), ("MPI_INT64_T", MPI.INT64_T):
    for view in "native", "external32":
        file.Set_size(0)
        file.Set_view(0, kind, kind, view)
        file.Write_at(0, [numbers, len(numbers), kind])
        again = numpy.zeros(4, int)
        file.Read_at(0, [again, 4, kind])
        print(f"{name}, {view}: {file.Get_size()} bytes, read back:", *again)
file.Set_size(0)
file.Set_view(0, MPI.INT64_T, MPI.INT64_T, "external32")
file.Write_at(0, numbers)
again[:] = 0
file.Read_at(0, again)
print(f"numpy array without a type, view of MPI_INT64_T: {file.Get_size()} bytes, read back:", *again)
file.Close()
for name, kind in ("MPI_LONG", MPI.LONG), ("MPI_INT64_T", MPI.INT64_T):
    place = bytearray(kind.Pack_external_size("external32", 1))
    kind.Pack_external("external32", numbers[:1], place, 0)
    print(f"{name} 1 packed:", place.hex())
EOF_PY
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
/usr/bin/python3 try.py 2>log | tee seen
cat > expected <<'EOF_TXT'
numpy: int64 1 -2 4294967301 1099511627776
MPI_LONG, native: 32 bytes, read back: 1 -2 4294967301 1099511627776
MPI_LONG, external32: 16 bytes, read back: 1 -2 5 0
MPI_LONG_LONG, native: 32 bytes, read back: 1 -2 4294967301 1099511627776
MPI_LONG_LONG, external32: 32 bytes, read back: 1 -2 4294967301 1099511627776
MPI_INT64_T, native: 32 bytes, read back: 1 -2 4294967301 1099511627776
MPI_INT64_T, external32: 32 bytes, read back: 1 -2 4294967301 1099511627776
numpy array without a type, view of MPI_INT64_T: 16 bytes, read back: 1 -2 5 0
MPI_LONG 1 packed: 0000000100000000
MPI_INT64_T 1 packed: 0000000000000001
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
