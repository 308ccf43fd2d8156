#!/usr/bin/env bash
# `cascade examples` lists the examples, prints one byte for byte, and copies one with the pictures that it reads.
set -u
rm -rf ./*
about=examples
source "$SOURCE/tests/support/program_runs.bash"

run 0 examples
[ "$(wc -l <out)" = "$(find "$SOURCE/examples" -name '*.cascade' | wc -l)" ] || fail "the list is not complete"
says out 'leopard                  Leopard - Turk 1992, Appendix C'
says out 'cells/thorny_sphere      Bumps and thorns: '
if grep -qE ' $' out; then fail "an example begins without a comment"; fi
run 0 examples GIRAFFE
says out 'on_models/giraffe '
says out 'witkin_kass/giraffe '
if grep -q '^leopard ' out; then fail "an example that does not mention the word"; fi

run 0 examples leopard
cmp out "$SOURCE/examples/leopard.cascade" || fail "the text differs"
cp out leopard.cascade
run 0 run leopard.cascade --steps 3 -q
run 0 examples fur
cmp out "$SOURCE/examples/cells/fur.cascade" || fail "the last part of a name is no name"
run 0 examples leopard --path
cmp "$(cat out)" "$SOURCE/examples/leopard.cascade" || fail "the path is wrong"

run 0 examples on_models/emperor
says err "on_models/emperor reads maps/rings.png; 'cascade examples on_models/emperor -o FILE' copies it, too"
mkdir fish
run 0 examples on_models/emperor -o fish/emperor.cascade
says out 'wrote fish/emperor.cascade'
cmp fish/maps/rings.png "$SOURCE/examples/on_models/maps/rings.png" || fail "the picture was not copied"
run 0 check fish/emperor.cascade
run 3 examples on_models/emperor -o fish/other.cascade
says err 'fish/maps/rings.png already exists'
[ ! -e fish/other.cascade ] || fail "half of an example was written"
run 3 examples leopard -o leopard.cascade
says err 'leopard.cascade already exists'

run 64 examples lepoard
says err "did you mean 'leopard'?"
run 64 examples giraffe -o giraffe.cascade
says err "several examples are called 'giraffe'"
says err 'write on_models/giraffe or witkin_kass/giraffe'
run 64 examples --path
says err 'the name of an example is missing'
run 64 examples zzzz
says err "no example is called 'zzzz', and none mentions it"
run 2 run butterfly.cascade
says err "'cascade examples butterfly -o butterfly.cascade' writes the example of this name"
