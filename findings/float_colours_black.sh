#!/usr/bin/env bash
# VTK shows PLY files with float or 16-bit colours almost black.
#
# Expected. The header of a PLY file names the type of each property. Colours are mostly of the type uchar, 0
# to 255, but float, 0 to 1, and ushort are found as well; assimp and three.js read all of them by their type. A
# reader that supports only uchar should refuse the others, or leave the colours out.
#
# What happens. vtkPLYReader casts the numbers to 8 bits without scaling: .99 becomes 0, 1 becomes 1 of 255, so a
# coloured model is black. Of 16-bit colours it keeps the lower 8 bits: 32768, middle grey, becomes 0, and a ramp
# from dark to bright becomes 256 ramps. There is no warning, and the array is called RGB as usual.
#
# Workaround: write colours as uchar.
#
# Seen with python3-vtk9 9.1.0 and assimp-utils 5.2.5 of Debian 12.
set -eu
for p in python3-vtk9=9.1.0 assimp-utils=5.2.5; do
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
import vtk
def colours(kind, values):
    with open("in.ply", "w") as f:
        f.write("ply\nformat ascii 1.0\nelement vertex 3\n" + "".join(f"property float {c}\n" for c in "xyz")
                + "".join(f"property {kind} {c}\n" for c in ("red", "green", "blue"))
                + "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                + "".join(f"{p} {v} {v} {v}\n" for p, v in zip(("0 0 0", "1 0 0", "0 1 0"), values)) + "3 0 1 2\n")
    reader = vtk.vtkPLYReader()
    reader.SetFileName("in.ply")
    reader.Update()
    a = reader.GetOutput().GetPointData().GetArray("RGB")
    subprocess.run(["assimp", "export", "in.ply", "out.obj"], check=True, stdout=subprocess.DEVNULL)
    reds = [float(line.split()[4]) for line in open("out.obj") if line.startswith("v ")]
    print(f"{kind} {' '.join(map(str, values))}: vtkPLYReader {' '.join(str(int(a.GetTuple(i)[0])) for i in range(3))}"
          f" of 255, assimp {' '.join(f'{r:.2f}' for r in reds)}")
colours("uchar", (0, 128, 255))
colours("float", (0, .5, 1))
colours("ushort", (0, 32768, 65535))
colours("ushort", (1000, 2000, 3000))
EOF_PY
python3 try.py | tee seen
cat > expected <<'EOF_TXT'
uchar 0 128 255: vtkPLYReader 0 128 255 of 255, assimp 0.00 0.50 1.00
float 0 0.5 1: vtkPLYReader 0 0 1 of 255, assimp 0.00 0.50 1.00
ushort 0 32768 65535: vtkPLYReader 0 0 255 of 255, assimp 0.00 0.50 1.00
ushort 1000 2000 3000: vtkPLYReader 232 208 184 of 255, assimp 0.02 0.03 0.05
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
