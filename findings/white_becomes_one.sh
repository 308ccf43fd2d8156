#!/usr/bin/env bash
# imread of Octave makes an 8-bit picture logical if it is only black and white.
#
# Expected. The class of the array that imread returns depends on the format: a picture with 8 bits per channel is a
# uint8 array from 0 to 255. Which values occur in it does not matter.
#
# What happens. If all numbers of an 8-bit picture are 0 or 255, Octave returns a logical array, in which white is 1.
# One value between them, and white is 255. So a film of a wave has frames in which white is 255 and, when the wave has
# saturated or has not begun, frames in which it is 1. Masks and frames that are all white are affected too. Sums,
# means and conditions such as y > 127 are wrong without a warning. It is so with PNG, TIFF, PGM and BMP, grey or RGB,
# also if imwrite of Octave has written the file from a uint8 array. 16-bit pictures keep their class.
#
# Workaround: if islogical (y), y = 255 * uint8 (y); end. Or use im2double, which gives 0 to 1 for both.
#
# Seen with octave 7.3.0 and netpbm 11.01.00 of Debian 12.
set -eu
for p in octave=7.3.0 netpbm=11.01.00; do
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
cat > try.m <<'EOF_M'
1; % a script, not a function
function show (name, file)
  y = imread (file);
  printf ("%s: %s, mean %g, above 127: %d, mean of im2double %.2f\n", name, class (y), mean (double (y(:))),
          sum (y(:) > 127), mean (im2double (y)(:)));
endfunction
show ("PNG of 8 bits, 0 and 255", "two.png");
show ("PNG of 8 bits, 0, 255 and once 254", "three.png");
show ("RGB PNG, black and white", "colour.png");
show ("PGM, 0 and 255", "two.pgm");
show ("PGM, all 255", "white.pgm");
for kind = {"png", "tif", "pgm", "bmp"}
  file = ["out." kind{1}];
  imwrite (uint8 ([0 255; 255 255]), file);
  show ([kind{1} " by imwrite from uint8, 0 and 255"], file);
endfor
imwrite (uint16 ([0 65535; 65535 65535]), "out.png");
show ("png by imwrite from uint16, 0 and 65535", "out.png");
EOF_M
printf 'P5\n2 2\n255\n\0\377\377\377' > two.pgm
printf 'P5\n2 2\n255\n\0\376\377\377' > three.pgm
printf 'P5\n2 2\n255\n\377\377\377\377' > white.pgm
printf 'P6\n2 1\n255\n\0\0\0\377\377\377' > colour.ppm
pnmtopng -force two.pgm > two.png
pnmtopng -force three.pgm > three.png
pnmtopng -force colour.ppm > colour.png
octave-cli --norc try.m 2> log | tee seen
cat > expected <<'EOF_TXT'
PNG of 8 bits, 0 and 255: logical, mean 0.75, above 127: 0, mean of im2double 0.75
PNG of 8 bits, 0, 255 and once 254: uint8, mean 191, above 127: 3, mean of im2double 0.75
RGB PNG, black and white: logical, mean 0.5, above 127: 0, mean of im2double 0.50
PGM, 0 and 255: logical, mean 0.75, above 127: 0, mean of im2double 0.75
PGM, all 255: logical, mean 1, above 127: 0, mean of im2double 1.00
png by imwrite from uint8, 0 and 255: logical, mean 0.75, above 127: 0, mean of im2double 0.75
tif by imwrite from uint8, 0 and 255: logical, mean 0.75, above 127: 0, mean of im2double 0.75
pgm by imwrite from uint8, 0 and 255: logical, mean 0.75, above 127: 0, mean of im2double 0.75
bmp by imwrite from uint8, 0 and 255: logical, mean 0.75, above 127: 0, mean of im2double 0.75
png by imwrite from uint16, 0 and 65535: uint16, mean 49151.2, above 127: 3, mean of im2double 0.75
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
