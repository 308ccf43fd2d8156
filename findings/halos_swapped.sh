#!/usr/bin/env bash
# The nonblocking halo exchange of Open MPI swaps left and right on one or two processes.
#
# Expected. MPI_Ineighbor_alltoall on a Cartesian communicator does what MPI_Neighbor_alltoall does, without waiting:
# the block sent to the left arrives in the block "from the right" of the receiver. MPI 4.0 (8.6) says that this is
# also so if a periodic direction has only one or two processes, where both neighbours are the same process.
#
# What happens. With three or more processes in a periodic direction, all blocks arrive where they should. With one or
# two, each block arrives on the wrong side: a border that was sent to the left arrives as if from the left. The blocking
# calls are right, so a program changes its result when it uses their nonblocking form. A symmetric start hides the
# fault, and a travelling wave meets a mirror at the edge of each subdomain. On a grid of n x 2 processes only one
# direction is wrong.
#
# Workaround: MPI_Isend and MPI_Irecv with a tag for each direction, or the blocking call.
#
# Seen with openmpi-bin 4.1.4 and python3-mpi4py 3.1.4 of Debian 12.
set -eu
for p in openmpi-bin=4.1.4 python3-mpi4py=3.1.4 python3-numpy=1.24.2; do
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
world = MPI.COMM_WORLD
ring = world.Create_cart([world.size], periods=[True])
me, n = ring.rank, ring.size
borders = numpy.array([10 * me + 1, 10 * me + 2])  # my left border goes to the left, my right border to the right
wanted = [10 * ((me - 1) % n) + 2, 10 * ((me + 1) % n) + 1]  # the right border of the left one, and so on
for name in "Neighbor_alltoall", "Ineighbor_alltoall", "Ineighbor_alltoallv":
    halo = numpy.zeros(2, int)
    request = getattr(ring, name)(borders, halo)
    if request is not None:
        request.Wait()
    seen = world.gather((list(halo), wanted))
    if me == 0:
        print(f"{n} processes, {name}:", "; ".join(
            f"rank {r} has {h[0]:02} and {h[1]:02}" + ("" if h == w else f", WRONG, should be {w[0]:02} and {w[1]:02}")
            for r, (h, w) in enumerate(seen)), flush=True)
EOF_PY
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
for n in 1 2 3; do mpirun --oversubscribe -n $n /usr/bin/python3 try.py; done | tee seen
cat > expected <<'EOF_TXT'
1 processes, Neighbor_alltoall: rank 0 has 02 and 01
1 processes, Ineighbor_alltoall: rank 0 has 01 and 02, WRONG, should be 02 and 01
1 processes, Ineighbor_alltoallv: rank 0 has 01 and 02, WRONG, should be 02 and 01
2 processes, Neighbor_alltoall: rank 0 has 12 and 11; rank 1 has 02 and 01
2 processes, Ineighbor_alltoall: rank 0 has 11 and 12, WRONG, should be 12 and 11; rank 1 has 01 and 02, WRONG, should be 02 and 01
2 processes, Ineighbor_alltoallv: rank 0 has 11 and 12, WRONG, should be 12 and 11; rank 1 has 01 and 02, WRONG, should be 02 and 01
3 processes, Neighbor_alltoall: rank 0 has 22 and 11; rank 1 has 02 and 21; rank 2 has 12 and 01
3 processes, Ineighbor_alltoall: rank 0 has 22 and 11; rank 1 has 02 and 21; rank 2 has 12 and 01
3 processes, Ineighbor_alltoallv: rank 0 has 22 and 11; rank 1 has 02 and 21; rank 2 has 12 and 01
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
