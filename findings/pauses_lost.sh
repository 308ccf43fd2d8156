#!/usr/bin/env bash
# Pillow shortens the pauses of an animated PNG.
#
# Expected. save_all with duration=50 shows each picture for 50 ms, so a film of six pictures takes 300 ms. If equal
# pictures follow each other, Pillow stores them once; it should then show this one for the time of all of them, as it
# does in GIF and WebP files.
#
# What happens. In an animated PNG the time of the left out pictures is lost if duration is a single number. A pattern
# that rests for three pictures and then goes on rests for one; a film that ends with a pause, so that one can look at
# the result, ends without. Sound, a second film beside it, or a clock in the caption are no longer in step. With a
# list of durations the sum is right. Nothing warns.
#
# Workaround: duration=[50] * len(pictures).
#
# Seen with python3-pil 9.4.0 of Debian 12.
set -eu
for p in python3-pil=9.4.0; do
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
import struct
from PIL import Image
def png_times(name):
    data, at, times = open(name, "rb").read(), 8, []
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"fcTL":
            top, bottom = struct.unpack(">HH", data[at + 28:at + 32])
            times.append(1000 * top // bottom)
        at += size + 12
    return times
def times(name):
    if name.endswith("png"):
        return png_times(name)
    image, found = Image.open(name), []
    for k in range(image.n_frames):
        image.seek(k)
        image.load()
        found.append(image.info["duration"])
    return found
frames = [Image.new("L", (8, 8), grey) for grey in (0, 0, 0, 100, 200, 200)]
for name in "a.gif", "a.webp", "a.png":
    for duration in 50, [50] * 6:
        frames[0].save(name, save_all=True, append_images=frames[1:], duration=duration, loop=0)
        print(f"{name}, duration={duration}: {sum(times(name))} ms as {times(name)}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
a.gif, duration=50: 300 ms as [150, 50, 100]
a.gif, duration=[50, 50, 50, 50, 50, 50]: 300 ms as [150, 50, 100]
a.webp, duration=50: 300 ms as [150, 50, 100]
a.webp, duration=[50, 50, 50, 50, 50, 50]: 300 ms as [150, 50, 100]
a.png, duration=50: 150 ms as [50, 50, 50]
a.png, duration=[50, 50, 50, 50, 50, 50]: 300 ms as [150, 50, 100]
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
