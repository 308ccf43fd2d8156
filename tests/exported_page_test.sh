#!/usr/bin/env bash
# Exported pages: headless Chromium opens the file from the disk, without a network, and its canvas is compared with PNG
# files of `cascade run`. Every control works, here and on the page of `cascade view`. Also what `cascade export` refuses.
set -u

fail() { echo "exported_page: $*"; exit 1; }

[ -z "${SANITIZE:-}" ] || { echo "exported_page: builds with sanitizers have no engine"; exit 77; }
browser=$(command -v chromium-headless-shell || command -v chromium) || fail "chromium is missing; cmake/packages.txt names its package"
command -v node >/dev/null || fail "node is missing; cmake/packages.txt names its package"

cat >spots.cascade <<'SCRIPT'
domain { grid: 48, 32 }
system spots {
  feed: 0.037 in 0.01 .. 0.08 step 0.001   ## of u
  u: 1 - 0.5 * image("dots.png")
  v: 0.25 * image("dots.png") + random(0.01, 0.01)
  u' = 0.16 * lap(u) - u * v^2 + feed * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - 0.097 * v
}
stage grow: spots { iterations: 1500 }
stage more: spots { u: u; v: v; feed: 0.05; iterations: 500 }
SCRIPT
cat >dots.cascade <<'SCRIPT'
domain { grid: 48, 32 }
system dots { u: disc(0.3, 0.3, 0.1); u' = 0 }
stage only: dots { iterations: 1 }
SCRIPT
"$CASCADE" run dots.cascade --palette grey -o dots.png --quiet || fail "the picture to read was not drawn"
"$CASCADE" run spots.cascade --palette leopard -o spots.png --quiet || fail "the picture was not drawn"
"$CASCADE" export spots.cascade >said || fail "the page was not written"
grep -qE '^spots\.html \([0-9.]+ MB\)$' said || fail "it said: $(cat said)"
[ "$(stat -c %s spots.html)" -lt 4000000 ] || fail "the page has $(stat -c %s spots.html) bytes"

cat >sphere.cascade <<'SCRIPT'
domain { mesh: "ball.off"; cells: 2000 }
system heat { u: if(z > 0.5, 1, 0); u' = 0.1 * lap(u) }
stage grow: heat { iterations: 60 }
SCRIPT
cp "$SOURCE/tests/support/octahedron.off" ball.off
"$CASCADE" export sphere.cascade --html ball.html --set grow.iterations=80 >/dev/null || fail "the page of a model was not written"

"$CASCADE" export - <dots.cascade >said || fail "a script of standard input was not exported"
grep -q '^cascade\.html (' said || fail "a script of standard input became: $(cat said)"
grep -q '"name":"cascade.cascade"' cascade.html || fail "the page of standard input names files after no file"

"$CASCADE" run sphere.cascade --set grow.iterations=80 --palette zebra -o ball.png --quiet || fail "the model was not drawn"
cat >volume.cascade <<'SCRIPT'
domain { grid: 20, 16, 12; boundary: noflux }
system heat { u: disc(0.3, 0.4, 0.25, 0.2) + 0.3 * x; u' = 0.1 * lap(u) }
stage grow: heat { iterations: 10 }
SCRIPT
"$CASCADE" export volume.cascade >/dev/null || fail "the page of a volume was not written"
"$CASCADE" run volume.cascade --palette leopard -o volume.png --quiet || fail "the slice was not drawn"

cat >crawling.cascade <<'SCRIPT'
domain { surface: sphere }
stage grow: scales { founders: 60; r: 0.07; duration: 3 }
picture { shape: plate; width: 2.3 * r; length: 2.9 * r; color: rgb(y, 0.6, 0.3); skin: rgb(0.4, 0.2, 0.2) }
SCRIPT
"$CASCADE" export crawling.cascade >/dev/null || fail "the page of cells was not written"
"$CASCADE" run crawling.cascade -o crawling.png --quiet || fail "the cells were not drawn"

# Bad input: one message, and no file is left.
refused() {
    local wanted=$1
    shift
    "$CASCADE" export "$@" >out 2>error && fail "not refused: $*"
    grep -qF -- "$wanted" error || fail "'$*' said: $(cat error)"
    [ ! -e refused.html ] || fail "'$*' left a page"
}
echo "system s { u: 1" >wrong.cascade
refused "wrong.cascade" wrong.cascade --html refused.html
echo 'system s { u: field("none.npy"); u'"'"' = 0 } stage a: s { iterations: 1 }' >missing.cascade
refused "none.npy" missing.cascade --html refused.html
refused "cannot make the body of stage 'skin'" "$SOURCE/examples/cells/grown_body.cascade" --html refused.html
refused "no folder" spots.cascade --html none/refused.html
mkdir -p folder.html
refused "folder.html" spots.cascade --html folder.html
refused "a script is missing"

sed -n "/^cat >lesson.cascade/,/^SCRIPT/p" "$SOURCE/tests/page_test.sh" | sed '1d;$d' >lesson.cascade
"$CASCADE" export lesson.cascade >/dev/null || fail "the page of an exercise was not written"
sed 's/^domain.*/domain { surface: sphere; cells: 500 }/' dots.cascade | sed 's/disc(0.3, 0.3, 0.1)/x/' >points.cascade
"$CASCADE" export points.cascade >/dev/null || fail "the page of a ball was not written"
rm -rf profile profile_of_points_2 profile_of_lesson_2 profile_of_controls*
node "$SOURCE/tests/page/exported.mjs" "$browser" || fail "see above"
for page in '' spots.html; do node "$SOURCE/tests/page/controls.mjs" "$browser" "$CASCADE" $page || fail "see above"; done
node "$SOURCE/tests/page/points.mjs" "$browser" "$CASCADE" points.cascade points.html || fail "see above"
node "$SOURCE/tests/page/lesson.mjs" "$browser" "$CASCADE" lesson.cascade lesson.html || fail "see above"
