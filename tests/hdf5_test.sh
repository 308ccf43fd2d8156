#!/usr/bin/env bash
# Series and sweeps in HDF5 files, read by h5py: fields, axes, times and parameters; files of runs that are stopped,
# killed at single writes (SIGKILL by strace) or on a full disk. `KILLS=500 ctest -R hdf5` kills 500 times.
set -u
rm -rf ./*

about="hdf5"
source "$SOURCE/tests/support/program_runs.bash"
kills=${KILLS:-6}

cat >two.cascade <<'END_OF_SCRIPT'
domain { grid: 12, 8; spacing: 0.5; seed: 7 }
stage large: turing_spots { iterations: 30; ka: 1/80 }
stage coral: gray_scott { iterations: 20; interval: 5; speed: 0.2 }
END_OF_SCRIPT
series=(-q --threads 1 --backend interp --no-kernel-cache -o picture.png --series growth.h5)

if [ ! -e "$BUILD/libcascade_hdf5.so" ]; then
    run 3 run two.cascade "${series[@]}"
    grep -q "this build has no HDF5" err || fail "without HDF5: $(cat err)"
    [ ! -e growth.h5 ] || fail "a refused file is left"
    exit 0
fi
mkdir alone && cp "$CASCADE" alone/cascade
LD_LIBRARY_PATH='' alone/cascade run two.cascade "${series[@]}" 2>err && fail "written without the module"
grep -q "HDF5 could not be loaded" err || fail "without the module: $(cat err)"
run 2 run two.cascade "${series[@]}" --field u/v
grep -q "'u/v' cannot be the name of a dataset" err || fail "a name with a slash: $(cat err)"
run 2 run two.cascade "${series[@]}" --field time=u
grep -q -- "--field 'value=u' gives the field another name" err || fail "the name of an axis: $(cat err)"
run 2 run two.cascade "${series[@]}" --field 'w=u' --field 'w=v'
grep -q "two fields are called 'w'" err || fail "a name twice: $(cat err)"

for python in python3 /usr/bin/python3; do
    "$python" -c 'import h5py' 2>/dev/null && break
    python=
done
[ -n "$python" ] || { echo "hdf5: h5py is not there"; exit 77; }

# The same numbers as in arrays of NumPy, on every kind of domain.
cat >compare.py <<'END'
import json, sys
import h5py, numpy
import xml.etree.ElementTree as xml

name, fields, axes = sys.argv[1], sys.argv[2].split(","), sys.argv[3].split(",")
array = numpy.load(name + ".npy")
about = json.load(open(name + ".json"))
moments = about["moments"]
with h5py.File(name + ".h5", "r") as file:
    for k, field in enumerate(fields):
        data = file[field]
        assert data.dtype == array.dtype and data.maxshape[0] is None and data.chunks
        assert numpy.array_equal(data[:], array[:, k] if len(fields) > 1 else array, equal_nan=True)
        assert [list(dim.keys()) for dim in data.dims] == [["time"]] + [[axis] for axis in axes]
    for key in ("time", "t", "step"):
        assert numpy.array_equal(file[key][:], [moment[key] for moment in moments]), key
    names = file["stage"].attrs["flag_meanings"].split()
    assert [names[k] for k in file["stage"][:]] == [moment["stage"] for moment in moments]
    assert file["script"][()].decode() == open(name + ".cascade").read()
    for axis, cells in zip(axes, array.shape[1 if len(fields) == 1 else 2 :]):
        places = file[axis][:] if axis == "cell" else file[axis][:] / about["spacing"] - 0.5
        assert numpy.array_equal(places, numpy.arange(cells)), axis
    if axes == ["cell"]:
        radius = numpy.sqrt(sum((file[axis][:] - file[axis][:].mean()) ** 2 for axis in "xyz"))
        assert radius.std() < 0.05 * radius.mean(), radius
    if name == "two":
        assert numpy.float32(file["stages/large"].attrs["ka"]) == numpy.float32(1 / 80)
        assert file["stages/coral"].attrs["speed"] == numpy.float32(0.2)
        assert file["stages/coral"].attrs["system"] == "gray_scott"
        assert file.attrs["seed"] == 7 and file.attrs["spacing"] == 0.5

# The XDMF file has a grid for each moment, whose slabs lie in the datasets.
grids = xml.parse(name + ".xdmf").getroot().findall("Domain/Grid/Grid")
assert [float(grid.find("Time").get("Value")) for grid in grids] == [m["time"] for m in moments]
with h5py.File(name + ".h5", "r") as file:
    for moment, grid in enumerate(grids):
        for attribute in grid.findall("Attribute"):
            slab, data = attribute.find("DataItem").findall("DataItem")
            path, dataset = data.text.split(":")
            slab = [int(number) for number in slab.text.split()]
            rank = len(slab) // 3
            assert path == name + ".h5" and len(file[dataset].shape) == rank
            assert slab == [moment] + [0] * (rank - 1) + [1] * rank + [1, *file[dataset].shape[1:]]
END
echo 'domain { grid: 9, 1; precision: double } stage s: gray_scott { iterations: 4; interval: 2 }' >line.cascade
echo 'domain { grid: 5, 4, 3 } stage s: gray_scott { iterations: 4; interval: 2; speed: 0.1 }' >volume.cascade
echo 'domain { grid: 8, 6; mask: x < 0.7 } stage s: gray_scott { iterations: 2 }' >mask.cascade
echo 'domain { surface: sphere; cells: 60 } stage s: gray_scott { iterations: 2 }' >model.cascade
compare() {
    local name=$1 fields=$2 axes=$3
    local options=()
    for field in ${fields//,/ }; do options+=(--field "$field"); done
    run 0 run "$name.cascade" -q --backend interp -o "$name.png" --size 16 --series "$name.npy" "${options[@]}"
    # By default a .h5 file has the species.
    [ "$name" = two ] && options=()
    run 0 run "$name.cascade" -q --backend interp -o "$name.png" --size 16 --series "$name.h5" "${options[@]}"
    "$python" compare.py "$name" "$fields" "$axes" || fail "$name.h5"
}
compare two a,b,u,v y,x
compare line u,v x
compare volume v z,y,x
compare mask u y,x
compare model u,v cell
run 0 run line.cascade -q -o line.png --series named.h5 --field 'difference=u - v'
"$python" -c '
import h5py
file = h5py.File("named.h5", "r")
assert file["difference"].attrs["long_name"] == "u - v" and "u" not in file' || fail "a named field"
cp two.h5 kept.h5
run 0 run two.cascade -q --backend interp -o two.png --save saved --stop-at large:9
run 3 run --resume saved -q -o again.png --series two.h5
grep -q "holds moments of an earlier run" err || fail "resumed: $(cat err)"
cmp -s two.h5 kept.h5 || fail "a refused series has changed"

# A sweep: the fields, values and features of all runs.
cat >swept.cascade <<'END'
system swept { u: 1 mM * random(1, 2); v: 0 mM; k: 0.1 /s; u' = -k * u; v' = k * u }
domain { grid: 6, 5; extent: 3 mm }
stage first: swept { iterations: 4; speed: 0.1 s }
stage last: swept { u: u; v: v; iterations: 4; speed: 0.1 s }
END
swept=(sweep swept.cascade -q --backend interp --no-kernel-cache --vary k=0.1,1/5,0.4 --seeds 1..2)
run 0 "${swept[@]}" --data all.h5 -o swept
cat >swept.py <<'END'
import csv, os, sys
import h5py, numpy

path, folder, least = sys.argv[1], sys.argv[2], int(sys.argv[3])
rows = list(csv.DictReader(open(folder + "/features.csv")))
with h5py.File(path, "r") as file:
    runs = file["run"][:]
    assert least <= len(runs) <= len(rows) and list(runs) == sorted(runs), runs
    assert file["u"].dtype == numpy.float32 and file["v"].attrs["units"] == "mM"
    assert file["k"].attrs["units"] in ("/s", "1/s")
    assert [list(dim.keys()) for dim in file["v"].dims] == [["run"], ["y"], ["x"]]
    assert numpy.allclose(file["x"][:], 0.5 * (numpy.arange(6) + 0.5)), file["x"][:]
    assert file["x"].attrs["units"] == "mm" and file.attrs["source"].startswith("Cascade")
    assert file["script"][()].decode() == open("swept.cascade").read()
    for at, number in enumerate(runs):
        row = rows[number]
        name = "k=%s,seed=%s" % (row["k"].replace("/", "_"), row["seed"])
        for field in "uv":
            array = numpy.load(f"{folder}/fields/{name}/last.{field}.npy")
            assert numpy.array_equal(file[field][at], array), (field, number)
        assert file["k"][at] == eval(row["k"]) and file["seed"][at] == int(row["seed"])
        assert file["steps"][at] == 8
        assert abs(file["mean"][at] - float(row["mean"])) < 1e-8 and numpy.isnan(file["wavelength"][at]) == (row["wavelength"] == "")
END
"$python" swept.py all.h5 swept 6 || fail "the file of a sweep"
cat >xarray.py <<'END'
try:
    import xarray, h5netcdf
except ImportError:
    raise SystemExit
table = xarray.open_dataset("all.h5", engine="h5netcdf").set_index(run=["k", "seed"]).unstack("run")
assert table.u.dims == ("y", "x", "k", "seed") and table.sizes["k"] == 3
# Theory: what u has lost, v has gained.
start = (table.u + table.v).sel(k=0.1).mean(("x", "y"))
assert abs(table.u + table.v - (table.u + table.v).sel(k=0.1)).max() < 1e-5
END
mv xarray.py with_xarray.py
"$python" with_xarray.py || fail "xarray does not open the file of a sweep"
run 0 run swept.cascade -q -o one.png --interval 2 --series one.h5 --field 'both=v + v' --field 'ratio=v / v'
"$python" -c '
import h5py
file = h5py.File("one.h5", "r")
units = {name: file[name].attrs.get("units") for name in ("both", "ratio", "time", "t", "x", "y")}
assert units == {"both": "mM", "ratio": None, "time": "s", "t": "s", "x": "mm", "y": "mm"}, units' || fail "units in a series"
# The same bytes from stored runs, and with one run at a time.
cp all.h5 kept_all.h5
run 0 "${swept[@]}" --data all.h5 -o swept
cmp -s all.h5 kept_all.h5 || fail "stored runs give another file"
run 0 "${swept[@]}" --data one.h5 -o one --threads 1
cmp -s one.h5 all.h5 || fail "one thread gives another file of a sweep"
run 3 "${swept[@]}" --data a.h5 --part 1/2 -o part
grep -q "a part of a sweep cannot write the file of --data" err || fail "a part: $(cat err)"
run 3 sweep swept.cascade -q --vary u=1,2 --data a.h5 -o wrong
grep -q "'u' cannot be the name of a dataset in 'a.h5'" err || fail "a name twice: $(cat err)"
run 64 "${swept[@]}" --data a.csv
[ ! -e a.h5 ] && [ ! -e wrong ] || fail "a refused sweep has written"
# A run that fails is left out, and numbers of cells that differ are refused.
echo "system s { w: 1; r: 1; w' = r * w^3 } domain { grid: 4, 4 } stage s: s { iterations: 300; speed: 0.01 }" >grows.cascade
run 3 sweep grows.cascade -q --vary r=0.01,2,0.05 --data grows.h5 -o grown
"$python" -c 'import h5py; assert list(h5py.File("grows.h5")["run"][:]) == [0, 2]' || fail "the file of a sweep in which a run fails"
printf 'let n = 4\nsystem s { w: 1; w'"'"' = -w }\ndomain { grid: n, n }\nstage s: s { iterations: 3 }\n' >sizes.cascade
run 3 sweep sizes.cascade -q --vary n=4,5 --data sizes.h5 -o sizes
grep -q -- "--data needs runs with the same number of cells" err || fail "other cells: $(cat err)"
# Killed while it writes, it leaves the runs that it has.
if command -v strace >/dev/null && strace -o /dev/null true 2>/dev/null && [ -z "$SANITIZE" ]; then
    { strace -f -o trace -e trace=pwrite64 "$CASCADE" "${swept[@]}" --data killed.h5 -o swept; } >out 2>err
    writes=$(grep -c 'pwrite64(' trace)
    for ((k = 2; k <= kills; ++k)); do
        rm -f killed.h5
        { strace -f -o trace -e "inject=pwrite64:signal=SIGKILL:when=$((k * writes / (kills + 1)))" \
            "$CASCADE" "${swept[@]}" --data killed.h5 -o swept; } >out 2>err
        [ ! -e killed.h5 ] || "$python" swept.py killed.h5 swept 1 || fail "the file of a killed sweep, $k"
    done
    [ -e killed.h5 ] || fail "a sweep that was killed late leaves no file"
fi

# A full disk: the file ends at the last complete moment.
cat >moments.py <<'END'
import sys
import h5py, numpy

with h5py.File(sys.argv[1], "r") as file, h5py.File(sys.argv[2], "r") as whole:
    moments = len(file["time"])
    assert moments >= int(sys.argv[3]), moments
    for name in ("time", "t", "step", "stage", "a", "b", "u", "v"):
        assert numpy.array_equal(file[name][:moments], whole[name][:moments], equal_nan=True), name
print(moments)
END
mkdir disk
if mount -t tmpfs -o size=128k tmpfs disk 2>/dev/null; then
    run 3 run two.cascade -q --backend interp --grid 64x32 -o whole.png --series disk/growth.h5
    grep -q "No space left on device\|write failed" err || fail "a full disk: $(cat err)"
    run 0 run two.cascade -q --backend interp --grid 64x32 -o whole.png --series whole.h5
    "$python" moments.py disk/growth.h5 whole.h5 1 >out || fail "the file of a full disk"
    umount disk
fi

# Killed at single writes, the file has all moments that the list of moments beside it has.
command -v strace >/dev/null && strace -o /dev/null true 2>/dev/null && [ -z "$SANITIZE" ] || exit 0
sed 's/interval: 5/interval: 1/; s/iterations: 30/interval: 1; iterations: 80/' two.cascade >long.cascade
long=(run long.cascade "${series[@]}")
strace -f -o trace -e trace=pwrite64 "$CASCADE" "${long[@]}" >out 2>err || fail "a traced run failed"
cp growth.h5 whole.h5
count=$(grep -c 'pwrite64(' trace)
killed=0
for ((k = 1; k <= kills; ++k)); do
    rm -f growth.h5 growth.xdmf
    { strace -f -o trace -e "inject=pwrite64:signal=SIGKILL:when=$((k * count / (kills + 1)))" \
        "$CASCADE" "${long[@]}" >out 2>err; } 2>/dev/null
    [ -e growth.xdmf ] || continue
    killed=$((killed + 1))
    "$python" moments.py growth.h5 whole.h5 "$(grep -c '<Time' growth.xdmf)" >out 2>err || fail "kill $k: $(cat err)"
done
[ "$killed" -gt $((kills / 2)) ] || fail "only $killed runs were killed"

# The same run writes the same bytes.
run 0 "${long[@]}"
cmp -s growth.h5 whole.h5 || fail "the same run, another file"

# While the run is stopped in the middle, a reader can open the file, although h5py locks it.
rm -f growth.h5 growth.xdmf
strace -f -o trace -e "inject=pwrite64:signal=SIGSTOP:when=$((count / 2))" "$CASCADE" "${long[@]}" >out 2>err &
tracer=$!
until grep -q 'stopped by SIGSTOP' trace 2>/dev/null; do sleep 0.05; done
"$python" moments.py growth.h5 whole.h5 1 >out 2>err || fail "the file of a running run: $(cat err)"
kill -KILL "$(sed -n 's/^\([0-9]*\) .*stopped by SIGSTOP.*/\1/p' trace | head -n 1)"
wait $tracer 2>/dev/null
exit 0
