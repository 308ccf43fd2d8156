#!/bin/bash
# `cascade mesh`: models of every kind and the facts that it prints.
set -u
about=mesh
. "$SOURCE/tests/support/program_runs.bash"

cat > cube.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END
run 0 mesh cube.obj
says out "8 points, 12 triangles, 1 connected component"
says out "closed like a sphere, Euler characteristic 2"
says out "size 1 × 1 × 1, area 6"
[ "$(wc -l < out)" = 4 ] || fail "a cube has nothing else to say"

# Points that a script can use: the extremes of the cube, and its corners.
run 0 mesh cube.obj --points
says out "left     0.0000, "
says out "tip 1 "
tip=$(sed -n 's/^ *tip 1 *//p' out)
printf 'domain { mesh: "cube.obj"; cells: 400 }\nsystem s { u: distance(%s); u%s = 0 * u }\nstage a: s { iterations: 1 }\n' \
    "$tip" "'" > at_tip.cascade
"$CASCADE" run -q at_tip.cascade -o at_tip.png --save at_tip 2>err || fail "a printed point is none of the surface: $(cat err)"

# Cells: their areas add up to the cube's, and the seed chooses their positions.
run 0 mesh cube.obj --cells 600
says out "600 cells of mean area 0.01,"
cp out first
run 0 mesh cube.obj --cells 600 --seed 1
cmp -s out first || fail "seed 1 is the default"
run 0 mesh cube.obj --cells 600 --seed 2
cmp -s out first && fail "another seed gives the same cells"
run 64 mesh cube.obj --seed 2
says err "--seed has no effect without a number of --cells"
# Texture coordinates in written files, which are read again.
run 0 mesh cube.obj --unwrap
says out "made texture coordinates: "
for file in new.glb new.obj new.ply; do
    run 0 mesh cube.obj --unwrap -o $file
    says out "written to $file"
    run 0 mesh $file
    says out "12 triangles, 1 connected component"
    says out "texture coordinates: "
    grep -q "several times\|mirrored" out && fail "the texture coordinates of $file overlap"
done
# The repaired model, written unchanged, refined and simplified.
for file in same.glb same.obj same.ply same.stl; do
    run 0 mesh cube.obj -o $file
    run 0 mesh $file
    says out "12 triangles, 1 connected component"
    says out "closed like a sphere"
done
run 0 mesh cube.obj --subdivide 3 -o round.ply
says out "subdivided: 386 points, 768 triangles"
run 0 mesh round.ply --simplify 100
says out "simplified: 52 points, 100 triangles"
run 0 mesh new.ply --subdivide 2 --simplify 96 --unwrap -o both.glb
says out "simplified: 50 points, 96 triangles, without its texture coordinates"
says out "made texture coordinates: "
run 0 mesh new.ply --subdivide 1 -o fine.ply
run 0 mesh fine.ply
says out "texture coordinates: "
# Colours and numbers of the file are kept if the output format has them, otherwise their omission is reported.
cat > coloured.ply <<'END'
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property float nx
property float ny
property float nz
property uchar red
property uchar green
property uchar blue
property float u
property float warmth
element face 4
property list uchar int vertex_indices
end_header
0 0 0 0 0 1 255 0 7 0.5 1
1 0 0 0 0 1 1 2 3 0.25 2
0 1 0 0 0 1 128 64 32 0.125 3
0 0 1 0 0 1 0 200 254 1 -4
3 0 2 1
3 0 1 3
3 1 2 3
3 0 3 2
END
cat > colours.py <<'END'
import subprocess, sys
want = [(255, 0, 7), (1, 2, 3), (128, 64, 32), (0, 200, 254)]
head, body = open(sys.argv[1], "rb").read().split(b"end_header\n", 1)
names = [line.split()[-1].decode() for line in head.splitlines() if line.startswith(b"property") and b"list" not in line]
import struct
types = "".join({b"float": "f", b"uchar": "B", b"double": "d"}[line.split()[1]] for line in head.splitlines() if line.startswith(b"property") and b"list" not in line)
step = struct.calcsize("<" + types)
rows = [dict(zip(names, struct.unpack_from("<" + types, body, step * k))) for k in range(4)]
assert [(r["red"], r["green"], r["blue"]) for r in rows] == want, rows
for name, values in ("u_", [0.5, 0.25, 0.125, 1]), ("warmth", [1, 2, 3, -4]):
    if "numbers" in sys.argv: assert [r[name] for r in rows] == values, rows
assert not {"nx_", "red_"} & set(names), names
END
run 0 mesh coloured.ply -o kept.ply
grep -q "without" out && fail "a PLY file holds everything"
command -v python3 >/dev/null && { python3 colours.py kept.ply numbers || fail "colours and numbers of kept.ply"; }
for ending in obj glb; do
    run 0 mesh coloured.ply -o kept.$ending
    says out "without u, warmth, which .$ending files cannot hold"
    run 0 mesh kept.$ending -o again.ply
    says out "attributes red, green, blue"
    command -v python3 >/dev/null && { python3 colours.py again.ply || fail "colours of kept.$ending"; }
done
run 0 mesh coloured.ply -o kept.vtp
grep -qa 'Name="warmth"' kept.vtp || fail "numbers in a .vtp"
grep -qa 'Name="color"' kept.vtp || fail "colours in a .vtp"
run 0 mesh coloured.ply -o kept.stl
says out "without its colours, which .stl files cannot hold"
says out "without u, warmth, which .stl files cannot hold"
run 0 mesh new.ply -o kept.stl
says out "without its texture coordinates, which .stl files cannot hold"
run 0 mesh coloured.ply --subdivide 2 --simplify 20 -o fewer.ply
run 0 mesh fewer.ply
says out "attributes nx, ny, nz, red, green, blue, u_, warmth"
printf 'COFF\n3 1 0\n0 0 0 255 0 7 255\n1 0 0 1 2 3 255\n0 1 0 128 64 32 255\n3 0 1 2\n' > colours.off
run 0 mesh colours.off -o colours.obj
grep -q "^v 1 0 0 0.00392157 0.00784314 0.0117647" colours.obj || fail "colours of an OFF file"
# A model far from the origin is moved in an STL file, which is reported.
sed 's/^v \([01]\) \([01]\) /v 40300\1.0\1 -360490\2.7\2 /' cube.obj > far.obj
run 0 mesh far.obj -o far.stl
says out "in 'far.stl' the model is moved by -403000"
run 0 mesh far.stl
says out "8 points, 12 triangles, 1 connected component"
run 0 mesh far.obj -o far.ply
grep -q moved out && fail "a PLY file holds all digits"
run 0 mesh cube.obj --simplify 50
says out "not simplified: it has no more triangles than requested"
run 0 mesh round.ply --simplify 1
says out "fewer would change its connections or fold it"
run 3 mesh cube.obj round.ply --subdivide 8
says err "50,331,648 triangles would be made, more than the limit of 16,777,216 triangles"
run 64 mesh cube.obj --subdivide 0
says err "--subdivide"
run 64 mesh cube.obj -o same.off
says err "'same.off' does not end in .ply, .obj, .glb, .vtp or .stl"
run 64 mesh cube.obj new.obj --unwrap -o newer.glb
says err "-o takes the file of one model, but several models are given"
run 64 mesh cube.obj --unwrap -o new.vtp
says err "'new.vtp' cannot hold texture coordinates"
run 3 mesh cube.obj --unwrap -o nowhere/new.glb
says err "nowhere"
run 0 mesh cube.obj --cells faces
says out "6 cells of mean area 1, deviation 0.0 %, 4.00 neighbours each"
says out "the nearest neighbour 1 away, deviation 0.0 %"
run 0 mesh cube.obj --cells vertices
says out "8 cells of mean area 0.75, deviation 0.0 %, 3.00 neighbours each"
run 64 mesh cube.obj --cells faces --seed 2
says err "--seed has no effect without a number of --cells"
run 64 mesh cube.obj --cells edges
says err "or write 'faces' or 'vertices'"
run 3 mesh cube.obj --cells 1000000000
says err "1,000,000,000 cells need about 900 GB, but"
sed 's/^f 5 6 7 8$//; s/^f 1 2 6 5$//; s/^f 2 3 7 6$//; s/^f 3 4 8 7$//; s/^f 4 1 5 8$//' cube.obj > parts.obj
printf 'v 9 0 0\nv 9 1 0\nv 9 0 1\nf 9 10 11\n' >> parts.obj
run 3 mesh parts.obj --cells 1
says err "'parts.obj': 1 cell cannot cover a surface of 2 separate parts"

# Several models: a broken one does not prevent the output for the others.
head -n 12 cube.obj > open.obj
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n' > broken.obj
run 3 mesh open.obj broken.obj cube.obj
says out "1 boundary, Euler characteristic 1"
says out "closed like a sphere"
says err "'broken.obj': face 1 of the OBJ file names a point that does not exist"

: > empty.ply
for name in empty.ply nothing.ply picture.png; do run 3 mesh $name; done
run 3 mesh empty.ply
says err "'empty.ply': the file is empty"
run 3 mesh picture.png
says err "is not a model"
run 64 mesh
says err "a model is missing"

# Any file gets an answer.
for seed in 1 2 3; do
    for model in cube.obj open.obj; do
        for ending in obj off stl ply gltf glb; do
            python3 - "$model" "mangled.$ending" "$seed" <<'END'
import random, sys
data = bytearray(open(sys.argv[1], "rb").read())
chance = random.Random(sys.argv[2] + sys.argv[3])
for _ in range(chance.randint(1, 12)):
    at = chance.randrange(len(data))
    data[at:at + chance.randint(0, 3)] = bytes(chance.choice(b"0123456789 -/\nvfe.") for _ in range(chance.randint(0, 3)))
open(sys.argv[2], "wb").write(data)
END
            timeout 20 "$CASCADE" mesh "mangled.$ending" > out 2> err
            got=$?
            [ $got = 0 ] || [ $got = 3 ] || fail "a mangled $ending file gave $got"
        done
    done
done
exit 0
