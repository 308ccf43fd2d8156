#!/usr/bin/env bash
# hessian_matrix of scikit-image returns rows and columns swapped.
#
# Expected. hessian_matrix(u, order="rc") returns the second derivatives Hrr, Hrc, Hcc, where r is along the first
# axis and c along the second one; order="xy" returns Hxx, Hxy, Hyy. A field that changes along the rows of the array
# only, u = r^2, has Hrr = 2 and Hcc = 0.
#
# What happens. The order is turned round in both cases: for u = r^2 the first result is 0 and the last one is 2.
# Traces, determinants and eigenvalues do not change, so filters for ridges and blobs are right. But the direction in
# which stripes run is wrong by a mirror at the diagonal: stripes along x seem to run along y. In three dimensions the
# six results come in the reverse order too. structure_tensor of the same module has the right order. Nothing warns.
#
# Workaround: in two dimensions, ask for the other order.
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
from skimage import feature
def middle(results):
    return " ".join(f"{h[tuple(n // 2 for n in h.shape)] + 0.0:.1f}" for h in results)
r, c = numpy.mgrid[-40:41, -40:41].astype(float)
for name, u in ("r^2 / 2", r ** 2 / 2), ("3 c^2 / 2", 3 * c ** 2 / 2), ("r c", r * c):
    for order in "rc", "xy":
        print(f"u = {name}, order {order}: {middle(feature.hessian_matrix(u, sigma=1, order=order))}")
p, r, c = numpy.mgrid[-20:21, -20:21, -20:21].astype(float)
u = p ** 2 / 2 + 2 * r ** 2 / 2 + 3 * c ** 2 / 2
print("u = (p^2 + 2 r^2 + 3 c^2) / 2, order rc:", middle(feature.hessian_matrix(u, sigma=1, order="rc")))
for name, u in ("r", r), ("c", c):
    a = feature.structure_tensor(u[0], sigma=1, order="rc")
    print(f"structure_tensor of u = {name}, order rc: {middle(a)}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
u = r^2 / 2, order rc: 0.0 0.0 1.0
u = r^2 / 2, order xy: 1.0 0.0 0.0
u = 3 c^2 / 2, order rc: 3.0 0.0 0.0
u = 3 c^2 / 2, order xy: 0.0 0.0 3.0
u = r c, order rc: 0.0 1.0 0.0
u = r c, order xy: 0.0 1.0 0.0
u = (p^2 + 2 r^2 + 3 c^2) / 2, order rc: 3.0 0.0 0.0 2.0 0.0 1.0
structure_tensor of u = r, order rc: 64.0 0.0 0.0
structure_tensor of u = c, order rc: 0.0 0.0 64.0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
