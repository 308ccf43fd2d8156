#!/usr/bin/env bash
# Hints about options are true: a command with an error gets the hint, and following the hint removes the error. (Hints
# about the text of scripts: tests/unit/lang/hints_test.cpp.)
set -u
fail() { echo "FAILED: $*" >&2; exit 1; }
rm -rf ./*

# hint TEXT COMMAND… -- MENDED COMMAND…
hint() {
    local text=$1; shift
    local faulty=()
    while [ "$1" != -- ]; do faulty+=("$1"); shift; done
    shift
    "$CASCADE" "${faulty[@]}" >out 2>err </dev/null && fail "no fault: ${faulty[*]}"
    grep -qF -- "$text" err || fail "${faulty[*]}: no hint '$text' in: $(cat err)"
    "$CASCADE" "$@" >out 2>err </dev/null || fail "$text: the fault of '${faulty[*]}' stays in '$*': $(cat err)"
}

cat >s.cascade <<'S'
system mine { u: 1 + x; k: 0.1; u' = k * lap(u) }
domain { grid: 8, 8 }
stage first: mine { iterations: 4 }
S
sed "/^stage/d" s.cascade >bare.cascade
sed 's/grid: 8, 8/surface: sphere; cells: 100/' s.cascade >ball.cascade
"$CASCADE" run s.cascade -q --save saved -o s.png || fail "a run"

# A command that runs but probably not as meant gets a hint in a warning.
hint_of_run() {
    local text=$1; shift
    "$CASCADE" "$@" >out 2>err </dev/null || fail "$*"
    grep -qF -- "$text" err || fail "$*: no hint '$text' in: $(cat err)"
}
hint_of_run "for a square write --grid 9x9" check s.cascade --grid 9
"$CASCADE" check s.cascade --grid 9x9 2>&1 | grep -q warning && fail "a square gets a warning"
hint "did you mean --set k=0.05?" run s.cascade --set k 0.05 -- run s.cascade -q --set k=0.05
hint "--seed is given more than once; leave one of them out" run s.cascade --seed 1 --seed 2 -- run s.cascade -q --seed 2
hint "write --set iterations=3" run --iterations 3 s.cascade -- run s.cascade -q --set iterations=3
hint "write --set speed=0.25" run s.cascade --dt 0.25 -- run s.cascade -q --set speed=0.25
hint "write --set k=0.3" run s.cascade --param k=0.3 -- run s.cascade -q --set k=0.3
hint "write --grid 16x16" run s.cascade --resolution 16 -- run s.cascade -q --grid 16x16
hint "write --palette gray" run s.cascade --cmap gray -- run s.cascade -q --palette gray
hint "write --palette viridis" run --colormap s.cascade -- run s.cascade -q --palette viridis
hint "did you mean -o p.png?" run s.cascade p.png -- run s.cascade -q -o p.png
hint "-o film.gif writes a film" run s.cascade --frames film.gif -- run s.cascade -q -o film.gif
hint "the endings of films are .gif, .webp, .apng, .mp4 and .webm" run s.cascade -o film.mov -- run s.cascade -q -o film.apng
hint "-o NAME.gif, .webp, .apng, .mp4 or .webm writes one" run s.cascade --fps 5 -- run s.cascade -q --fps 5 -o film.webp
hint ".webp and .apng show up to 60" run s.cascade -o film.gif --fps 60 -- run s.cascade -q -o film.apng --fps 60
"$CASCADE" run s.cascade -q --frames film || fail "frames"
cp s.cascade t.cascade
hint "name another folder with --frames" run t.cascade -q --frames film -- run t.cascade -q --frames film3

# Missing parts.
hint "add 'stage spots: mine { }'" run bare.cascade -- run s.cascade -q
hint "did you mean 's.cascade'?" check z.cascade -- check s.cascade
hint "did you mean 's.cascade'?" check s -- check s.cascade
hint "'cascade new stripes' prints a script of that system" check stripes -- new stripes -o n.cascade
hint "there are k, u" check s.cascade --set F=3 -- check s.cascade --set k=3
hint "write 'iterations: 1000'" check s.cascade --set steps=1000 -- check s.cascade --set iterations=1000
hint "write 'speed: 0.25'" check s.cascade --set dt=0.25 -- check s.cascade --set speed=0.25
hint "write 'iterations: 3'" check s.cascade --set steps=3 -- check s.cascade --set iterations=3
hint "write --grid 16x8" check s.cascade --grid 16,8 -- check s.cascade --grid 16x8
hint "write --grid 16x8" check s.cascade --grid '16 * 8' -- check s.cascade --grid 16x8
hint "did you mean 'cascade --help'?" help -- --help
hint "did you mean 'k'?" check s.cascade --set kk=1 -- check s.cascade --set k=1

# Models.
for option in --retile "--bake 64" "--bump 0.1"; do
    # shellcheck disable=SC2086
    hint 'write mesh: "FILE" in the domain, or run with --mesh FILE' \
        run s.cascade -o a.ply $option -- run ball.cascade -q -o a.ply
done
hint "add --bake N for a rectangle with maps of N x N texels" run s.cascade -o a.glb -- \
    run s.cascade -q -o a.glb --bake 16
hint "-o NAME.glb writes a rectangle with them" run s.cascade --bake 16 -- \
    run s.cascade -q -o a.glb --bake 16
"$CASCADE" run ball.cascade -q -o ball.obj || fail "a model"
sed 's/surface: sphere/mesh: "ball.obj"/' ball.cascade >file.cascade
hint 'mesh: "FILE" in the domain' run s.cascade -o a.ply -- run file.cascade -q -o a.ply
hint '--mesh FILE' run s.cascade -o a.ply -- run s.cascade --mesh ball.obj --cells 100 -q -o a.ply
hint "write surface: x, y, z in the domain for a surface" run s.cascade --flat -- \
    check ball.cascade

# Finer cells.
sed 's/cells: 100/cells: faces/' ball.cascade >faces.cascade
hint "use --cells 20000 to spread cells" run faces.cascade -q --detail 2 -- run faces.cascade -q --cells 100 --detail 2
sed 's/grid: 8, 8/grid: 8, 8; mask: random(1, 2) > 0/' s.cascade >drawn.cascade
sed 's/grid: 8, 8/grid: 8, 8; mask: noise(0.3) > -1/' s.cascade >noise.cascade
hint "use noise(…), whose outlines stay the same" run drawn.cascade -q --detail 2 -- run noise.cascade -q --detail 2
hint "use a finer grid in the script" run s.cascade -q --detail 2 -o fine.gif -- run s.cascade -q --grid 16x16 -o fine.gif

# Forms of values.
hint "as in --grid 256x128" check s.cascade --grid 8y8 -- check s.cascade --grid 8x8
hint "as in --range 0,8" run s.cascade -q --range 1 -- run s.cascade -q --range 0,8
hint "as in --stop-at stage2:3000" run s.cascade -q --save t --stop-at 3 -- run s.cascade -q --save t --stop-at first:3
hint "write 90s, 20m, 1.5h or 2d" run s.cascade -q --limit-time 1y -- run s.cascade -q --limit-time 20m
hint "write 500MB, 2GB or 1.5GiB" run s.cascade -q --limit-memory lots -- run s.cascade -q --limit-memory 2GB
hint "as in --vary feed=0.02..0.06:9" sweep s.cascade -- sweep s.cascade -q --vary k=0.02..0.06:2 -o w
hint "did you mean 'viridis'?" run s.cascade -q --palette viridi -- run s.cascade -q --palette viridis
hint "'cascade systems' lists them" systems qqq -- systems

# Words of other programs.
hint "did you mean --set k=2?" run s.cascade k=2 -- check s.cascade --set k=2
hint "did you mean --vary k=2,3?" sweep s.cascade k=2,3 -- sweep s.cascade -q --vary k=2,3 -o w2
hint "write --palette" run s.cascade --cmap viridis -- run s.cascade -q --palette viridis
sed '1s/^/let n = 8\n/; s/grid: 8, 8/grid: n, n/' s.cascade >sized.cascade
hint "write let n = 64 and grid: n, n in the script, and --vary n=32,64" sweep s.cascade --vary grid=32,64 -o w3 -- \
    sweep sized.cascade -q --vary n=8,16 -o w3
hint "the option --grid 32x32 sets it" check s.cascade --set grid=32 -- check s.cascade --grid 32x32
hint "the option --grid 32x32 sets it" check s.cascade --set domain.grid=32 -- check s.cascade --set domain.extent=32
hint "write first.k" check s.cascade --set stage.k=2 -- check s.cascade --set first.k=2
hint "once for each name" check s.cascade --set k=2,u=1 -- check s.cascade --set k=2 --set u=1
hint "'..' must separate the ends of a range" sweep s.cascade --vary k=0.02-0.06:3 -- \
    sweep s.cascade -q --vary k=0.02..0.06:3 -o w4
hint "write --set duration=2" run s.cascade --time 2 -- run s.cascade -q --set duration=2
hint "write --set extent=4" run s.cascade --extent 4 -- run s.cascade -q --set extent=4
hint "write -o a.webp" run s.cascade --movie a.webp -- run s.cascade -q -o a.webp
hint "write --threads 2" run s.cascade -j 2 -- run s.cascade -q --threads 2
hint "write --set k=0.3" run s.cascade --k 0.3 -- run s.cascade -q --set k=0.3
hint "write --set k=0.3" run s.cascade --k=0.3 -- run s.cascade -q --set k=0.3
hint "write 2" run s.cascade -q --steps 2e0 -- run s.cascade -q --steps 2
hint "write 'double'" run s.cascade -q --precision float64 -- run s.cascade -q --precision double
hint "did you mean 'cascade run s.cascade …'?" s.cascade -o a.png -- run s.cascade -q -o a.png
hint "--mesh creature -o creature.obj" mesh creature -- \
    run s.cascade --mesh creature --cells 100 -q -o creature.obj
hint "'cascade run' draws a script" mesh s.cascade -- run s.cascade -q
hint "export the model as .glb or .obj" mesh a.fbx -- mesh ball.obj
for option in --port --host --open; do
    "$CASCADE" view s.cascade $option 8080 >out 2>err && fail "no fault: view $option"
    grep -qE "there is no option $option; leave it out: (the page|only browsers|the browser)" err || fail "view $option: $(cat err)"
done
"$CASCADE" fmt s.cascade --write >out 2>err && fail "no fault: fmt --write"
grep -qF "leave it out: the files themselves are changed" err || fail "fmt --write: $(cat err)"
"$CASCADE" run s.cascade --film x >out 2>err && fail "no fault: run --film"
grep -qF -- "--field" err && fail "--field is near --film"
hint "did you mean 'cascade systems'?" list -- systems
"$CASCADE" sweep s.cascade -q --vary extent=4,8 -o w5 || fail "an extent that is varied"
"$CASCADE" run s.cascade -q --palette "#000 #fff" || fail "a palette of one's own"
