#!/usr/bin/env bash
# Each cover of examples/covers grows again from its own picture, as the gallery's pictures do in tests/gallery_test.sh.
# Covers are large and take minutes.
set -u
failed=0
for picture in "$SOURCE"/examples/covers/*.png; do
    "$CASCADE" run -q "$picture" -o again.png || failed=1
    python3 "$SOURCE/tests/same_picture.py" --surface "$picture" again.png || { echo "covers: $picture does not grow again from itself"; failed=1; }
done
exit $failed
