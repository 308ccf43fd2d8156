#!/usr/bin/env bash
# Files from strangers cannot read outside of their folder, choose names of written files, or send control characters to
# the terminal (spec/security.md).
set -u
rm -rf ./* && mkdir -p private box
about="strangers"
source "$SOURCE/tests/support/program_runs.bash"
# never FILE TEXT: fails if the text is in the file.
never() { ! grep -qF -- "$2" "$1" || fail "'$2' in $1"; }

# A model's buffers: a private key must not come out as coordinates.
printf 'BEGIN PRIVATE KEY 0123456789abcdefghijklmnop' >private/key
size=$(stat -c %s private/key)
model() {
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5121,"count":9,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":27}],"buffers":[{"uri":"%s","byteLength":%s}]}' "$1" "$2"
}
ln -s ../private/key box/link
cat >box/m.cascade <<'EOF'
stage s: turing_spots { iterations: 2 }
domain { mesh: "m.gltf"; cells: 16 }
EOF
for uri in ../private/key "$PWD/private/key" %2e%2e/private/key link; do
    for bytes in "$size" 12; do
        model "$uri" "$bytes" >box/m.gltf
        run 3 mesh box/m.gltf
        says err "lies outside of the model's folder"
        never err "got $size"
        "$CASCADE" run box/m.cascade -q -o stolen.obj >out 2>err && fail "$uri was read"
        says err "lies outside of the script's folder"
        [ ! -e stolen.obj ] || fail "stolen.obj"
    done
done

# Outputs are named after the typed name, and never overwrite the picture that is run again.
echo 'stage s: turing_spots { iterations: 2 } ' >family.cascade
echo 'domain { grid: 8, 8 }' >>family.cascade
run 0 run family.cascade -q -o evil.png
mkdir -p victim && echo mine | tee victim/family.png >victim/family.h
(cd victim && "$CASCADE" run ../evil.png -q && [ -s evil.png ]) || fail "no evil.png"
(cd victim && "$CASCADE" sweep ../evil.png --vary seed=1,2 -q >/dev/null 2>&1 && [ -d evil_sweep ]) || fail "no evil_sweep"
if [ "$CASCADE_JIT" = 1 ]; then
    (cd victim && "$CASCADE" compile ../evil.png >/dev/null && [ -s evil.h ]) || fail "no evil.h"
fi
[ "$(cat victim/family.png victim/family.h)" = $'mine\nmine' ] || fail "a picture chose what is replaced"
cp evil.png before.png
run 0 run evil.png
says out 'wrote evil-again.png'
cmp -s evil.png before.png || fail "the picture that was run is replaced"
run 0 run "$PWD/evil.png" -q
cmp -s evil.png before.png || fail "the picture that was run is replaced"
cmp -s evil.png evil-again.png || fail "another picture"
run 0 run family.cascade --save kept --stop-at s:1 -q -o half.png
run 0 run --resume kept/
says out 'wrote kept.png'

# A saved run does not choose where files are read: the user's own script or the user does.
mkdir -p own private/own && cp kept/s.b.npy own/a.npy && cp kept/s.b.npy private/own/a.npy
printf 'stage s: turing_spots { iterations: 4; b: field("a.npy") }\ndomain { grid: 8, 8 }\n' >own/field.cascade
run 0 run own/field.cascade --save saved --stop-at s:2 -q -o half.png
grep -q "$PWD" saved/run.json && fail "run.json knows this folder"
sed -i "s|^{|{\"folder\": \"$PWD/private/own\",|" saved/run.json
run 0 run --resume saved -q -o resumed.png
mv own moved
run 2 run --resume saved -q -o stolen.png
says err "a.npy"
run 0 run moved/field.cascade --resume saved -q -o again.png
cmp -s resumed.png again.png || fail "another picture"
run 0 run --resume saved --allow-read moved -q -o again.png
cmp -s resumed.png again.png || fail "another picture"
sed -i "s|own/field.cascade|../private/own/field.cascade|" saved/run.json
cp moved/field.cascade private/own/
run 2 run --resume saved -q -o stolen.png
[ ! -e stolen.png ] || fail "stolen.png"

# Pictures and saved runs contain no absolute path, and models are still found.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >moved/tetra.obj
run 0 run "$PWD/family.cascade" --mesh "$PWD/moved/tetra.obj" --cells 64 -q -o model.png --save model
grep -qaF "$PWD" model.png model/run.json && fail "an absolute path"
run 2 run model.png -q -o again.png
run 0 run model.png --allow-read moved -q -o again.png
cmp -s model.png again.png || fail "another picture"
run 0 run model.png --mesh moved/tetra.obj -q -o again.png
run 0 run --resume model --allow-read moved -q -o again.png
run 0 run --resume model --mesh moved/tetra.obj -q -o again.png
run 2 run --resume model --mesh sphere -q -o again.png
says err 'cannot change its model'

# No escape sequence of a file reaches the terminal.
escape=$'\x1b]0;title\x07\x1b[2J'
cat >escape.cascade <<EOF
/// $escape
system loud {
  title: "$escape"
  cite: "$escape"
  ## $escape
  u: 1   # $escape
  u' = -u
}
stage s: loud { iterations: 1 }
domain { grid: 4, 4 }
EOF
sed -i '1d' escape.cascade
quiet() {
    "$CASCADE" "$@" >out 2>err </dev/null
    ! grep -q $'[\x1b\x07\x9b]' out err || fail "an escape sequence of $*"
}
quiet systems escape.cascade
quiet check escape.cascade
for kind in tokens ast equations tex program plan ir; do quiet check escape.cascade --dump $kind; done
printf ':load escape.cascade\n:text\n' | "$CASCADE" repl >out 2>err
! grep -q $'\x1b' out err || fail "an escape sequence of the prompt"
cp family.cascade "family$escape.cascade"
run 0 run "family$escape.cascade" -q -o named.png
quiet check named.png
quiet systems named.png
quiet bench named.png --csv
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float %s\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n' $'\x1b[31mred' >escape.ply
quiet mesh escape.ply
printf '{"asset":{"version":"2.0"},"%s":[' "$escape" >escape.gltf
quiet mesh escape.gltf
model "$escape" 12 >escape.gltf
quiet mesh escape.gltf

# No name of a script is C code.
if [ "$CASCADE_JIT" = 1 ]; then
    name='x*/ int pwned; /*.npy'
    mkdir -p "$(dirname "$name")" && cp kept/s.b.npy "$name"
    printf 'stage s: turing_spots { iterations: 2; ka: 0.01 + 0*field("%s") }\ndomain { grid: 8, 8 }\n' "$name" >inject.cascade
    run 0 compile inject.cascade
    grep -q pwned inject.h || fail "the header does not name its file"
    printf '#include "inject.h"\nint main(void) { return 0; }\n' >main.c
    cc -std=c11 -Wall -Wno-unused -Werror -c main.c -o main.o || fail "the header is no C"
    ! nm main.o | grep -q pwned || fail "a name became code"
fi

# Endless devices are refused as scripts.
"$CASCADE" check /dev/zero >out 2>err && fail "/dev/zero is a script"
says err 'at most 16777216 bytes are read'

# The program does not wait for a pipe, and the message about a too long name says so.
mkfifo box/pipe
printf 'use "pipe"\nuse "%s"\nstage s: turing_spots { }\n' "$(printf 'x%.0s' {1..5000})" >box/names.cascade
run 2 check box/names.cascade
says err "'pipe' is a pipe or a device, not a file"
says err "File name too long"
[ "$(wc -c <err)" -lt 1500 ] || fail "a long name is printed whole"

echo "strangers: passed"
