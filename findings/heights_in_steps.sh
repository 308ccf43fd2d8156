#!/usr/bin/env bash
# surface() of OpenSCAD cuts 16-bit pictures to 256 heights, and mirrors text files.
#
# Expected. surface() makes a solid from a height map, given as a PNG or as rows of numbers in a text file. PNG has
# grey of 16 bits for this purpose, with 65536 heights. A text file with the same rows should give the same solid.
#
# What happens. A 16-bit PNG is reduced to 8 bits first, so a smooth slope is printed as a flight of at most 255 steps:
# on a relief of 100 mm each is .4 mm high. Text files keep all digits, but their first row is at y = 0, at the front,
# while the first row of a picture is at the back. So a map that goes from PNG to text to get finer heights becomes its
# mirror image, with left-handed spirals and mirrored letters. Nothing warns.
#
# Workaround: a text file with its rows in the reverse order.
#
# Seen with openscad 2021.01 of Debian 12.
set -eu
for p in openscad=2021.01; do
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
import struct
import subprocess
import zlib
def png(bits, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open("map.png", "wb") as file:
        size = struct.pack(">II", len(rows[0]), len(rows))
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size + bytes([bits, 0, 0, 0, 0])))
        form = ">" + str(len(rows[0])) + ("H" if bits == 16 else "B")
        file.write(chunk(b"IDAT", zlib.compress(b"".join(b"\0" + struct.pack(form, *row) for row in rows))))
        file.write(chunk(b"IEND", b""))
def text(rows):
    with open("map.dat", "w") as file:
        file.writelines(" ".join(map(str, row)) + "\n" for row in rows)
def heights(file):  # of the corners of the top, as rows beginning with the largest y
    with open("in.scad", "w") as scad:
        scad.write(f'surface("{file}");')
    subprocess.run("openscad -o out.stl in.scad".split(), check=True, capture_output=True)
    corners = {}
    for point in re.findall(r"vertex (\S+) (\S+) (\S+)", open("out.stl").read()):
        x, y, z = map(float, point)
        if x == int(x) and y == int(y):
            corners[y, x] = max(corners.get((y, x), -1), z)
    return " | ".join(" ".join(f"{corners[y, x]:.2f}" for x in range(3)) for y in (1, 0))
rows = [[0, 20, 40], [60, 80, 100]]
print("a map of 2 rows, 0 20 40 | 60 80 100; the solid, the back first:")
png(8, [[h * 255 // 100 for h in row] for row in rows])
print("PNG of 8 bits:", heights("map.png"))
text(rows)
print("text:", heights("map.dat"))
text(rows[::-1])
print("text, rows reversed:", heights("map.dat"))
fine = [[0, 20, 20.1], [20.2, 20.3, 100]]
print("another map, 0.00 20.00 20.10 | 20.20 20.30 100.00:")
png(16, [[round(h * 655.35) for h in row] for row in fine])
print("PNG of 16 bits:", heights("map.png"))
text(fine[::-1])
print("text, rows reversed:", heights("map.dat"))
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
a map of 2 rows, 0 20 40 | 60 80 100; the solid, the back first:
PNG of 8 bits: 0.00 20.00 40.00 | 60.00 80.00 100.00
text: 60.00 80.00 100.00 | 0.00 20.00 40.00
text, rows reversed: 0.00 20.00 40.00 | 60.00 80.00 100.00
another map, 0.00 20.00 20.10 | 20.20 20.30 100.00:
PNG of 16 bits: 0.00 20.00 20.00 | 20.00 20.00 100.00
text, rows reversed: 0.00 20.00 20.10 | 20.20 20.30 100.00
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
