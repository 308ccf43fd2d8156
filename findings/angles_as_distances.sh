#!/usr/bin/env bash
# assimp takes the angles in AMF files for distances.
#
# Expected. An instance in the constellation of an AMF file places an object by deltax, deltay and deltaz, and turns it
# about the three axes by rx, ry and rz, in degrees (ISO/ASTM 52915). The same box that is turned by 90 degrees about z
# has its length along y, at the same height.
#
# What happens. assimp reads rx, ry and rz as if they were deltax, deltay and deltaz: nothing is turned, and a part with
# rz = 90 hovers 90 mm above the plate. A true deltaz before it is overwritten. There is no warning.
#
# Workaround: write the final coordinates into the meshes; or use 3MF, whose matrices assimp applies.
#
# Seen with assimp-utils 5.2.5 of Debian 12.
set -eu
for p in assimp-utils=5.2.5; do
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
corners='0 0 0  10 0 0  0 20 0  10 20 0  0 0 30  10 0 30  0 20 30  10 20 30'
faces='0 2 1  1 2 3  4 5 6  5 7 6  0 1 4  1 5 4  2 6 3  3 6 7  0 4 2  2 4 6  1 3 5  3 7 5'
write() { # a box of 10 x 20 x 30 with this instance
  echo '<?xml version="1.0" encoding="UTF-8"?><amf unit="millimeter"><object id="1"><mesh><vertices>'
  # shellcheck disable=SC2086
  printf '<vertex><coordinates><x>%s</x><y>%s</y><z>%s</z></coordinates></vertex>\n' $corners
  echo '</vertices><volume>'
  # shellcheck disable=SC2086
  printf '<triangle><v1>%s</v1><v2>%s</v2><v3>%s</v3></triangle>\n' $faces
  echo "</volume></mesh></object><constellation id='2'><instance objectid='1'>$1</instance></constellation></amf>"
}
box() {
  for i in 2 3 4; do
    sed -n 's/^ *vertex/vertex/p' out.stl | cut -d ' ' -f $i | sort -g | sed -n '1p;$p' | paste -sd ' ' |
      sed 's/ / to /'
  done | paste -sd ',' | sed 's/,/, /g'
}
try() {
  while IFS='|' read -r instance right; do
    write "$instance" > in.amf
    assimp export in.amf out.stl > log
    echo "$instance: $(box); right is $right"
  done <<'EOF'
<deltax>50</deltax>|50 to 60, 0 to 20, 0 to 30
<rz>90</rz>|-20 to 0, 0 to 10, 0 to 30
<rx>90</rx>|0 to 10, -30 to 0, 0 to 20
<deltax>50</deltax><deltaz>5</deltaz><rz>90</rz>|30 to 50, 0 to 10, 5 to 35
EOF
}
try | tee seen
cat > expected <<'EOF_TXT'
<deltax>50</deltax>: 50 to 60, 0 to 20, 0 to 30; right is 50 to 60, 0 to 20, 0 to 30
<rz>90</rz>: 0 to 10, 0 to 20, 90 to 120; right is -20 to 0, 0 to 10, 0 to 30
<rx>90</rx>: 90 to 100, 0 to 20, 0 to 30; right is 0 to 10, -30 to 0, 0 to 20
<deltax>50</deltax><deltaz>5</deltaz><rz>90</rz>: 50 to 60, 0 to 20, 90 to 120; right is 30 to 50, 0 to 10, 5 to 35
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
