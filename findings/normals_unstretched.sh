#!/usr/bin/env bash
# Normals from marching_cubes of scikit-image ignore the spacing.
#
# Expected. marching_cubes(volume, level, spacing) returns vertices, faces, normals and values of a surface. With
# voxels of 4 x 1 x 1 the vertices are stretched by 4, and the normals should fit the stretched surface.
# gradient_direction says whether the inside is above the level ("descent") or below ("ascent"); faces and normals
# should then point outwards, the faces by the left-hand rule as documented. values is described as the maximum of the
# data close to a vertex.
#
# What happens. The normals stay those of the surface before stretching: for a ball that becomes an ellipsoid they are
# wrong by up to 40 degrees, so light falls on it as if it were a ball. "ascent" turns only the faces; the normals
# then point inwards, against the faces. values is 1.1 to 1.7 both for the level 3 and for the level 7, although the
# maximum close to a vertex cannot be below the level. Nothing warns.
#
# Workaround: compute the normals from the vertices and faces.
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
from skimage import measure
x = numpy.mgrid[:21, :21, :21] - 10.0
r = numpy.sqrt((x ** 2).sum(0))
def show(name, u, level, spacing, direction):
    v, f, normals, values = measure.marching_cubes(u, level, spacing=spacing, gradient_direction=direction)
    v = v - 10 * numpy.array(spacing)
    a, b, c = v[f[:, 0]], v[f[:, 1]], v[f[:, 2]]
    volume = numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6
    exact = v / numpy.array(spacing) ** 2  # the normal of an ellipsoid
    exact /= numpy.linalg.norm(exact, axis=1)[:, None]
    cosine = (normals * exact).sum(1)
    side = "outwards" if cosine.min() > 0 else "inwards"
    angle = numpy.degrees(numpy.arccos(abs(cosine).min()))
    faces = "outwards" if volume < 0 else "inwards"  # by the left-hand rule
    print(f"{name}: faces {faces}, normals {side}, wrong by up to {angle:.0f} degrees, "
          f"values {values.min():.1f} to {values.max():.1f}")
show("ball, 10 - r = 3, descent", 10 - r, 3, (1, 1, 1), "descent")
show("ball, r = 7, ascent", r, 7, (1, 1, 1), "ascent")
show("ball, 10 - r = 3, descent, spacing 2 1 1", 10 - r, 3, (2, 1, 1), "descent")
show("ball, 10 - r = 3, descent, spacing 4 1 1", 10 - r, 3, (4, 1, 1), "descent")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
ball, 10 - r = 3, descent: faces outwards, normals outwards, wrong by up to 4 degrees, values 1.1 to 1.7
ball, r = 7, ascent: faces outwards, normals inwards, wrong by up to 5 degrees, values 1.1 to 1.7
ball, 10 - r = 3, descent, spacing 2 1 1: faces outwards, normals outwards, wrong by up to 23 degrees, values 1.1 to 1.7
ball, 10 - r = 3, descent, spacing 4 1 1: faces outwards, normals outwards, wrong by up to 40 degrees, values 1.1 to 1.7
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
