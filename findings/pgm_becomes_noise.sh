#!/usr/bin/env bash
# OpenImageIO writes noise into PGM and PPM files of 16 bits.
#
# Expected. oiiotool -d uint16 writes 16 bits per channel, into PNG, TIFF and also into PGM and PPM, whose header then
# says that the largest number is 65535. A ramp stays a ramp.
#
# What happens. The header is right, but the pixels are first reduced to 8 bits, and then each pair of bytes is taken
# for one number of 16 bits. So the left half of each row has two pixels in one, and the right half is whatever was in
# the memory. oiiotool describes the file as "uint16 pnm" and reads the same noise. ASCII files, grey and RGB, are all
# affected. A PNG by the same command is right. A PGM without -d uint16 is right too, but has only 8 bits, even if the
# input has 16. Nothing warns.
#
# Workaround: write a PNG and convert it, as in the last line of the output.
#
# Seen with openimageio-tools 2.4.7.1 and netpbm 11.01.00 of Debian 12.
set -eu
for p in openimageio-tools=2.4.7.1 netpbm=11.01.00; do
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
ramp() { # eight steps from 300 to 28300, in so many channels
  for i in 0 1 2 3 4 5 6 7; do
    for _ in $(seq "$1"); do echo $((300 + 4000 * i)); done
  done
}
numbers() { # the first two pixels of a file with so many channels, and the largest number of its header
  pnmtoplainpnm "$2" | tr -s ' \n' '\n\n' | sed -n "4p;5,$((4 + 2 * $1))p" | paste -sd ' ' |
    sed 's/\([0-9]*\) \(.*\)/\2, of \1/'
}
try() {
  echo "the numbers are 300 4300 8300 and so on"
  { printf 'P2\n8 1\n65535\n'; ramp 1; } > grey.pgm
  { printf 'P3\n8 1\n65535\n'; ramp 3; } > colour.ppm
  oiiotool grey.pgm -d uint16 -o out.pgm
  echo "PGM: $(oiiotool --info out.pgm | sed 's/.*, //'), begins with $(numbers 1 out.pgm)"
  oiiotool grey.pgm -d uint16 --attrib pnm:binary 0 -o ascii.pgm
  echo "ASCII PGM begins with $(numbers 1 ascii.pgm)"
  oiiotool colour.ppm -d uint16 -o out.ppm
  echo "PPM begins with $(numbers 3 out.ppm)"
  oiiotool grey.pgm -o bytes.pgm
  echo "PGM without -d begins with $(numbers 1 bytes.pgm)"
  oiiotool grey.pgm -d uint16 -o out.png
  pngtopnm out.png > good.pgm
  echo "PNG, converted, begins with $(numbers 1 good.pgm)"
}
try | tee seen
cat > expected <<'EOF_TXT'
the numbers are 300 4300 8300 and so on
PGM: uint16 pnm, begins with 4353 12320, of 65535
ASCII PGM begins with 4353 12320, of 65535
PPM begins with 257 4353 4369 8224 12320 12336, of 65535
PGM without -d begins with 1 17, of 255
PNG, converted, begins with 300 4300, of 65535
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
