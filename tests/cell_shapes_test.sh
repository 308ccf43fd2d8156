#!/usr/bin/env bash
# The appearance of cells that crawl: shapes by formulas and from files, the skin below them, and drawing a saved run in
# another way.
set -u
rm -rf ./*

fail() { echo "cell_shapes: $*"; exit 1; }
# points FILE.obj: prints its numbers of points and triangles.
points() { grep -c '^v ' "$1"; grep -c '^f ' "$1"; }

cells='cells still { p'"'"' += cling(1) }
domain { surface: sphere }
stage stand: still { founders: 6; duration: 0.1; r: 0.1 }'
draw() { # draw NAME PICTURE [OPTION …]: writes NAME.png and NAME.obj
    local name=$1 picture=$2
    shift 2
    printf '%s\n' "$cells" "$picture" >"$name.cascade"
    "$CASCADE" run -q "$name.cascade" -o "$name.png" -o "$name.obj" "$@" 2>err || fail "$name: $(cat err)"
}

# A shape of the script is drawn like the library's shape with the same formulas.
draw ball 'picture { shape: ball; color: rgb(1, 0, 0) }'
draw own 'shape own { middle = vector(0, -cos(pi * t), 0); radius = sin(pi * t) }
picture { shape: own; color: rgb(1, 0, 0) }'
cmp -s ball.obj own.obj || fail "a ball by formulas is another one"
# Each cell has a form of its own.
draw forms 'shape box { k: 1 in 1 .. 2; radius = k }
picture { shape: box; k: 1 + x; color: rgb(1, 0, 0) }'
draw form 'shape box { k: 1 in 1 .. 2; radius = k }
picture { shape: box; color: rgb(1, 0, 0) }'
cmp -s forms.obj form.obj && fail "all cells have one form"

# Cells that cannot be drawn are reported, and the others are drawn.
draw torn 'shape torn { k: 1; radius = (1 - t) / k }
picture { shape: torn; k: if(x > 0.5, 1, 0); color: rgb(1, 0, 0) }'
"$CASCADE" run torn.cascade -o torn.png >out 2>&1 || fail "torn: $(cat out)"
grep -q "of 6 cells are not drawn: the shape 'torn' of cell [0-5] with k = 0 is not finite at t = 0" out ||
    fail "torn: $(cat out)"

# The model of a file: a pyramid of width 4, height 6 and length 2 stands on its base.
cat >pyramid.obj <<'END'
v 1 5 1
v 5 5 1
v 5 5 3
v 1 5 3
v 3 11 2
f 1 2 3 4
f 2 1 5
f 3 2 5
f 4 3 5
f 1 4 5
END
draw file 'picture { shape: "pyramid.obj"; width: 0.2; color: rgb(1, 0, 0) }'
draw square 'picture { shape: "pyramid.obj"; width: 0.2; length: 0.1; height: 0.3; color: rgb(1, 0, 0) }'
paste -d' ' file.obj square.obj | awk '$1 == "v" { for (k = 2; k < 5; ++k) if (($k - $(k + 7))^2 > 1e-10) exit 1 }' ||
    fail "a file does not keep its proportions"
mkdir -p elsewhere && mv pyramid.obj elsewhere
"$CASCADE" run -q file.cascade -o gone.png 2>err && fail "a missing file is drawn"
grep -q "file.cascade:4:18: error: .*pyramid.obj" err || fail "a missing file: $(cat err)"
[ ! -e gone.png ] || fail "a picture was written without its shape"
"$CASCADE" run -q file.cascade -o there.obj --allow-read elsewhere || fail "--allow-read"
cmp -s there.obj file.obj || fail "another place, another shape"

# A smaller `detail` gives more triangles in pictures, but does not change files.
draw fine 'picture { shape: ball; color: rgb(1, 0, 0); detail: 0.05 }'
cmp -s ball.obj fine.obj || fail "detail: changes files"
cmp -s ball.png fine.png && fail "detail: changes no picture"

# The skin shows a pattern that grew before, in pictures and files.
coat() { # coat NAME SKIN DOMAIN
    cat >"$1.cascade" <<END
system bands { u: y > 0.5; u' = 0 }
cells still { p' += cling(1) }
domain { $3 }
stage coat: bands { iterations: 1 }
stage stand: still { founders: 6; duration: 0.1; r: 0.02 }
picture { color: rgb(0, 1, 0); skin: $2 }
END
}
coat even 'rgb(1, 0, 0)' 'surface: sphere; cells: 900'
coat bands 'rgb(u, 0, 1 - coat.u)' 'surface: sphere; cells: 900'
for name in even bands; do
    "$CASCADE" run -q $name.cascade -o $name.png -o $name.obj -o $name.glb --merge 2>err || fail "$name"
    [ ! -s err ] || fail "$name: $(cat err)"
done
cmp -s even.png bands.png && fail "the skin is of one colour"
grep -q '^v .* 1 0 0$' bands.obj || fail "no red in bands.obj"
grep -q '^v .* 0 0 1$' bands.obj || fail "no blue in bands.obj"
coat plane 'rgb(u, 0, 1 - coat.u)' 'grid: 40, 20'
"$CASCADE" run -q plane.cascade -o plane.png || fail "a coat on a plane"
coat wrong 'rgb(r, 0, 1 - coat.u)' 'surface: sphere; cells: 900'
"$CASCADE" run -q wrong.cascade -o wrong.png 2>err && fail "the skin reads cells"
grep -q "'r' is not a parameter of bands" err || fail "the skin reads cells: $(cat err)"

# A body that grew in a volume also shows the pattern, in the coordinates of scripts: a ball around (0.5, 0.5, 0.5).
cat >body.cascade <<'END'
system ball { u: 0.3 - sqrt((x - 0.5)^2 + (y - 0.5)^2 + (z - 0.5)^2); u' = 0 }
cells still { p' += cling(1) }
domain { grid: 24, 24, 24; boundary: noflux }
stage grown: ball { iterations: 1 }
stage stand: still { founders: 6; body: grown.u; duration: 0.1; r: 0.02 }
picture { color: rgb(0, 1, 0); skin: rgb(x > 0.5, 0, x < 0.5) }
END
"$CASCADE" run -q body.cascade -o body.obj -o body.glb --save grown || fail "a body in files"
awk '/^o / { name = $2 }
     name == "body" && $1 == "v" {
         away = sqrt(($2 - 0.5)^2 + ($3 - 0.5)^2 + ($4 - 0.5)^2); ++count
         if (away < 0.295 || away > 0.301) exit 1
         if ($2 > 0.53 && ($5 != 1 || $7 != 0) || $2 < 0.47 && ($5 != 0 || $7 != 1)) exit 1
     }
     END { exit !(count > 500) }' body.obj || fail "the body in body.obj"
"$CASCADE" run -q --resume grown -o again.obj || fail "a body that is resumed"
cmp -s body.obj again.obj || fail "a body that is resumed is another one"

# If no cell is drawn, files contain the surface alone. Without a surface no file is written.
draw bare 'picture { width: 0; color: rgb(1, 0, 0) }' -o bare.glb
grep -q "^o copies" bare.obj && fail "copies of nothing"
grep -q gpu_instancing bare.glb && fail "instances of nothing"
sed 's/surface: sphere/grid: 8, 8, 8/' bare.cascade >nothing.cascade
for name in nothing.obj nothing.glb; do
    "$CASCADE" run -q nothing.cascade -o $name 2>err && fail "$name holds nothing"
    grep -q "it would show nothing" err || fail "$name: $(cat err)"
done

# A model with texture coordinates gets maps that show the cells on it.
cat >square.obj <<'END'
v 0 0 0
v 4 0 0
v 4 0 4
v 0 0 4
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 4/4 3/3 2/2 1/1
END
flat='cells still { p'"'"' += cling(1) }
domain { mesh: "square.obj" }
stage stand: still { founders: 20; duration: 0.1; r: 0.05 }'
printf '%s\n' "$flat" 'picture { shape: thorn; color: rgb(1, 0, 0); skin: rgb(0, 0, 1) }' >maps.cascade
"$CASCADE" run maps.cascade -o maps.glb --bake 64 >out 2>&1 || fail "--bake: $(cat out)"
for name in maps.glb maps_color.png maps_height.png maps_normal.png; do
    grep -q "wrote $name" out && [ -s $name ] || fail "--bake without $name: $(cat out)"
done
"$CASCADE" mesh maps.glb | grep -q "4 points, 2 triangles" || fail "--bake writes more than the model"
sed 's/surface: sphere/surface: creature/' ball.cascade >creature.cascade
"$CASCADE" run -q creature.cascade -o creature.glb --bake 64 || fail "maps of a model without texture coordinates"
"$CASCADE" mesh creature.glb | grep -q "texture" || fail "maps without texture coordinates: $("$CASCADE" mesh creature.glb)"
"$CASCADE" run -q plane.cascade -o plane.glb --bake 64 2>err && fail "maps of a plane"
grep -q "the domain is not a model" err || fail "maps of a plane: $(cat err)"

# A saved run is drawn in other colours and shapes, without taking a step.
"$CASCADE" run -q ball.cascade --save kept -o ball.png || fail "--save"
printf '%s\n' "$cells" '# Another look.' 'shape cone { radius = 1 - t }' 'picture { shape: cone; color: rgb(0, 0, 1) }' \
    >look.cascade
"$CASCADE" run look.cascade --resume kept -o look.png >out 2>&1 || fail "another look: $(cat out)"
"$CASCADE" run -q look.cascade -o wanted.png || fail "look"
cmp -s look.png wanted.png || fail "another look at --resume is another picture"
sed 's/r: 0.1/r: 0.2/' look.cascade >other.cascade
"$CASCADE" run -q other.cascade --resume kept -o other.png 2>err && fail "another radius at --resume"
grep -q "differs from the script of the run" err || fail "another radius: $(cat err)"
exit 0
