#!/usr/bin/env bash
# Density files of POV-Ray move by half a voxel when they are interpolated, and the last voxel gets the first one's
# value.
#
# Expected. A df3 file holds numbers for voxels that fill the unit cube: n voxels along x, each 1/n wide. Without
# interpolation POV-Ray draws them so, and the middle of voxel i is (i + .5)/n. With interpolate 1 the value there
# should stay, and change linearly between the middles, as textures do.
#
# What happens. With interpolate 1 or 2 the value of voxel i is at its lower corner, i/n: the whole density moves by
# half a voxel towards 0 in x, y and z. Beyond the last corner the density goes back to the first voxel, as if the
# field were periodic: a bright voxel on the left makes the right end glow, and a symmetric body is symmetric no more.
# With 16 voxels the shift is 3 % of the width. Nothing warns.
#
# Workaround: translate <.5/nx, .5/ny, .5/nz> before scaling, and give the file a margin of zeros on all sides.
#
# Seen with povray 3.7.0.10 of Debian 12.
set -eu
for p in povray=3.7.0.10; do
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
def densities(row, xs, how):  # what POV-Ray makes of a row of voxels at the given x
    with open("a.df3", "wb") as file:
        file.write(struct.pack(">HHH", len(row), 1, 1) + bytes(row))
    with open("a.pov", "w") as file:
        file.write(f'#declare f = function {{ pattern {{ density_file df3 "a.df3" {how} }} }}\ncamera {{}}\n')
        file.writelines(f'#debug concat("seen ",str(f({x},.5,.5),0,4),"\\n")\n' for x in xs)
    log = subprocess.run("povray +Ia.pov +Oa.png +W4 +H4 -D".split(), capture_output=True, text=True).stderr
    return [f"{float(v):g}" for v in re.findall(r"seen (\S+)", log)]
row = [255, 51, 102, 0]  # 1, .2, .4, 0
middles = [.125, .375, .625, .875]
corners = [0, .25, .5, .75]
print("four voxels: 1 .2 .4 0")
for how in "", "interpolate 1", "interpolate 2":
    print(how or "not interpolated")
    print("  in their middles:", *densities(row, middles, how))
    print("  at their lower corners:", *densities(row, corners, how))
print("a symmetric body, 0 0 1 1 0 0, linear, from left to right:")
print(" ", *densities([0, 0, 255, 255, 0, 0], [i / 12 for i in range(1, 12)], "interpolate 1"))
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
four voxels: 1 .2 .4 0
not interpolated
  in their middles: 1 0.2 0.4 0
  at their lower corners: 1 0.2 0.4 0
interpolate 1
  in their middles: 0.6 0.3 0.2 0.5
  at their lower corners: 1 0.2 0.4 0
interpolate 2
  in their middles: 0.65 0.275 0.15 0.525
  at their lower corners: 1 0.2 0.4 0
a symmetric body, 0 0 1 1 0 0, linear, from left to right:
  0 0 0.5 1 1 1 0.5 0 0 0 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
