#!/usr/bin/env bash
# Cells that crawl, from a script to pictures and files: the same bits in all configurations, theory for a covered
# sphere, and messages for impossible combinations.
set -u
rm -rf ./*

fail() { echo "tissue_run: $*"; exit 1; }

cat >cover.cascade <<'END'
cells small: scales {
  tone: random(0.5, 0.3)
  mood: random(0.5, 0.5) after divide
}
domain { surface: sphere; cells: 400 }
stage cover: small { founders: 4; r: 0.06; duration: 25 }
picture { shape: plate; color: rgb(tone, mood, 0.4) }
END
"$CASCADE" run -q cover.cascade --threads 1 -o one.npz -o one.png || fail "the run failed"
"$CASCADE" run -q cover.cascade --threads 2 -o two.npz || fail "two threads"
"$CASCADE" run -q cover.cascade --backend interp -o interp.npz || fail "the interpreter"
cmp -s one.npz two.npz || fail "another number of threads, other cells"
cmp -s one.npz interp.npz || fail "another backend, other cells"
"$CASCADE" run -q one.png -o again.png || fail "the picture does not run again"
cmp -s one.png again.png || fail "the picture is not itself again"
for out in all.glb all.obj all.cells.vtp; do
    "$CASCADE" run -q cover.cascade -o "$out" || fail "$out was not written"
    [ -s "$out" ] || fail "$out is empty"
done
"$CASCADE" run cover.cascade -o noted.glb >out 2>err || fail "noted.glb was not written"
grep -q 'copies by EXT_mesh_gpu_instancing; programs that lack it' err || fail "nobody says who needs --merge"
"$CASCADE" run cover.cascade -o merged.glb --merge >out 2>err || fail "--merge"
grep -q EXT_mesh_gpu_instancing err && fail "merged copies are said to be instances"
[ "$(stat -c %s merged.glb)" -gt "$(stat -c %s all.glb)" ] || fail "--merge merges nothing"
"$CASCADE" run -q cover.cascade --frames frames -o last.png --steps 30 || fail "--frames"
ls frames/*.png >/dev/null 2>&1 || fail "there are no frames"

# A run that is stopped and resumed has the same bits. A saved run that was changed is refused.
"$CASCADE" run -q cover.cascade --stop-at cover:150 --save kept -o part.npz || fail "--save"
cmp -s part.npz one.npz && fail "the run was not stopped"
"$CASCADE" run -q --resume kept -o resumed.npz || fail "--resume"
cmp -s resumed.npz one.npz || fail "a resumed run has other cells"
for step in 10 40; do # Cells divide within these steps.
    "$CASCADE" run -q cover.cascade --stop-at cover:$step --save early -o part.npz || fail "--save"
    "$CASCADE" run -q --resume early -o resumed.npz || fail "--resume at step $step"
    cmp -s resumed.npz one.npz || fail "a run resumed at step $step has other cells"
    rm -rf early
done
cp kept/cover.r.npy kept/cover.p.x.npy
"$CASCADE" run -q --resume kept -o resumed.npz 2>err && fail "a changed run is resumed"
grep -q "damaged" err || fail "a changed run: $(cat err)"

# Where a model is as thin as its cells, they cover it and still lie on its surface.
cat >thin.cascade <<'END'
domain { surface: torus(1, 0.06); cells: 1000 }
stage cover: scales { founders: 6; duration: 20; r: 0.04 }
END
"$CASCADE" run -q thin.cascade -o thin.png --log 'n=sum(1 over domain)' --log 'far=max(abs(off) / r over domain)' \
    --log-file thin.csv || fail "a thin torus"
tail -n 1 thin.csv | awk -F, '$4 < 60 || $5 > 0.2 { exit 1 }' || fail "cells leave a thin torus: $(tail -n 1 thin.csv)"

# A stage continues with the cells of the previous one, and cells may also crawl on a plane.
cat >plane.cascade <<'END'
cells dots: solid { p' += vector(0.002, 0, 0) }
cells marked: dots { kind: 0; kind' = more(0.5, x) - kind }
domain { grid: 40, 20 }
stage a: dots { founders: 60; r: 0.04; duration: 6 }
stage b: marked { remove: x > 0.9; duration: 2 }
picture { color: rgb(kind, 0.3, 0.6); skin: rgb(0.9, 0.9, 0.85) }
END
"$CASCADE" run -q plane.cascade -o plane.npz -o plane.png || fail "cells on a plane"

# A pattern that grew before determines the values of cells.
cat >coat.cascade <<'END'
system bands { u: y > 0.5; u' = 0 }
cells marked: scales { dark: 0; dark' = coat.u - dark }
domain { surface: torus(1, 0.4); cells: 900 }
stage coat: bands { iterations: 1 }
stage skin: marked { founders: 60; r: 0.06; duration: 8 }
END
"$CASCADE" run -q coat.cascade -o coat.npz || fail "cells on a coat"

# Aggregates over the domain are over the cells, which all have the same weight.
cat >count.cascade <<'END'
cells c { m: 0; m' = sum(1 over domain) - m }
domain { surface: sphere; cells: 400 }
stage a: c { founders: 5; r: 0.05; duration: 1 }
END
"$CASCADE" run -q count.cascade --log 'sum(1 over domain)' --log 'mean(r over domain)' -o count.npz ||
    fail "aggregates of cells"
tail -n 1 count.csv | grep -q ',5,0.05$' || fail "aggregates of cells: $(tail -n 1 count.csv)"

refused() { # refused WORDS SCRIPT [OPTION …]
    local words=$1 text=$2
    shift 2
    printf '%s\n' "$text" >wrong.cascade
    timeout 60 "$CASCADE" run -q wrong.cascade -o wrong.npz "$@" 2>err && fail "not refused: $words"
    grep -q -- "$words" err || fail "expected '$words': $(cat err)"
    [ ! -e wrong.npz ] || fail "a file was written in spite of: $words"
}
sphere='domain { surface: sphere; cells: 200 }'
refused "has no cells to start with" "$sphere
stage a: scales { duration: 1 }"
refused "would divide again" "cells c: on_surface { divide: 1 }
$sphere
stage a: c { founders: 2; duration: 1 }"
refused "not finite" "cells c: on_surface { u: 1; u' = u / (u - 1) }
$sphere
stage a: c { founders: 2; duration: 1 }"
refused "takes all cells" "$sphere
stage a: scales { founders: 5; remove: 1; duration: 1 }"
refused "there is memory only for" "$sphere
stage a: scales { founders: 100000000; duration: 1 }"
refused "neighbours each" "cells c: scales { n: 0; n' = sum(1 over near(5)) - n }
$sphere
stage a: c { founders: 100000; r: 0.006; duration: 1 }"
refused "have no rows and columns" "$(cat cover.cascade)" --features
"$CASCADE" bench cover.cascade --seconds 0.05 >out || fail "bench of cells"
grep -q "cells that crawl on average" out && grep -q "cell-steps/s" out || fail "bench: $(cat out)"
"$CASCADE" compile cover.cascade 2>err && fail "cells become C"
grep -q "cells that crawl" err || fail "compile: $(cat err)"

command -v python3 >/dev/null || exit 0
python3 -c 'import numpy' 2>/dev/null || exit 0
python3 - <<'END' || fail "the cells are not what theory says"
import numpy as np
cells = np.load("one.npz")
points, radii = cells["points"], cells["radii"]
n = len(points)
# Cells lie on the sphere of radius 1, and cover it nearly as densely as circles can be packed: r is
# in sides of the box, which is 2 wide.
assert abs(np.linalg.norm(points, axis=1) - 1).max() < 0.03
# Cells at rest lie on the surface: fewer than one in a thousand is more than a fifth of its radius off it.
assert (abs(np.linalg.norm(points, axis=1) - 1) > 0.2 * radii).mean() < 0.001
part = n * np.pi * (2 * 0.06) ** 2 / (4 * np.pi)
densest = np.pi / np.sqrt(12)
assert 0.92 < part / densest < 1.12, part / densest
# The frames of cells are upright on the surface.
w, x, y, z = cells["frames"].T
ey = np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], 1)
assert ((ey * points).sum(1) > 0.99).all()
# Descendants of a cell have the same value of an inherited parameter, but not of one that starts again after a
# division.
assert len(np.unique(cells["tone"])) <= 4 and len(np.unique(cells["mood"])) > n // 2

plane = np.load("plane.npz")
assert plane["points"][:, 0].max() <= 0.93 and abs(plane["points"][:, 2]).max() == 0
gap = np.linalg.norm(plane["points"][:, None] - plane["points"][None], axis=2)
assert gap[~np.eye(len(gap), dtype=bool)].min() > 0.06

coat = np.load("coat.npz")
assert coat["dark"][coat["points"][:, 1] > 0.15].min() > 0.9
assert coat["dark"][coat["points"][:, 1] < -0.15].max() < 0.1
END
