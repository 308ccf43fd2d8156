#!/usr/bin/env bash
# Grids with several slices, from the command line to files that other programs read.
set -u
rm -rf ./*

fail() { echo "volume: $*"; exit 1; }

cat >ball.cascade <<'END'
system heat { u: disc(0.5, 0.5, 0.3) * (z < 0.5); u' = 0.1 * lap(u) }
domain { grid: 12, 10, 8; spacing: 1; boundary: noflux }
stage s: heat { iterations: 20 }
END
"$CASCADE" run -q ball.cascade --volume ball.vti --save kept || fail "the run failed"
"$CASCADE" run -q ball.cascade --slice y=0.25 -o side.png || fail "no slice across y"
"$CASCADE" run -q ball.cascade --backend interp --threads 1 --volume other.vti || fail "interp"
cmp -s ball.vti other.vti || fail "another backend, another volume"
"$CASCADE" run -q ball.png -o again.png || fail "the picture does not run again"
cmp -s ball.png again.png || fail "the picture is not itself again"
"$CASCADE" run -q side.png -o again.png || fail "the picture of a slice does not run again"
cmp -s side.png again.png || fail "the picture of a slice is not itself again"
"$CASCADE" run -q --resume kept -o resumed.png || fail "a volume does not resume"
cmp -s ball.png resumed.png || fail "a resumed volume is another one"
for wrong in z y=2 w=0.5 z=x; do
    "$CASCADE" run -q ball.cascade --slice "$wrong" 2>err && fail "--slice $wrong is taken"
    grep -q "is not a slice" err || fail "--slice $wrong: $(cat err)"
done
# Reads the file with a reader that was written from the description of the format.
command -v python3 >/dev/null || exit 0
python3 - <<'END' || fail "the volume file is not what it says"
import re, struct, xml.etree.ElementTree as tree
data = open("ball.vti", "rb").read()
begin = data.index(b"<AppendedData")
block = data.index(b"_", data.index(b">", begin)) + 1
end = data.rindex(b"\n  </AppendedData>")
root = tree.fromstring(data[:begin] + b"</VTKFile>")
image = root.find("ImageData")
assert root.get("type") == "ImageData" and root.get("header_type") == "UInt64"
assert image.get("WholeExtent") == "0 12 0 10 0 8", image.get("WholeExtent")
assert image.get("Spacing") == "1 1 1"
arrays = image.find("Piece").find("CellData").findall("DataArray")
assert [a.get("Name") for a in arrays] == ["u"]
offset = block + int(arrays[0].get("offset"))
size = struct.unpack_from("<Q", data, offset)[0]
assert size == 12 * 10 * 8 * 4 and offset + 8 + size == end
u = struct.unpack_from("<%df" % (size // 4), data, offset + 8)
npy = open("kept/s.u.npy", "rb").read()
assert b"'shape': (8, 10, 12), " in npy
assert struct.unpack("<960f", npy[-960 * 4:]) == u
at = lambda i, j, k: u[(k * 10 + j) * 12 + i]
assert at(5, 4, 0) > at(5, 4, 7) > 0 and at(5, 4, 0) > at(0, 0, 0)
total = sum(u)
start = sum(1 for k in range(8) for j in range(10) for i in range(12)
            if (i + 0.5 - 6) ** 2 + (j + 0.5 - 6) ** 2 < 3.6 ** 2 and k + 0.5 < 6)
assert abs(total - start) < 1e-3 * start, (total, start)
END

# Writes a .vdb file, if this build has OpenVDB. Its contents are tested in tests/openvdb.
if [ -e "$BUILD/libcascade_openvdb.so" ]; then
    "$CASCADE" run -q ball.cascade --volume ball.vdb || fail "no .vdb file"
    "$CASCADE" run -q ball.cascade --backend interp --threads 1 --volume other.VDB || fail "interp"
    cmp -s ball.vdb other.VDB || fail "another backend, another .vdb file"
    mkdir alone && cp "$CASCADE" alone/cascade
    LD_LIBRARY_PATH='' alone/cascade run -q ball.cascade --backend interp --volume none.vdb 2>err &&
        fail "a .vdb file is written without the module"
    grep -q "OpenVDB could not be loaded" err || fail "without the module: $(cat err)"
else
    "$CASCADE" run -q ball.cascade --volume none.vdb 2>err && fail "a .vdb file is written without OpenVDB"
    grep -q "this build has no OpenVDB" err || fail "without OpenVDB: $(cat err)"
fi
[ ! -e none.vdb ] || fail "a refused .vdb file is left"

# A body in pictures and in model files, on which a pattern then grows.
cat >body.cascade <<'END'
domain { grid: 20, 20, 20; boundary: noflux }
system ball { u: 0.3 - sqrt((x - 0.5)^2 + (y - 0.5)^2 + (z - 0.5)^2); u' = 0 }
stage grown: ball { iterations: 1 }
picture { body: u; color: palette(z, 0, 1, "coral") }
END
"$CASCADE" run -q body.cascade -o body.png -o body.ply -o body.obj -o body.glb -o body.vtp -o body.stl || fail "no body"
"$CASCADE" run -q body.png -o again.png || fail "the picture of a body does not run again"
cmp -s body.png again.png || fail "the picture of a body is not itself again"
for model in ply obj glb stl; do
    "$CASCADE" mesh "body.$model" >facts || fail "body.$model is not read"
    grep -q "closed" facts || fail "body.$model: $(cat facts)"
done
echo 'system_name: turing_spots; iterations: 10' >coat.cascade
"$CASCADE" run -q body.cascade --lods 2 -o levels.glb || fail "no levels of a body"
"$CASCADE" mesh levels_lod1.glb | grep -q closed || fail "a level of a body is not closed"
"$CASCADE" run -q coat.cascade --mesh body.ply --cells 400 -o coat.png || fail "nothing grows on a body"
"$CASCADE" run -q body.cascade --flat -o slice.png || fail "no slice of a body"
"$CASCADE" run -q body.cascade --turntable 2 -o turn.png || fail "a body does not turn"
[ -e turn-002.png ] || fail "no second picture of a turntable"
for wrong in '-o cells.npz' '-o baked.glb --bake 64' '--retile -o a.ply' '--bump 0.1'; do
    # shellcheck disable=SC2086
    "$CASCADE" run -q body.cascade $wrong 2>err && fail "$wrong is taken for a body"
    grep -q "error" err || fail "$wrong: $(cat err)"
done
sed 's/body: u/body: u - 1/' body.cascade >empty.cascade
"$CASCADE" run empty.cascade -o empty.png >out 2>&1 || fail "an empty body fails"
grep -q "the body of the picture is empty" out || fail "an empty body is not noticed: $(cat out)"
"$CASCADE" run -q empty.cascade -o none.ply 2>err && fail "an empty body is written"
[ ! -e none.ply ] || fail "an empty model is left"

# Options that do not apply to a plane are refused.
echo 'system_name: turing_spots' > plane.cascade
for option in '--slice z=0.2' --flat '--view 10,20' '--quality fine' '--light studio' '--fov 40' '--ground no' '--background none'; do
    # shellcheck disable=SC2086
    "$CASCADE" run -q plane.cascade $option 2>err && fail "$option is taken for a plane"
    grep -qE "this domain is a plane, which has no slices|the domain is not a surface" err || fail "$option: $(cat err)"
    [ ! -e plane.png ] || fail "$option left a picture"
done
# The picture of a plane fits into the size of `--size`.
"$CASCADE" run -q plane.cascade --grid 12x8 --size 90 2>err || fail "a smooth picture: $(cat err)"
[ "$(od -An -j16 -N8 -tu1 plane.png | tr -s ' ')" = " 0 0 0 90 0 0 0 60" ] || fail "a smooth picture has another size"
exit 0
