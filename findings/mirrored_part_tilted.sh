#!/usr/bin/env bash
# Slic3r tilts the mirrored parts of a 3MF file.
#
# Expected. Each item of a 3MF file has a matrix that places an object in the print. The format permits every matrix
# that can be inverted, and programs use a mirrored one for the other half of a symmetric model. Slic3r applies scales
# and rotations about any axis, so it should either mirror the object or refuse the file.
#
# What happens. Slic3r splits the matrix into scales and three angles, which cannot describe mirror images and shears.
# It makes a rotation of the rest: a box of 10 x 20 x 30 mm that is mirrored in x stands tilted on the print bed, and
# the G-code prints a slanted box. There is no warning. With shear, the size is wrong as well.
#
# Workaround: apply such a matrix to the vertices, and turn the triangles around, before the file is written.
#
# Seen with slic3r 1.3.0 of Debian 12.
set -eu
for p in slic3r=1.3.0; do
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
import re
import subprocess
import zipfile
corners = [(10 * x, 20 * y, 30 * z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
triangles = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
             (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in corners)
faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles)
site = "http://schemas.openxmlformats.org/package/2006/"
def box(matrix):
    with zipfile.ZipFile("box.3mf", "w") as z:
        z.writestr("[Content_Types].xml", f'<Types xmlns="{site}content-types"><Default Extension="rels" ContentType='
                   '"application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" '
                   'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        z.writestr("_rels/.rels", f'<Relationships xmlns="{site}relationships"><Relationship Id="r" Target='
                   '"/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
                   '</Relationships>')
        z.writestr("3D/3dmodel.model", '<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" xmlns='
                   '"http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type='
                   f'"model"><mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh></object>'
                   f'</resources><build><item objectid="1" transform="{matrix}"/></build></model>')
def printed():  # the size of what the G-code prints
    subprocess.run("slic3r --skirts 0 --output box.gcode box.3mf".split(), check=True, capture_output=True)
    text = open("box.gcode").read()
    moves = re.findall(r"^G1 X(\S+) Y(\S+) E", text, re.M)
    x, y = ([float(m[i]) for m in moves] for i in (0, 1))
    z = max(map(float, re.findall(r"^G1 Z(\S+)", text, re.M)))
    return f"{max(x) - min(x):.0f} x {max(y) - min(y):.0f} x {z:.0f} mm"
for name, size, matrix in (("as it is", "10 x 20 x 30", "1 0 0 0 1 0 0 0 1 0 0 0"),
                           ("twice as large", "20 x 40 x 60", "2 0 0 0 2 0 0 0 2 0 0 0"),
                           ("lying on its side", "30 x 20 x 10", "0 0 -1 0 1 0 1 0 0 0 0 0"),
                           ("mirrored in x", "10 x 20 x 30", "-1 0 0 0 1 0 0 0 1 0 0 0"),
                           ("mirrored in z", "10 x 20 x 30", "1 0 0 0 1 0 0 0 -1 0 0 0"),
                           ("sheared", "30 x 20 x 30", "1 0 0 1 1 0 0 0 1 0 0 0")):
    box(matrix)
    print(f"{name}, so {size}, less the width of a thread: Slic3r prints {printed()}")
EOF_PY
python3 try.py | tee seen
cat > expected <<'EOF_TXT'
as it is, so 10 x 20 x 30, less the width of a thread: Slic3r prints 9 x 19 x 30 mm
twice as large, so 20 x 40 x 60, less the width of a thread: Slic3r prints 19 x 39 x 60 mm
lying on its side, so 30 x 20 x 10, less the width of a thread: Slic3r prints 29 x 19 x 10 mm
mirrored in x, so 10 x 20 x 30, less the width of a thread: Slic3r prints 29 x 34 x 17 mm
mirrored in z, so 10 x 20 x 30, less the width of a thread: Slic3r prints 35 x 31 x 23 mm
sheared, so 30 x 20 x 30, less the width of a thread: Slic3r prints 22 x 48 x 37 mm
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
