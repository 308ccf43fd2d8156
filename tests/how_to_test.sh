#!/usr/bin/env bash
# Every page of docs/how_to and docs/explanation works, and so does docs/tutorial_text.md: its scripts and programs are
# written to the files that their first lines name, and its commands run one after the other in this folder. Each
# command must succeed and may not print an error.
set -u
failed=0 commands=0
cascade() { "$CASCADE" "$@"; }
# The library of the build instead of an installed one.
pkg-config() { echo "-I$SOURCE/include -L$BUILD -lcascade -Wl,-rpath,$BUILD"; }
export -f cascade pkg-config
export CASCADE

for page in "$SOURCE"/docs/{how_to,explanation}/*.md "$SOURCE/docs/tutorial_text.md"; do
    name=$(basename "$page" .md)
    [ "$name" != c ] || { [ -z "${SANITIZE:-}" ] && [ "$CASCADE_JIT" = 1 ]; } || continue
    rm -rf "$name" && mkdir "$name" || exit 1
    awk -v folder="$name" '
        /^```/ { kind = $0 == "```" ? "" : substr($0, 4); is_first = 1; next }
        kind ~ /^(cascade|c)$/ && is_first { file = $2; sub(/:$/, "", file); is_first = 0 }
        kind ~ /^(cascade|c)$/ { print > (folder "/" file) }
        kind == "sh" { print > (folder "/commands") }
    ' "$page"
    [ -e "$name/commands" ] || continue
    while read -r command; do
        commands=$((commands + 1))
        if ! (cd "$name" && eval "$command") >"$name/out" 2>&1 </dev/null || grep -q '^error' "$name/out"; then
            echo "how_to: $name.md: '$command' fails:"
            cat "$name/out"
            failed=1
        fi
    done <"$name/commands"
done
[ "$commands" -ge 50 ] || { echo "how_to: only $commands commands"; failed=1; }
exit $failed
