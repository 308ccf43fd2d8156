#!/usr/bin/env bash
# Slic3r, OpenSCAD and assimp read inches in 3MF and AMF files as millimetres.
#
# Expected. STL has no unit; AMF and 3MF were made to have one, as an attribute of the first element: millimeter, inch,
# meter, and more. A cube of 1 inch should be printed with 25.4 mm, as AMFLoader of three.js reads it.
#
# What happens. The three programs read the numbers and no unit. Slic3r prints a cube of 10 inches with 10 mm.
# OpenSCAD and assimp convert it to an STL file with the same numbers, which other programs take for millimetres.
# Nothing is said about the unit.
#
# Workaround: write such files in millimetres only.
#
# Seen with slic3r 1.3.0, openscad 2021.01 and assimp-utils 5.2.5 of Debian 12.
set -eu
for p in slic3r=1.3.0 openscad=2021.01 assimp-utils=5.2.5; do
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
corners = [(x, y, z) for z in (0, 10) for y in (0, 10) for x in (0, 10)]
triangles = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
             (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
def amf(unit):
    vertices = "".join(f"<vertex><coordinates><x>{x}</x><y>{y}</y><z>{z}</z></coordinates></vertex>"
                       for x, y, z in corners)
    faces = "".join(f"<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>" for a, b, c in triangles)
    open("cube.amf", "w").write(f'<?xml version="1.0" encoding="UTF-8"?>\n<amf unit="{unit}"><object id="1"><mesh>'
                                f"<vertices>{vertices}</vertices><volume>{faces}</volume></mesh></object></amf>\n")
def tmf(unit):
    vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in corners)
    faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles)
    site = "http://schemas.openxmlformats.org/package/2006/"
    with zipfile.ZipFile("cube.3mf", "w") as z:
        z.writestr("[Content_Types].xml", f'<Types xmlns="{site}content-types"><Default Extension="rels" ContentType='
                   '"application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" '
                   'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        z.writestr("_rels/.rels", f'<Relationships xmlns="{site}relationships"><Relationship Id="r" Target='
                   '"/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
                   '</Relationships>')
        z.writestr("3D/3dmodel.model", f'<?xml version="1.0" encoding="UTF-8"?><model unit="{unit}" xmlns='
                   '"http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type='
                   f'"model"><mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh></object>'
                   '</resources><build><item objectid="1"/></build></model>')
def run(command):
    subprocess.run(command.split(), check=True, capture_output=True)
def height(command):  # of an STL file, where it is taken for millimetres
    run(command)
    return max(float(z) for z in re.findall(r"vertex \S+ \S+ (\S+)", open("out.stl").read()))
for name, write in (("3mf", tmf), ("amf", amf)):
    for unit in "millimeter", "inch":
        write(unit)
        run(f"slic3r --output cube.gcode cube.{name}")
        printed = max(map(float, re.findall(r"^G1 Z(\S+)", open("cube.gcode").read(), re.M)))
        open("cube.scad", "w").write(f'import("cube.{name}");')
        print(f"{name}, 10 {unit}: Slic3r prints a height of {printed:.0f} mm, OpenSCAD writes "
              f"{height('openscad -o out.stl cube.scad'):g}, assimp {height(f'assimp export cube.{name} out.stl'):g}")
EOF_PY
python3 try.py | tee seen
cat > expected <<'EOF_TXT'
3mf, 10 millimeter: Slic3r prints a height of 10 mm, OpenSCAD writes 10, assimp 10
3mf, 10 inch: Slic3r prints a height of 10 mm, OpenSCAD writes 10, assimp 10
amf, 10 millimeter: Slic3r prints a height of 10 mm, OpenSCAD writes 10, assimp 10
amf, 10 inch: Slic3r prints a height of 10 mm, OpenSCAD writes 10, assimp 10
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
