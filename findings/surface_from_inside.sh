#!/usr/bin/env bash
# The surfaces that OpenVDB makes for Python run clockwise as seen from outside.
#
# Expected. Corners of a polygon run counter-clockwise as seen from outside: so in STL, OBJ, PLY and glTF files, in
# OpenGL and VTK. The volume of a closed surface, summed over the pyramids from its polygons to the origin, is then
# positive. convertToQuads of pyopenvdb should follow this.
#
# What happens. The volume of a sphere is negative, for level sets, which are negative inside, and for densities,
# which are large inside. A file written from these points and quads is inside out: dark, or invisible where back
# faces are not drawn. A grid with distances that were copied from an array has no class, so OpenVDB takes it for a
# density, and its surface is the right way round; setting gridClass turns it.
#
# Workaround: reverse each polygon, quads[:, ::-1], or check the sign of the volume.
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
def show(name, grid, level):
    points, quads = grid.convertToQuads(level)
    a, b, c, d = (points[quads[:, i]].astype(float) for i in range(4))
    volume = (numpy.cross(b, c) * a + numpy.cross(c, d) * a).sum() / 6
    print(f"{name}: {len(quads)} quads, volume {volume:.0f}, of a ball {4 / 3 * numpy.pi * 8**3:.0f}")
show("level set of createLevelSetSphere", pyopenvdb.createLevelSetSphere(radius=8), 0)
i, j, k = numpy.mgrid[-12:13, -12:13, -12:13]
distance = (numpy.sqrt(i**2 + j**2 + k**2) - 8).astype("f4")
density = numpy.clip(.5 - distance, 0, 1)
for name, field, background, level in ("distances", distance, 5, 0), ("densities", density, 0, .5):
    grid = pyopenvdb.FloatGrid(background)
    grid.copyFromArray(field, ijk=(-12, -12, -12))
    for kind in "unknown", "level set", "fog volume":
        grid.gridClass = kind
        show(f"{name} from an array, class {kind}", grid, level)
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
level set of createLevelSetSphere: 1158 quads, volume -2106, of a ball 2145
distances from an array, class unknown: 1158 quads, volume 2106, of a ball 2145
distances from an array, class level set: 1158 quads, volume -2106, of a ball 2145
distances from an array, class fog volume: 1158 quads, volume 2106, of a ball 2145
densities from an array, class unknown: 1182 quads, volume -2102, of a ball 2145
densities from an array, class level set: 1182 quads, volume 2102, of a ball 2145
densities from an array, class fog volume: 1182 quads, volume -2102, of a ball 2145
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
