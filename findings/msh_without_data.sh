#!/usr/bin/env bash
# meshio writes a .msh file for Fluent instead of Gmsh, without the data.
#
# Expected. .msh is the usual format of Gmsh, and meshio grew up with it. It reads .msh files of Gmsh with their data,
# so mesh.write("a.msh") should write such a file with point_data and cell_data, as "a.vtk" and "a.vtu" do. A format
# that cannot hold them should say so, as PLY and STL do.
#
# What happens. The file has the format of ANSYS Fluent, which has the same suffix. It has points and cells only; the
# data are left out without a word. Gmsh cannot read it. A file of Gmsh that is read by meshio and written under the
# same name has changed its format and lost its fields and its groups.
#
# Workaround: file_format="gmsh".
#
# Seen with python3-meshio 7.0.0 of Debian 12 (its own number is 5.0.0) and gmsh 4.8.4.
set -eu
for p in python3-meshio=7.0.0 gmsh=4.8.4; do
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
import subprocess
import meshio
import numpy
points = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
mesh = meshio.Mesh(points, [("triangle", numpy.array([[0, 1, 2], [0, 2, 3]]))],
                   point_data={"u": numpy.array([0.0, 1, 2, 3])}, cell_data={"v": [numpy.array([10.0, 20])]})
for name, format in ("a.vtu", None), ("a.msh", None), ("b.msh", "gmsh"):
    mesh.write(name, file_format=format)
    again = meshio.read(name)
    print(f"{name}, file_format={format}: {len(again.points)} points, u {again.point_data.get('u')}, "
          f"v {again.cell_data.get('v')}")
    print("  first line:", open(name, "rb").readline().decode().strip())
    if name.endswith("msh"):
        run = subprocess.run(["gmsh", name, "-save", "-o", "c.vtk", "-format", "vtk"], capture_output=True, text=True)
        log = run.stdout + run.stderr
        print("  Gmsh reads it:", "2 elements" in log)
meshio.read("b.msh").write("b.msh")
print("b.msh after reading and writing it: u", meshio.read("b.msh").point_data.get("u"))
EOF_PY
/usr/bin/python3 try.py | sed '/^$/d' | tee seen
cat > expected <<'EOF_TXT'
a.vtu, file_format=None: 4 points, u [0. 1. 2. 3.], v [array([10., 20.])]
  first line: <?xml version="1.0"?>
a.msh, file_format=None: 4 points, u None, v None
  first line: (1 "meshio 5.0.0")
  Gmsh reads it: False
b.msh, file_format=gmsh: 4 points, u [0. 1. 2. 3.], v [array([10., 20.])]
  first line: $MeshFormat
  Gmsh reads it: True
b.msh after reading and writing it: u None
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
