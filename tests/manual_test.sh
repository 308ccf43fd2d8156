#!/usr/bin/env bash
# Manual pages say what --help says: each command, argument and option with its description. The completions of bash,
# zsh and fish complete each command, each option, files of scripts and known words.
set -u
rm -rf ./*
fail() { echo "manual: $*"; exit 1; }
for program in mandoc zsh fish; do
    command -v $program >/dev/null || fail "$program is missing; cmake/packages.txt names its package"
done
manual=$BUILD/manual

# The commands by themselves, from the help of the program.
mapfile -t commands < <("$CASCADE" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]\+\) .*/\1/p')
[ "${#commands[@]}" -ge 15 ] || fail "--help lists only ${#commands[@]} commands"
[ "$(ls "$manual/man1")" = "$(printf 'cascade%s.1\n' '' "${commands[@]/#/-}" | LC_ALL=C sort)" ] ||
    fail "there is not one page for each command"

for page in "$manual"/man1/*.1; do
    # -Wstyle would ask for a date.
    mandoc -Tlint -Wwarning "$page" >lint
    grep -v 'missing date' lint && fail "$page is not written well"
    command=$(basename "$page" .1)
    command=${command#cascade}
    COLUMNS=200 "$CASCADE" ${command#-} --help >help || fail "no help of $command"
    mandoc -Tutf8 -Owidth=1000 "$page" | col -bx >text
    python3 "$SOURCE/tests/support/same_manual.py" help text || fail "$page is not what --help says"
done

# Files to complete.
touch growing.cascade growing.txt
mkdir kept

# complete_bash WORD…: the completions of the last word.
complete_bash() {
    bash --norc -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _cascade; printf "%s\n" "${COMPREPLY[@]}"' \
        bash "$manual/bash/cascade" "$@"
}
complete_fish() {
    local words="$*"
    fish --no-config -c 'source $argv[1]; complete -C $argv[2]' "$manual/fish/cascade.fish" "$words" | cut -f1
}
# zsh completes only in a terminal, so it gets one, in which the key ^T completes and prints the line.
complete_zsh() {
    zsh -f "$SOURCE/tests/support/complete.zsh" "$manual/zsh" "$*"
}

# expect_one SHELL RESULT WORD…: the only completion of the last word is RESULT.
expect_one() {
    local shell=$1 wanted=$2 got
    shift 2
    got=$("complete_$shell" "$@")
    [ "${got%/}" = "$wanted" ] || fail "$shell completes '$*' as '$got', not '$wanted'"
}
for shell in bash fish zsh; do
    expect_one $shell sweep cascade swe
    expect_one $shell --palette cascade run --pale
    expect_one $shell growing.cascade cascade run grow
    expect_one $shell growing.cascade cascade run --grid 4x4 grow
    expect_one $shell brusselator cascade new brussela
    expect_one $shell vertices cascade mesh --cells vert
    expect_one $shell kept cascade run growing.cascade --frames kep
done

# All commands and options, in the two shells that answer quickly.
for shell in bash fish; do
    for command in "${commands[@]}"; do
        "complete_$shell" cascade '' | grep -qx -- "$command" || fail "$shell does not complete $command"
        "complete_$shell" cascade "$command" -- | LC_ALL=C sort >given
        "$CASCADE" "$command" --help | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+' | LC_ALL=C sort >wanted
        [ "$(wc -l <wanted)" -ge 1 ] && ! grep -vxFf given wanted >lacking ||
            fail "$shell does not complete these options of $command: $(xargs <lacking)"
    done
done
