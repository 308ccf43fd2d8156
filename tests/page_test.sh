#!/usr/bin/env bash
# The page of `cascade view` in a browser: every control works, the canvas shows the pixels of `cascade run`, and
# page/built contains the output of page/build.sh. Exit code 77 means that the test could not run.
set -u

fail() { echo "page: $*"; exit 1; }
skip() {
    echo "page: not tried: $*"
    exit 77
}

command -v node >/dev/null && command -v npm >/dev/null || skip "node or npm is missing"

node "$SOURCE/page/library.mjs" --check || fail "see above"

"$SOURCE/page/build.sh" built >build.log 2>&1
status=$?
cat build.log
[ "$status" = 77 ] && skip "the packages of page/package.json could not be installed"
[ "$status" = 0 ] || fail "the page cannot be built"
diff -rq built "$SOURCE/page/built" || fail "page/built is out of date: run page/build.sh and commit it"

browser=''
for name in chromium-headless-shell chromium chromium-browser google-chrome; do
    browser=$(command -v $name) && break
done
[ -n "$browser" ] || skip "there is no Chromium"

cat >spots.cascade <<'SCRIPT'
# Spots in two stages.
domain { grid: 48, 32 }
system spots {
  u: 1
  v: 0.25 * disc(0.5, 0.3, 0.1) + random(0.01, 0.01)
  feed: 0.037 in 0.01 .. 0.08 step 0.001   ## how fast u comes in
  kill: 0.06
  u' = 0.16 * lap(u) - u * v^2 + feed * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - (feed + kill) * v
}
stage grow: spots { iterations: 1500 }
stage more: spots { u: u; v: v; feed: 0.05; iterations: 500 }
SCRIPT
"$CASCADE" run spots.cascade --palette leopard -o spots.png --quiet || fail "the picture was not drawn"
"$CASCADE" run spots.cascade --palette leopard --show '3 * v' -o expression.png --quiet || fail "the expression was not drawn"
cat >colours.cascade <<'SCRIPT'
domain { grid: 40, 30; mask: not disc(0.5, 0.4, 0.1) }
system spots {
  u: 1
  v: 0.25 * disc(0.2, 0.3, 0.1) + random(0.01, 0.01)
  u' = 0.16 * lap(u) - u * v^2 + 0.037 * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - 0.097 * v
}
stage grow: spots { iterations: 800 }
picture { color: rgb(u, 3 * v, 0.5) }
SCRIPT
"$CASCADE" run colours.cascade -o colours.png --quiet || fail "the coloured picture was not drawn"
cat >line.cascade <<'SCRIPT'
domain { grid: 64 }
system front {
  interval: 10
  u: if(x < 0.2, 1, 0)
  u' = 0.2 * lap(u) + 0.05 * u * (1 - u)
}
stage grow: front { iterations: 630 }
picture { color: palette(u, 0, 1, "leopard") }
SCRIPT
"$CASCADE" run line.cascade --space-time -o line.png --quiet || fail "the picture of a row was not drawn"
cat >volume.cascade <<'SCRIPT'
domain { grid: 20, 16, 12; boundary: noflux }
system heat { u: disc(0.3, 0.4, 0.25, 0.2) + 0.3 * x; u' = 0.1 * lap(u) }
stage grow: heat { iterations: 10 }
SCRIPT
for slice in z=0.5 y=0.53 x=0.025; do
    "$CASCADE" run volume.cascade --palette leopard --slice $slice -o "${slice%=*}.png" --quiet || fail "the slice was not drawn"
done
cat >still.cascade <<'SCRIPT'
system still { u: sin(20 * x) * sin(20 * y + 3 * z); u' = 0 }
stage one: still { iterations: 1 }
SCRIPT
{ echo 'domain { surface: creature; cells: 6000 }'; cat still.cascade; } >model.cascade
{ echo 'domain { surface: box(1, 0.8, 1.2); cells: 3000 }'; cat still.cascade; } >box.cascade
cat - still.cascade >hole.cascade <<'SCRIPT'
domain {
  grid: 128, 48
  surface: (3 + cos(2*pi*sy)) * cos(2*pi*sx), (3 + cos(2*pi*sy)) * sin(2*pi*sx), sin(2*pi*sy)
  mask: not disc(0.9, 0.05, 0.06)
}
SCRIPT
cat >crawling.cascade <<'SCRIPT'
domain { surface: sphere }
stage grow: scales { founders: 60; r: 0.07; duration: 3 }
picture { shape: plate; width: 2.3 * r; length: 2.9 * r; color: rgb(y, 0.6, 0.3); skin: rgb(0.4, 0.2, 0.2) }
SCRIPT
cat >crowd.cascade <<'SCRIPT'
cells crowd: solid { }
domain { grid: 40, 20 }
stage grow: crowd { founders: keys(0.2, 0.1, 0, 0.45, 0.4, 0, 0.8, 0.15, 0); r: 0.06; duration: 1 }
picture { color: rgb(x, 0.3, 0.6); skin: rgb(0.9, 0.9, 0.85) }
SCRIPT
# Views turned on the page: 8 degrees for a key, 0.4 for a pixel.
for view in model:30,25 turned:70,33 dragged:-10,17 box:30,25 hole:30,25 crawling:30,25 crowd:30,25; do
    name=${view%:*} script=$name
    [ -f $name.cascade ] || script=model
    "$CASCADE" run $script.cascade --palette zebra --view="${view#*:}" -o $name.png --quiet || fail "the picture of $name was not drawn"
done
"$CASCADE" run hole.cascade --palette zebra --flat -o flat.png --quiet || fail "the plane was not drawn"
cat >lesson.cascade <<'SCRIPT'
# exercise: Many small spots
# exercise de: Viele kleine Flecken
# task: Change the number kill, so that spots grow and stay.
#   There must be many of them.
# task de: Ändere die Zahl kill, damit Flecken wachsen und bleiben.
#   Es müssen viele sein.
# hint: Without the kill, v eats all of u. With too much of it, v dies out.
# goal: deviation > 0.05
# goal: spots in 5 .. 400
# target: gray_scott
# locked
domain { grid: 64, 48 }
system spots {
  u: 1 - 0.5 * disc(0.5, 0.4, 0.15)
  v: 0.25 * disc(0.5, 0.4, 0.15) + random(0.01, 0.01)
  feed: 0.03
  kill: 0.06
  u' = 0.16 * lap(u) - u * v^2 + feed * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - (feed + kill) * v
  show: v
}
# open
stage grow: spots {
  kill: 0.3     # here
  iterations: 2500
}
SCRIPT
for name in spots colours; do
    [ -n "${SANITIZE:-}" ] || "$CASCADE" export $name.cascade --html $name.html >said || fail "the page $name.html was not written"
done
rm -rf profile profile_of_* models saved
node "$SOURCE/tests/page/page.mjs" "$browser" "$CASCADE" || fail "see above"
node "$SOURCE/tests/page/instruments.mjs" "$browser" "$CASCADE" || fail "see above"
for name in smooth library names saving; do
    node "$SOURCE/tests/page/$name.mjs" "$browser" "$CASCADE" || fail "see above"
done
node "$SOURCE/tests/page/solids.mjs" "$browser" "$CASCADE" || fail "see above"
node "$SOURCE/tests/page/access.mjs" "$browser" "$CASCADE" node_modules/axe-core/axe.min.js || fail "see above"
node "$SOURCE/tests/page/link.mjs" "$browser" "$CASCADE" node_modules || fail "see above"
{ echo 'domain { surface: sphere; cells: 500 }'; cat still.cascade; } >points.cascade
node "$SOURCE/tests/page/points.mjs" "$browser" "$CASCADE" points.cascade || fail "see above"
node "$SOURCE/tests/page/lesson.mjs" "$browser" "$CASCADE" lesson.cascade || fail "see above"
mkdir -p models && cp spots.cascade models
(cd models && node "$SOURCE/tests/page/models.mjs" "$browser" "$CASCADE" "$SOURCE") || fail "see above"
node "$SOURCE/tests/page/tutorial.mjs" "$browser" "$CASCADE" "$SOURCE/docs/tutorial.md" || fail "see above"
"$CASCADE" run new.png -o again.png --quiet || fail "the picture that the page saved cannot be played"
cmp new.png again.png || fail "the picture that the page saved is drawn differently by cascade run"
