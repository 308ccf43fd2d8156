#!/usr/bin/env bash
# The first program (cmake/first.cmake) does what it can exactly as the whole program does. For everything else it
# calls the launcher with the same words, before it prints or reads anything.
set -u

fail() {
    echo "first_program: $*"
    exit 1
}

rm -rf ./* && mkdir -p tree/build/release
cp "$BUILD/cascade-first" tree/build/release/ || fail "it is not built"
ln -s "$SOURCE/examples" tree/build/release/examples
for module in "$BUILD"/libcascade_*.so; do ln -s "$module" tree/build/release/; done
cat >tree/cascade <<'END'
#!/bin/bash
printf '%s\n' "$CASCADE_WHOLE" "$(ulimit -d)" "$@" >words
cat >input
exit 7
END
chmod +x tree/cascade
first=$PWD/tree/build/release/cascade-first

cat >plane.cascade <<'END'
system gray_scott {
  u: 1 - 0.5 * disc(0.5, 0.5, 0.1)
  v: 0.25 * disc(0.5, 0.5, 0.1) + random(0.01, 0.01)
  u' = 0.16 * lap(u) - u * v^2 + 0.037 * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - 0.097 * v
}
domain { grid: 48, 40 }
stage coral: gray_scott { iterations: 200 }
END
sed 's/40/40, 6/; s/200/20/' plane.cascade >volume.cascade
sed 's/grid.*}/surface: sphere; cells: 300 }/' plane.cascade >model.cascade
echo 'stage a: nonsense { b: 1 }' >wrong.cascade
echo 'stage skin: scales { founders: 10; r: 0.1; duration: 1 } domain { grid: 64, 64 }' >tissue.cascade

# same WORD…: both programs print the same and write the same file.
same() {
    rm -f words picture.*
    "$CASCADE" "$@" >out 2>err
    local status=$? written
    written=$(ls picture.* 2>/dev/null)
    for file in $written; do mv "$file" "whole.$file"; done
    "$first" "$@" >first.out 2>first.err
    [ $? = "$status" ] || fail "$*: another status: $(cat first.err)"
    [ ! -e words ] || fail "$*: the whole program is built"
    cmp -s out first.out || fail "$*: prints $(diff out first.out)"
    diff err first.err >differs || fail "$*: says $(cat differs)"
    for file in $written; do cmp -s "$file" "whole.$file" || fail "$*: another $file"; done
}
same --help
same run --help
same --version
same systems
same systems spiral
same examples
same new turing_spots
same palettes
same fmt plane.cascade
same check plane.cascade
same check wrong.cascade
same run missing.cascade
same run wrong.cascade
same run "$SOURCE/examples/leopard.cascade" -q -o picture.png
for picture in picture.png picture.gif picture.npy picture.svg; do same run plane.cascade -q -o $picture; done
same run plane.cascade -q -o picture.png --size 200 --palette viridis --show u --detail 2
same run plane.cascade -q -o picture.png --size 200 --show "u - v" --features
sed 's/40 }/40; mask: disc(0.5, 0.5, 0.4) }/' plane.cascade >masked.cascade
same run masked.cascade -q -o picture.png --size 200
for solver in rk4 rkl2 imex2 etdrk4 rosenbrock; do
    sed "s/200/20; solver: $solver/" plane.cascade >solver.cascade
    same run solver.cascade -q -o picture.png
done
same run volume.cascade -q -o picture.png --slice z=2

# whole WORD…: the launcher receives the words and the input, nothing has been printed, and no limit is left.
whole() {
    rm -f words input
    echo "typed" | "$first" "$@" >out 2>err
    [ $? = 7 ] || fail "$*: not run by the whole program: $(cat err)"
    [ ! -s out ] && [ ! -s err ] || fail "$*: printed twice: $(cat out err)"
    [ "$(cat words)" = "$(printf '%s\n' 1 unlimited "$@")" ] || fail "$*: other words: $(cat words)"
    [ "$(cat input)" = typed ] || fail "$*: the input is lost"
}
whole check model.cascade
whole analyze plane.cascade
whole sweep plane.cascade --vary coral.iterations=1..3:3
whole mesh 'a b.ply' ''
whole repl
whole lsp
whole view plane.cascade
whole run -
whole run model.cascade --limit-memory 1GB --limit-time 1s
whole run tissue.cascade -o a.png
whole run plane.cascade --device list
whole run plane.cascade -o a.glb --bake 64
whole run plane.cascade --save saved
whole run volume.cascade --volume a.vdb

CASCADE_WHOLE=1 "$first" check model.cascade >out 2>err
[ $? = 70 ] && grep -q 'could not build the whole program' err || fail "calls itself for ever: $(cat out err)"
