#!/bin/bash
# The museum is whole: every script of examples/museum/ has a picture and a row in README.md, and the other way round.
# Scripts are in the canonical style, and nothing warns about them. Every picture contains its script, no two show the
# same, and each grows again from itself. Without native code pictures do not grow, since that would take minutes.
set -u
museum=$SOURCE/examples/museum
failed=0
fail() {
    echo "museum: $*"
    failed=1
}

names=$(cd "$museum" && printf '%s\n' *.cascade | sed 's/\.cascade$//')
[ "$(wc -l <<<"$names")" = 100 ] || fail "there are $(wc -l <<<"$names") scripts, not 100"
diff <(echo "$names") <(cd "$museum" && printf '%s\n' *.png | sed 's/\.png$//') || fail "scripts and pictures differ"
# shellcheck disable=SC2016  # The row contains backticks.
rows=$(sed -nE 's/^\| <img src="(\w+)\.png" .*> \| `\1` \| .+ \| .+ \|$/\1/p' "$museum/README.md" | sort)
diff <(sort <<<"$names") <(echo "$rows") ||
    fail "scripts and rows of README.md differ"

"$CASCADE" fmt --check "$museum"/*.cascade || fail "these scripts are not in the canonical style"
for name in $names; do
    said=$("$CASCADE" check "$museum/$name.cascade" 2>&1) || fail "$name has errors"
    if grep -q 'warning:' <<<"$said"; then fail "$said"; fi
done

rm -rf again
mkdir again
if [ "$CASCADE_JIT" = 1 ]; then
    for name in $names; do
        "$CASCADE" run -q "$museum/$name.png" -o "again/$name.png" || fail "$name does not grow"
    done
fi
PYTHONPATH=$SOURCE/tests python3 - "$museum" <<'END' || failed=1
import pathlib
import re
import sys
import zlib
from same_picture import chunks, same


def script_in(picture):
    for kind, body in chunks(picture):
        if kind == b"iTXt" and body.startswith(b"Cascade script\0"):
            packed, text = body[15], body[17:].split(b"\0", 2)[2]
            return zlib.decompress(text) if packed else text


# Rays and Fourier transforms differ in their last bits from processor to processor.
has_rounding = re.compile(rb"\b(surface|body|convolve|imex|vortices|young)\b|\b0 = ")
shown, wrong = {}, []
for picture in sorted(pathlib.Path(sys.argv[1]).glob("*.png")):
    name, script = picture.stem, picture.with_suffix(".cascade").read_bytes()
    if script_in(picture) != script:
        wrong.append(f"{name} was not drawn from its script: run examples/draw_gallery.sh museum/{name}")
    other = shown.setdefault(tuple(body for kind, body in chunks(picture) if kind in (b"IHDR", b"IDAT")), name)
    if other != name:
        wrong.append(f"{name} and {other} are the same picture")
    again = pathlib.Path("again", picture.name)
    if again.exists() and not same(picture, again, bool(has_rounding.search(script))):
        wrong.append(f"{name} does not grow again from its picture")
for line in wrong:
    print("museum:", line)
sys.exit(1 if wrong else 0)
END
exit $failed
