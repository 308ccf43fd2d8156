#!/usr/bin/env bash
# OpenSCAD puts all parts of 3MF and AMF files at the origin, once and unscaled.
#
# Expected. A 3MF file lists what is to be printed as items and components, each an object with a matrix that places
# it (core specification, build and components); AMF does it by the instances of a constellation. import() of OpenSCAD
# should give all bodies where the file puts them, as assimp does, or refuse the file.
#
# What happens. OpenSCAD reads the meshes of all objects and nothing that places them. Ten copies on a plate are one.
# Two boxes that stand on each other are one box; a part that is scaled has its old size; an object that is in the
# file but not printed is printed. There is no warning, and the log reports a valid 3D object.
#
# Workaround: write the final coordinates into the meshes, with one object; or convert the file by assimp export.
#
# Seen with openscad 2021.01 and assimp-utils 5.2.5 of Debian 12.
set -eu
for p in openscad=2021.01 assimp-utils=5.2.5; do
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
def cube(number, size=1):
    vertices = "".join(f'<vertex x="{size * x}" y="{size * y}" z="{size * z}"/>' for x, y, z in corners)
    faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles)
    return (f'<object id="{number}" type="model"><mesh><vertices>{vertices}</vertices>'
            f'<triangles>{faces}</triangles></mesh></object>')
def tmf(objects, items):
    site = "http://schemas.openxmlformats.org/package/2006/"
    with zipfile.ZipFile("in.3mf", "w") as z:
        z.writestr("[Content_Types].xml", f'<Types xmlns="{site}content-types"><Default Extension="rels" ContentType='
                   '"application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" '
                   'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        z.writestr("_rels/.rels", f'<Relationships xmlns="{site}relationships"><Relationship Id="r" Target='
                   '"/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
                   '</Relationships>')
        z.writestr("3D/3dmodel.model", '<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" xmlns='
                   f'"http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>{objects}</resources>'
                   f'<build>{items}</build></model>')
def amf(instances):
    vertices = "".join(f"<vertex><coordinates><x>{x}</x><y>{y}</y><z>{z}</z></coordinates></vertex>"
                       for x, y, z in corners)
    faces = "".join(f"<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>" for a, b, c in triangles)
    open("in.amf", "w").write('<?xml version="1.0" encoding="UTF-8"?>\n<amf unit="millimeter"><object id="1"><mesh>'
                              f"<vertices>{vertices}</vertices><volume>{faces}</volume></mesh></object>"
                              f'<constellation id="2">{instances}</constellation></amf>\n')
def box(command):
    subprocess.run(command.split(), check=True, capture_output=True)
    points = [tuple(map(float, p)) for p in re.findall(r"vertex (\S+) (\S+) (\S+)", open("out.stl").read())]
    return " x ".join(f"{min(p[i] for p in points):g}..{max(p[i] for p in points):g}" for i in range(3))
def show(name, file):
    open("in.scad", "w").write(f'import("{file}");')
    print(f"{name}: OpenSCAD {box('openscad -o out.stl in.scad')}, assimp {box(f'assimp export {file} out.stl')}")
def item(number, matrix):
    return f'<item objectid="{number}" transform="{matrix}"/>'
tmf(cube(1), item(1, "1 0 0 0 1 0 0 0 1 0 0 0") + item(1, "1 0 0 0 1 0 0 0 1 50 0 0"))
show("3MF, two items side by side", "in.3mf")
tmf(cube(1), item(1, "3 0 0 0 1 0 0 0 1 0 0 0"))
show("3MF, an item three times as long", "in.3mf")
tmf(cube(1) + '<object id="2" type="model"><components><component objectid="1"/><component objectid="1" '
    'transform="1 0 0 0 1 0 0 0 1 0 0 10"/></components></object>', '<item objectid="2"/>')
show("3MF, two components, one on the other", "in.3mf")
tmf(cube(1) + cube(2, 3), '<item objectid="1"/>')
show("3MF, a larger object that is not printed", "in.3mf")
amf('<instance objectid="1"><deltax>0</deltax></instance><instance objectid="1"><deltax>50</deltax></instance>')
show("AMF, two instances side by side", "in.amf")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
3MF, two items side by side: OpenSCAD 0..10 x 0..10 x 0..10, assimp 0..60 x 0..10 x 0..10
3MF, an item three times as long: OpenSCAD 0..10 x 0..10 x 0..10, assimp 0..30 x 0..10 x 0..10
3MF, two components, one on the other: OpenSCAD 0..10 x 0..10 x 0..10, assimp 0..10 x 0..10 x 0..20
3MF, a larger object that is not printed: OpenSCAD 0..30 x 0..30 x 0..30, assimp 0..10 x 0..10 x 0..10
AMF, two instances side by side: OpenSCAD 0..10 x 0..10 x 0..10, assimp 0..60 x 0..10 x 0..10
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
