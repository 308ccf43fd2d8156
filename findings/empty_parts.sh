#!/usr/bin/env bash
# METIS leaves parts empty although a split into equal parts exists.
#
# Expected. gpmetis divides a graph into k parts of nearly equal size; ufactor=1.030 promises that none is larger than
# the mean by more than 3 %. A grid of 4 x 4 cells in 16 parts, or a row of 6 cells in 6, has an obvious answer: one
# cell per part.
#
# What happens. The default method, kway, puts 4 cells each into 4 of the 16 parts and leaves 12 empty; a row of 10
# cells in 6 parts has 2 empty ones. The status is 0. Only a line in the statistics shows it: "1.800 out of 0.600". A
# program that gives one part to each process gets processes without cells, which may be an error there, or an
# average over 0 cells. From about two cells per part on, the parts are equal.
#
# Workaround: -ptype=rb, recursive bisection, which leaves none of these parts empty, or count the cells of each part.
#
# Seen with metis 5.1.0 of Debian 12.
set -eu
for p in metis=5.1.0.dfsg; do
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
def sizes(width, height, parts, method):
    near = [[] for _ in range(width * height)]
    for y in range(height):
        for x in range(width):
            for u, v in (x + 1, y), (x, y + 1):
                if u < width and v < height:
                    near[y * width + x].append(v * width + u + 1)
                    near[v * width + u].append(y * width + x + 1)
    with open("graph", "w") as file:
        file.write(f"{width * height} {sum(map(len, near)) // 2}\n")
        file.writelines(" ".join(map(str, row)) + "\n" for row in near)
    subprocess.run(["gpmetis", f"-ptype={method}", "graph", str(parts)], check=True, capture_output=True)
    with open(f"graph.part.{parts}") as file:
        owners = [int(line) for line in file]
    return [owners.count(part) for part in range(parts)]
for width, height, parts in (6, 1, 6), (10, 1, 6), (16, 1, 8), (4, 4, 8), (4, 4, 16), (8, 8, 16):
    for method in "kway", "rb":
        count = sizes(width, height, parts, method)
        print(f"{width} x {height} cells in {parts} parts, {method}: {count.count(0)} are empty,",
              f"the largest has {max(count)}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
6 x 1 cells in 6 parts, kway: 3 are empty, the largest has 2
6 x 1 cells in 6 parts, rb: 0 are empty, the largest has 1
10 x 1 cells in 6 parts, kway: 2 are empty, the largest has 3
10 x 1 cells in 6 parts, rb: 0 are empty, the largest has 2
16 x 1 cells in 8 parts, kway: 0 are empty, the largest has 2
16 x 1 cells in 8 parts, rb: 0 are empty, the largest has 2
4 x 4 cells in 8 parts, kway: 0 are empty, the largest has 2
4 x 4 cells in 8 parts, rb: 0 are empty, the largest has 2
4 x 4 cells in 16 parts, kway: 12 are empty, the largest has 4
4 x 4 cells in 16 parts, rb: 0 are empty, the largest has 1
8 x 8 cells in 16 parts, kway: 0 are empty, the largest has 4
8 x 8 cells in 16 parts, rb: 0 are empty, the largest has 5
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
