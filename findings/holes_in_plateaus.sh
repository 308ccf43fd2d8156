#!/usr/bin/env bash
# The smoothest interpolation of POV-Ray bores dark holes into bright plateaus.
#
# Expected. A density file with interpolate 2, tricubic, is smoother than with interpolate 1. Cubic interpolation
# overshoots a little beside a sharp edge: a plateau of 1 goes up to 1.06 there, in a corner of a cube to 1.2. POV-Ray
# should cut this to 1, or leave it.
#
# What happens. Values above 1 lose the 1: 1.06 becomes .06, since all patterns are taken modulo 1. So every plateau
# of full density gets a thin dark shell just inside its surface, and a slab two voxels thick is nearly empty in the
# middle. Values below 0 are cut to 0, as one expects. Files whose largest number is 255 are the rule, as writers
# scale fields to use the whole range. Nothing warns.
#
# Workaround: scale the numbers to at most 200 of 255, or use interpolate 1.
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
xs = [i / 16 for i in range(4, 15)]
for top in 255, 200:
    row = [0, 0, 0, top, top, top, 0, 0]
    print("voxels:", *row)
    for how in "interpolate 1", "interpolate 2":
        print(f"  {how}:", *densities(row, xs, how))
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
voxels: 0 0 0 255 255 255 0 0
  interpolate 1: 0 0.5 1 1 1 1 1 0.5 0 0 0
  interpolate 2: 0 0.5 1 0.0625 1 0.0625 1 0.5 0 0 0
voxels: 0 0 0 200 200 200 0 0
  interpolate 1: 0 0.3922 0.7843 0.7843 0.7843 0.7843 0.7843 0.3922 0 0 0
  interpolate 2: 0 0.3922 0.7843 0.8333 0.7843 0.8333 0.7843 0.3922 0 0 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
