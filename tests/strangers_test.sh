#!/usr/bin/env bash
# What files from strangers may not do: reach beyond their folder, name what is written, or speak to
# the terminal (spec/security.md).
set -u
rm -rf ./* && mkdir -p private box
about="strangers"
source "$SOURCE/tests/support/program_runs.bash"
# never FILE TEXT: the text is not in the file.
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

# Nobody waits for a pipe, and a name that is too long is called so.
mkfifo box/pipe
printf 'use "pipe"\nuse "%s"\nstage s: turing_spots { }\n' "$(printf 'x%.0s' {1..5000})" >box/names.cascade
run 2 check box/names.cascade
says err "'pipe' is a pipe or a device and no file"
says err "File name too long"
[ "$(wc -c <err)" -lt 1500 ] || fail "a long name is printed whole"

echo "strangers: passed"
