#!/usr/bin/env bash
# vips makes a 16-bit picture white when it is asked for 8 bits.
#
# Expected. "vips copy in.png out.png[bitdepth=8]" reduces the bits: 65535 becomes 255, and 32896 becomes 128, as with
# out.jpg, out.webp or out.gif, for which vips reduces a 16-bit picture by itself.
#
# What happens. The option casts the numbers without scaling. All numbers above 255 become 255, so a 16-bit picture turns
# white, except the darkest 0.4 % of its range. There is no warning. For TIFF the option has no effect.
#
# Workaround: "vips colourspace in.png out.png b-w" (or srgb for colour), which scales.
#
# Seen with libvips-tools 8.14.1 of Debian 12.
set -eu
for p in libvips-tools=8.14.1; do
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
printf 'P5\n5 1\n65535\n\0\0\1\1\100\100\200\200\377\377' > in.pgm
vips copy in.pgm in.png
show() {
  vips copy "$1" seen.csv
  echo "$1${2-}: $(cat seen.csv)"
}
{
  show in.png
  vips copy in.png 'a.png[bitdepth=8]' && show a.png ' by bitdepth=8'
  vips copy in.png 'b.jpg[Q=100]' && show b.jpg
  vips copy in.png 'c.tif[bitdepth=8]' && show c.tif ' by bitdepth=8'
  vips colourspace in.png d.png b-w && show d.png ' by colourspace b-w'
} | tee seen
cat > expected <<'EOF_TXT'
in.png: 0	257	16448	32896	65535
a.png by bitdepth=8: 0	255	255	255	255
b.jpg: 0	1	64	128	255
c.tif by bitdepth=8: 0	257	16448	32896	65535
d.png by colourspace b-w: 0	1	64	128	255
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
