#!/bin/bash
# Runs on models from the command line: every kind of output file is written and read again.
set -u
rm -rf ./*
about=model_run
. "$SOURCE/tests/support/program_runs.bash"

# Checks arrays with NumPy if it is installed.
numpy() {
    local name
    for name in python3 /usr/bin/python3; do
        if $name -c 'import numpy' 2>/dev/null; then
            $name -
            return
        fi
    done
}

cat > spots.cascade <<'END'
stage spots: gray_scott { iterations: 40 }
END
write_square
model="run -q spots.cascade --mesh creature --cells 600"

# Several outputs of one run, in formats chosen by the endings of names.
run 0 ${model/-q /} -o one.png -o m.ply -o m.obj -o m.glb -o m.vtp -o m.cells.vtp -o m.npz
for name in one.png m.ply m.obj m.glb m.vtp m.cells.vtp m.npz; do
    says out "wrote $name"
    [ -s $name ] || fail "$name is not there"
done
for name in m.ply m.obj m.glb; do
    cp out before
    run 0 mesh $name
    says out "closed like a sphere"
done
numpy <<'END' || fail "m.npz or m.cells.vtp is wrong"
import numpy
a = numpy.load("m.npz")
n = len(a["points"])
assert n == 600 and a["areas"].shape == (n,) and a["normals"].shape == (n, 3)
assert set(["u", "v", "colors"]) <= set(a.files) and "shown" not in a.files, a.files
assert a["links"].max() < n and len(a["weights"]) == len(a["links"])
assert 0 <= a["v"].min() < a["v"].max() < 1
assert abs(numpy.linalg.norm(a["normals"], axis=1) - 1).max() < 1e-6
head = open("m.cells.vtp", "rb").read(2000)
assert b'NumberOfPoints="600"' in head and b'NumberOfPolys="0"' in head, head
END

# A coarse model is refined to as many points as colours need. With --retile the points are the cells.
run 0 $model -o tiled.ply --retile --show 'u - v'
run 0 mesh tiled.ply
says out "600 points,"
numpy <<'END' || fail "the points of the re-tiled model are not the cells"
import numpy
data = open("tiled.ply", "rb").read()
head, body = data.split(b"end_header\n", 1)
sizes = {"float": "<f4", "double": "<f8", "uchar": "u1"}
fields, count = [], 0
for line in head.decode().split("\n"):
    words = line.split()
    if words[:2] == ["element", "vertex"]: count = int(words[2])
    elif words[:1] == ["element"]: break
    elif words[:1] == ["property"]: fields.append((words[2], sizes[words[1]]))
points = numpy.frombuffer(body, numpy.dtype(fields), count)
a = numpy.load("m.npz")
at = numpy.stack([points[c] for c in "xyz"], 1)
assert numpy.abs(at - a["points"]).max() < 1e-5
assert numpy.array_equal(points["v_"] if "v_" in points.dtype.names else points["v"], a["v"])
assert numpy.allclose(points["shown"], a["u"] - a["v"], atol=1e-6)
assert len(set(points["red"])) > 20
END

# Baked maps, in the model and beside it.
run 0 run -q spots.cascade --mesh square.obj --cells 300 --bake 64 -o square.glb
[ ! -e square_height.png ] || fail "heights without --bump"
run 0 run spots.cascade --mesh square.obj --cells 300 --bake 64 --bump 0.05 -o square.glb
for name in square.glb square_color.png square_height.png square_normal.png; do
    says out "wrote $name"
done
run 0 mesh square.glb
says out "4 points, 2 triangles"
# A model without texture coordinates gets some in all its files. Other models keep theirs, except with --unwrap.
run 0 $model --bake 256 -o creature.glb -o creature.obj -o creature.ply
for file in creature.glb creature.obj creature.ply; do
    run 0 mesh $file
    says out "texture coordinates: "
    says out "closed like a sphere"
    grep -q "several times\|mirrored" out && fail "the texture coordinates of $file overlap"
done
run 0 $model -o plain.glb
run 0 mesh plain.glb
grep -q "texture coordinates" out && fail "texture coordinates that nobody asked for"
run 0 $model --unwrap -o plain.glb -o other.vtp
run 0 mesh plain.glb
says out "texture coordinates: "
run 0 $model --threads 1 --bake 256 -o one.glb
run 0 $model --threads 3 --bake 256 -o three.glb
cmp -s one.glb three.glb || fail "texture coordinates depend on the number of threads"
run 0 run -q spots.cascade --mesh square.obj --cells 300 -o square.ply
run 0 mesh square.ply
says out "1 chart, 100.0 % of the texture covered"
run 0 run -q spots.cascade --mesh square.obj --cells 300 --unwrap -o square.ply
run 0 mesh square.ply
says out "1 chart, 9"
run 2 $model --unwrap -o none.vtp
says err "--unwrap needs a model file with texture coordinates, but none is written"
run 2 $model --unwrap --retile -o none.ply
says err "the triangles of --retile have no texture coordinates"
run 2 run spots.cascade --unwrap -o none.glb --bake 64
says err "the domain is not a model"
# Overlapping coordinates are reported.
cat > tiles.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 2 0
vt 2 1
vt 0 1
f 1/1 2/2 3/3 4/4
END
run 0 run spots.cascade --mesh tiles.obj --cells 300 --bake 64 -o tiles.glb
says err "100.0 % of the texture belongs to several parts of the model, over which the picture repeats"
says err "--unwrap gives each part another place in the texture"
run 0 run spots.cascade --mesh tiles.obj --cells 300 --bake 64 --unwrap -o tiles.glb
grep -q "several parts" err && fail "coordinates of ours overlap"
# A model far from the origin is moved in an STL file, by the same distance in all levels.
sed 's/^v \([01]\) \([01]\) /v 40300\1.0\1 360490\2.7\2 /' square.obj > far.obj
run 0 run spots.cascade --mesh far.obj --cells 300 -o far.stl --lods 2
says err "in 'far.stl' the model is moved by -403000"
run 0 mesh far.stl
says out "1 boundary, Euler characteristic 1"
run 0 run spots.cascade --mesh far.obj --cells 300 -o far.ply
grep -q moved err && fail "a PLY file holds all digits"
# Texture coordinates that all coincide, or cover less than a sample, are refused before the first step.
sed 's/iterations: [0-9]*/iterations: 100000000/' spots.cascade > long.cascade
cmp -s long.cascade spots.cascade && fail "no script of many steps"
for spot in 0 0.0001; do
    sed "s/^vt 2 0/vt $spot 0/; s/^vt 2 1/vt $spot $spot/; s/^vt 0 1/vt 0 $spot/" tiles.obj > spot.obj
    run 3 run long.cascade --mesh spot.obj --cells 300 --bake 64 -o spot.glb
    says err "the model's texture coordinates have no area in the texture"
    says err "use --unwrap to make new ones"
    run 0 run -q spots.cascade --mesh spot.obj --cells 300 --bake 64 --unwrap -o spot.glb
done

# Levels of detail: each has a file, and the first GLB file contains all levels.
run 0 $model --lods 3 -o lods.glb -o lods.ply
for name in lods.glb lods_lod1.glb lods_lod2.glb lods.ply lods_lod1.ply lods_lod2.ply; do
    [ -s "$name" ] || fail "no $name"
done
levels=$(for k in '' _lod1 _lod2; do
    "$CASCADE" mesh lods$k.ply | sed -n 's/,//g; s/.* points \([0-9]*\) triangles.*/\1/p'
done | paste -sd' ')
python3 -c 'import sys
a, b, c = map(int, sys.argv[1:])
assert abs(4 * b - a) < 12 and abs(4 * c - b) < 12' $levels || fail "levels of $levels triangles"
run 0 $model --lods 2 --bake 64 -o maps.glb
for name in maps.glb maps_color.png maps_lod1.glb maps_lod1_color.png maps_lod1_normal.png; do
    [ -s "$name" ] || fail "no $name"
done
run 0 mesh maps_lod1.glb
says out "texture coordinates: "
# OpenEXR: heights are lengths and have the range in the text of the PNG file.
run 0 $model --bump 0.1 --bake 64 --exr -o lengths.glb
for name in lengths.glb lengths_color.exr lengths_height.exr lengths_normal.exr; do
    [ -s "$name" ] || fail "no $name"
done
[ ! -e lengths_color.png ] || fail "maps in two formats"
run 2 $model --exr -o lengths.glb
says err "--exr needs maps, but no maps are written"
# An animated model has a moment for each interval and one for the start.
run 0 run -q spots.cascade --mesh creature --cells 600 --animate -o grows.glb --fps 5
grep -qa '"animations"' grows.glb || fail "nothing moves"
run 0 mesh grows.glb
run 2 $model --animate -o grows.ply
says err "--animate needs a model that can be animated, but none is written"
run 2 $model --animate -o grows.glb --bake 64
says err "a model with maps cannot be animated"
run 2 run -q spots.cascade --animate -o grows.glb
says err "the domain is not a model"
# Levels with --retile: each has a quarter of the points of the previous level, and a few points of the model that could
# not be removed.
run 0 $model --retile --lods 3 -o tiles.obj
points() { grep '^v ' "$1" | cut -d ' ' -f 2-4 | sort; }
for pair in 'tiles tiles_lod1 150' 'tiles_lod1 tiles_lod2 37'; do
    read -r fine coarse count <<< "$pair"
    others=$(comm -13 <(points "$fine.obj") <(points "$coarse.obj") | wc -l)
    [ "$others" -le 8 ] || fail "$others points of $coarse are not those of $fine"
    [ $(($(points "$coarse.obj" | wc -l) - others)) = "$count" ] || fail "$coarse has other points"
done
# Maps whose size follows from the size of cells.
run 0 run spots.cascade --mesh square.obj --cells 300 --texels-per-cell 2 -o fitting.glb
says err "maps of 64 texels: a cell is 3.7 texels wide"
run 2 $model --texels-per-cell 2 -o fitting.png
says err "this option writes maps of a model, but no such model is written"
# The surface moves by its heights with --displace, and only then.
run 0 $model -o level.ply
run 0 $model --bump 0.1 -o level_too.ply
cmp -s level.ply level_too.ply || fail "--bump moves a model"
run 0 $model --bump 0.1 --displace --bake 64 -o raised.glb -o raised.ply
cmp -s level.ply raised.ply && fail "--displace moves nothing"
[ ! -e raised_height.png ] && [ ! -e raised_normal.png ] || fail "heights twice"
run 0 $model --bump 0.1 -o bumpy.png
run 0 $model --bump 0.1 --displace -o raised.png
cmp -s bumpy.png raised.png && fail "--displace changes no picture"
run 0 run -q raised.png -o again.png
cmp -s raised.png again.png || fail "a displaced picture is not drawn again byte for byte"
run 2 $model --displace -o raised.ply
says err "the surface has no heights"
run 2 $model --lods 3 -o lods.png
says err "no model is written"
run 2 run -q spots.cascade --lods 3 -o lods.glb --bake 64
says err "the domain is not a model"
run 3 $model --lods 2 -o lods.glb -o lods_lod1.glb
says err "the model and the model would both be written to"
run 64 $model --lods 1 -o lods.glb
says err "whole number from 2 to 8"

# Options of pictures are stored in them and change them.
run 0 $model -o plain.png --view 40,10
run 0 $model -o turned.png --view 40,10 --up z --bump 0.03 --palette viridis
cmp -s plain.png turned.png && fail "--up and --bump change nothing"
run 0 run -q turned.png -o again.png
cmp -s turned.png again.png || fail "a picture of a model is not drawn again byte for byte"
run 0 $model -o flat.png --view 40,10 --up z --palette viridis
cmp -s flat.png turned.png && fail "--bump changes nothing"
# Size, camera and quality are stored in pictures and change them, too.
run 0 $model -o wide.png --size 210x90 --quality draft --fov 60 --ground no --background '#204060'
[ "$(od -An -t x1 -j 16 -N 8 wide.png | tr -d ' ')" = 000000d20000005a ] || fail "--size 210x90 draws another size"
run 0 run -q wide.png -o again.png
cmp -s wide.png again.png || fail "a picture with a size of its own is not drawn again byte for byte"
for other in '--quality fine' '--light outdoors' '--fov 20' '--ground yes' '--background none'; do
    run 0 run -q wide.png -o other.png $other
    cmp -s wide.png other.png && fail "$other changes nothing"
done
# --up changes positions in scripts and pictures, but no coordinates in written files.
run 0 $model --up z -o up.ply -o up.npz
run 0 mesh m.ply
grep size out > before
run 0 mesh up.ply
grep size out > after
cmp -s before after || fail "--up turns a model that is written"
numpy <<'END' || fail "--up turns cells that are written"
import numpy
a, b = numpy.load("m.npz")["points"], numpy.load("up.npz")["points"]
for end in (numpy.min, numpy.max):
    assert numpy.abs(end(a, axis=0) - end(b, axis=0)).max() < 0.1
END
run 0 $model -o round.png --turntable 3
[ ! -e round.png ] || fail "a turntable has no picture without a number"
run 0 run -q round-002.png -o again.png
cmp -s round-002.png again.png || fail "a picture of a turntable is not drawn again"
cmp -s round-001.png round-002.png && fail "the turntable does not turn"
[ "$(ls round-*.png | wc -l)" = 3 ] || fail "a turntable of 3"
run 0 $model --set spots.interval=20 --frames film --bump 0.02 -o end.png
[ "$(ls film | grep -c png)" = 3 ] || fail "frames on a model"

# Results do not depend on threads.
run 0 $model --threads 1 -o t1.npz -o t1.glb
run 0 $model --threads 3 -o t3.npz -o t3.glb
cmp -s t1.npz t3.npz && cmp -s t1.glb t3.glb || fail "files depend on the number of threads"

# Cells stored by --cache.
run 0 ${model/-q /} --cache kept -o a.npz
says err "kept the cells in kept/"
run 0 ${model/-q /} --cache kept -o b.npz
says err "took the cells from kept/"
cmp -s a.npz b.npz && cmp -s a.npz t1.npz || fail "kept cells give other results"
[ "$(ls kept | wc -l)" = 1 ] || fail "one file of cells"
printf x >> "$(echo kept/*)"
run 0 ${model/-q /} --cache kept -o b.npz
says err "kept the cells in kept/"
run 0 ${model/-q /} --cache spots.cascade -o b.npz
says err "the cells are not kept: "
cmp -s a.npz b.npz || fail "cells that cannot be kept give other results"

# Options that exclude each other are refused before anything is computed.
refused() {
    local message=$1
    shift
    rm -f refused.*
    run 2 "$@"
    says err "$message"
    [ "$(grep -c 'error:' err)" = 1 ] || fail "one message for $*"
    ls refused.* >/dev/null 2>&1 && fail "something was written by $*"
}
for name in refused.ply refused.obj refused.glb refused.vtp refused.npz refused.cells.vtp; do
    refused "only models can be written to such files" run -q spots.cascade -o $name
done
refused "this setting needs a domain with a model" run -q spots.cascade -o refused.png --up z
for option in "--retile" "--bump 0.1" "--cache kept2"; do
    refused "the domain is not a model" run -q spots.cascade -o refused.png $option
done
refused "this option writes maps of a model, but no such model is written" run -q spots.cascade -o refused.png --bake 64
refused "the domain is not a surface" run -q spots.cascade -o refused.png --turntable 4
[ ! -e kept2 ] || fail "a folder was made for a plane"
refused "--retile needs a model, but no model is written" $model -o refused.png --retile
refused "--retile needs a model, but no model is written" $model -o refused.npz --retile
refused "this option writes maps of a model, but no such model is written" $model -o refused.ply --bake 64
refused "--turntable needs a picture or a film, but none is requested" $model -o refused.ply --turntable 4
refused "the cells of a model have no rows and columns" $model -o refused.png --flat
refused "the cells of a model have no rows and columns" $model -o refused.png --sheet refused.s.png
refused "the cells of a model have no rows and columns" $model -o refused.png --volume refused.vti
refused "the cells of a model have no rows and columns" $model -o refused.png --features
refused "the cells of a model have no rows and columns" $model -o refused.png --space-time
run 3 $model -o twice.png -o ./twice.png
says err "the picture and the picture would both be written to"
run 3 $model -o no/such/folder.ply
says err "no/such"
run 3 $model -o big.png --scale 64
says err "at scale 64 has more than"
run 3 $model -o big.png --size 100000x100000
says err "a picture of 100000 × 100000 pixels has more than 268435456 pixels"
says err "use a smaller --size"
run 64 $model -o m.fbx
says err "'m.fbx' has an ending that Cascade cannot write"
run 64 $model --bump 2
says err "'2' is not a number from -1 to 1"
run 64 $model --bump nan
says err "'nan' is not a number from -1 to 1"
run 64 $model --up w
says err "'w' is not one of x, y, z"
run 64 $model --bake 9000
says err "whole number from 1 to 8192"

# A sweep draws a picture of each run, and measures features that need no rows and columns.
run 0 sweep spots.cascade --mesh sphere --cells 60 --vary seed=1,2 -o sweep
says out "wrote sweep/sheet.png"
[ "$(wc -l <sweep/features.csv)" = 3 ] || fail "sweep/features.csv: $(cat sweep/features.csv)"
[ "$(sed 1d sweep/features.csv | cut -d, -f2- | sort -u | wc -l)" = 2 ] || fail "two seeds give one pattern"

# Models that cannot be used: one message, nothing written.
: > empty.ply
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n' > broken.obj
for name in empty.ply broken.obj missing.ply; do
    refused "error:" run -q spots.cascade --mesh $name --cells 50 -o refused.png -o refused.ply
done

# Ctrl-C while cells are made: nothing is written, and the status is that of Ctrl-C.
cat > many.cascade <<'END'
stage spots: gray_scott { iterations: 10 }
END
timeout --preserve-status -s INT 3 "$CASCADE" run many.cascade --mesh creature --cells 3000000 \
    -o many.png >out 2>err </dev/null
got=$?
[ $got = 130 ] || fail "Ctrl-C while cells are made gave $got"
says err "nothing has been written"
[ ! -e many.png ] || fail "a picture of cells that were never made"
run 124 run many.cascade --mesh creature --cells 3000000 -o many.png --limit-time 1s
says err "the limit of 1 s is reached at making the model's cells; nothing has been written"

# Ctrl-C while a picture is drawn: this picture is left out, and the other outputs are written.
cat > ball.cascade <<'END'
stage spots: gray_scott { iterations: 10 }
domain { grid: 64, 32; surface: (2 + cos(2 * pi * sy)) * cos(2 * pi * sx), (2 + cos(2 * pi * sy)) * sin(2 * pi * sx), sin(2 * pi * sy) }
END
timeout --preserve-status -s INT 5 "$CASCADE" run ball.cascade --size 12000x9000 --quality fine -o ball.png \
    --save ball_run >out 2>err </dev/null
got=$?
[ $got = 130 ] || fail "Ctrl-C while a picture is drawn gave $got"
says err "interrupted at the drawing of ball.png; the results so far have been written"
[ ! -e ball.png ] || fail "a picture that was not finished is written"
[ -e ball_run/run.json ] || fail "Ctrl-C in a picture prevents the saved run"

# The prompt.
printf '%s\n' 'domain { surface: sphere; cells: 300 }' 'stage spots: gray_scott { iterations: 40 }' ':run 10' \
    ':set spots.feed=0.03' ':run 5' ':show v' ':save kept_run' > lines
"$CASCADE" repl <lines >out 2>err || fail "the prompt fails on a model"
says out "stage 'spots', step 10 of 40"
says out "stage 'spots', step 15 of 40"
[ -s kept_run/spots.v.npy ] || fail "the prompt saves nothing"
exit 0
