#!/usr/bin/env bash
# ffmpeg stretches the contrast of grey float pictures.
#
# Expected. A value v of a grey PFM or EXR file becomes 65535 v in a 16-bit PNG, as it does if the same picture has three
# channels. ffmpeg would report a conversion from the range of television to the full range.
#
# What happens. ffmpeg assumes that the floats have the range of television: 16/255 becomes black, 235/255 becomes white,
# values outside are cut, and .25 becomes .218. All formats with more than 8 bits and RGB of 8 bits are affected; grey of
# 8 bits is right. A 16-bit PNG that is converted to PFM loses contrast in the same way, and an 8-bit PNG does not. There
# is no warning. Colour pictures (PF, or EXR with R, G and B) are converted correctly.
#
# Workaround: give both ranges, -vf scale=in_range=pc:out_range=pc, or use three equal channels.
#
# Seen with ffmpeg 5.1.9 of Debian 12.
set -eu
for p in ffmpeg=5.1.9 python3-numpy=1.24.2; do
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
import numpy
import subprocess
ramp = numpy.linspace(0, 1, 9, dtype="<f4")
def pfm(kind, pixels):
    open("in.pfm", "wb").write(f"{kind}\n9 1\n-1.0\n".encode() + pixels.tobytes())
def ffmpeg(source, target, kind, **how):
    command = f"ffmpeg -v error -y {source} -pix_fmt {target} -f rawvideo out.raw".split()
    subprocess.run(command, check=True)
    return numpy.fromfile("out.raw", kind)
def show(name, values, full):
    print(f"{name}:", " ".join(f"{v / full:.3f}" for v in values))
show("the ramp", ramp, 1)
pfm("Pf", ramp)
show("grey floats to 8 bits", ffmpeg("-i in.pfm", "gray", "u1"), 255)
show("grey floats to 16 bits", ffmpeg("-i in.pfm", "gray16le", "<u2"), 65535)
show("grey floats to 10 bits", ffmpeg("-i in.pfm", "gray10le", "<u2"), 1023)
show("grey floats to RGB of 8 bits", ffmpeg("-i in.pfm", "rgb24", "u1")[::3], 255)
show("grey floats to 16 bits, ranges said",
     ffmpeg("-i in.pfm -vf scale=in_range=pc:out_range=pc", "gray16le", "<u2"), 65535)
pfm("PF", numpy.repeat(ramp, 3))
show("RGB floats to RGB of 16 bits", ffmpeg("-i in.pfm", "rgb48le", "<u2")[::3], 65535)
def grey(bits):  # a PNG from whole numbers, and that PNG to floats
    full = 2 ** bits - 1
    (ramp * full).round().astype(f"<u{bits // 8}").tofile("in.raw")
    subprocess.run(f"ffmpeg -v error -y -f rawvideo -pix_fmt gray{'16le' if bits == 16 else ''} -s 9x1 -i in.raw "
                   "in.png".split(), check=True)
    show(f"PNG of {bits} bits to floats", ffmpeg("-i in.png", "grayf32le", "<f4"), 1)
grey(8)
grey(16)
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
the ramp: 0.000 0.125 0.250 0.375 0.500 0.625 0.750 0.875 1.000
grey floats to 8 bits: 0.000 0.125 0.251 0.376 0.502 0.624 0.749 0.875 1.000
grey floats to 16 bits: 0.000 0.073 0.218 0.364 0.509 0.655 0.800 0.946 1.000
grey floats to 10 bits: 0.000 0.073 0.219 0.365 0.510 0.656 0.802 0.947 1.000
grey floats to RGB of 8 bits: 0.000 0.075 0.220 0.365 0.510 0.659 0.804 0.949 1.000
grey floats to 16 bits, ranges said: 0.000 0.125 0.250 0.375 0.500 0.625 0.750 0.875 1.000
RGB floats to RGB of 16 bits: 0.000 0.125 0.250 0.375 0.500 0.625 0.750 0.875 1.000
PNG of 8 bits to floats: 0.000 0.125 0.251 0.376 0.502 0.624 0.749 0.875 1.000
PNG of 16 bits to floats: 0.063 0.170 0.277 0.385 0.492 0.599 0.706 0.814 0.921
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
