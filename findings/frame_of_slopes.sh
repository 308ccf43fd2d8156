#!/usr/bin/env bash
# imgradientxy of Octave gives a grey picture steep slopes along its border.
#
# Expected. A picture of one grey has no slope anywhere. At the border of a picture the function has no neighbours, and
# can take the nearest pixel for them, or a one-sided difference, as gradient() of the same Octave does.
#
# What happens. imgradientxy and imgradient take 0 for all pixels outside. So grey .5 has a slope of 2 on the left and
# -2 on the right, and smaller ones by the other methods: each picture has a frame as strong as its border is bright. In
# a picture with a step from .5 to .6 the frame is five times as steep as the step: maximum, mean, and thresholds that
# are made from the result see the frame only. edge() of the same package finds no edge in the grey. The slopes of
# "sobel" are 8 times and those of "prewitt" 6 times the slope per pixel, as they are nowhere divided. A rise to the
# right is positive, though the help has x(i-1) - x(i+1) for "central".
#
# Workaround: gradient(u), or padarray(u, [1 1], "replicate") before, and cut the border off afterwards.
#
# Seen with octave-image 2.14.0 and octave 7.3.0 of Debian 12.
set -eu
for p in octave=7.3.0 octave-image=2.14.0; do
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
pkg load image
grey = .5 * ones(4, 6);
row = @(name, g) printf("%s: %s\n", name, strtrim(sprintf("%.4g ", g(2, :))));
for method = {"sobel", "prewitt", "central", "intermediate"}
  row(["grey, " method{1}], imgradientxy(grey, method{1}));
end
row("grey, gradient()", gradient(grey));
row("grey, edges", edge(grey, "sobel"));
step = grey;
step(:, 4:6) = .6;
row("step, imgradient", round(1000 * imgradient(step)) / 1000);
padded = imgradient(padarray(step, [1 1], "replicate"));
row("step, padded and cut", round(1000 * padded(2:end-1, 2:end-1)) / 1000);
row("ramp of .1 to the right, central", imgradientxy(repmat((0:5) / 10, 4, 1), "central"));
EOF_M
octave --no-gui --quiet try.m 2> told | tee seen
cat > expected <<'EOF_TXT'
grey, sobel: 2 0 0 0 0 -2
grey, prewitt: 1.5 0 0 0 0 -1.5
grey, central: 0.25 0 0 0 0 -0.25
grey, intermediate: 0 0 0 0 0 -0.5
grey, gradient(): 0 0 0 0 0 0
grey, edges: 0 0 0 0 0 0
step, imgradient: 2 0 0.4 0.4 0 2.4
step, padded and cut: 0 0 0.4 0.4 0 0
ramp of .1 to the right, central: 0.05 0.1 0.1 0.1 0.1 -0.2
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
