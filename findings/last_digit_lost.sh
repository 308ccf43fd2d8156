#!/usr/bin/env bash
# Slic3r loses the last character of the matrices in 3MF files.
#
# Expected. The matrix of a component in a 3MF file has 12 numbers, separated by spaces; the last three are the
# translation in x, y and z (core specification, 3D matrices). A part with z = 20 lies 20 mm above another.
#
# What happens. The last character of the whole matrix is dropped: z = 20 becomes 2, 12.5 becomes 12, and 0.5 becomes 0.
# A number of a single digit is right, and so are 20.0 and "20 ", whose last character does no harm. So an assembly of
# several parts is squeezed together in z, each by a factor of its own, or its parts overlap. There is no warning.
#
# Workaround: write each number with decimals, such as 20.000, or a space after the last one.
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
corners = [(x, y, z) for z in (0, 10) for y in (0, 10) for x in (0, 10)]
triangles = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
             (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in corners)
faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles)
site = "http://schemas.openxmlformats.org/package/2006/"
def height(z):  # of a cube of 10 mm, and beside it a second one with this z
    with zipfile.ZipFile("two.3mf", "w") as file:
        file.writestr("[Content_Types].xml", f'<Types xmlns="{site}content-types"><Default Extension="rels" '
                      'ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension='
                      '"model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        file.writestr("_rels/.rels", f'<Relationships xmlns="{site}relationships"><Relationship Id="r" Target='
                      '"/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
                      '</Relationships>')
        file.writestr("3D/3dmodel.model", '<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" xmlns='
                      '"http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type='
                      f'"model"><mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh></object>'
                      '<object id="2" type="model"><components><component objectid="1"/><component objectid="1" '
                      f'transform="1 0 0 0 1 0 0 0 1 30 0 {z}"/></components></object></resources><build><item '
                      'objectid="2"/></build></model>')
    info = subprocess.run(["slic3r", "--info", "two.3mf"], check=True, capture_output=True, text=True).stdout
    return float(re.search(r"size_z = (\S+)", info)[1])
for z in "5", "20", "50", "12.5", "0.5", "20.0", "20 ":
    print(f'z "{z}": the height is {height(z):.1f} mm instead of {10 + float(z):.1f} mm')
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
z "5": the height is 15.0 mm instead of 15.0 mm
z "20": the height is 12.0 mm instead of 30.0 mm
z "50": the height is 15.0 mm instead of 60.0 mm
z "12.5": the height is 22.0 mm instead of 22.5 mm
z "0.5": the height is 10.0 mm instead of 10.5 mm
z "20.0": the height is 30.0 mm instead of 30.0 mm
z "20 ": the height is 30.0 mm instead of 30.0 mm
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
