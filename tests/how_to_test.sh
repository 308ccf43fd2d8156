#!/usr/bin/env bash
# Every page of docs/how_to works: its scripts are written to the files that their first lines name, and its commands
# run one after the other in this folder. Each command must succeed and may not print an error.
set -u
failed=0
cascade() { "$CASCADE" "$@"; }
export -f cascade
export CASCADE

for page in "$SOURCE"/docs/how_to/*.md; do
    name=$(basename "$page" .md)
    rm -rf "$name" && mkdir "$name" || exit 1
    awk -v folder="$name" '
        /^```/ { kind = $0 == "```" ? "" : substr($0, 4); is_first = 1; next }
        kind ~ /^cascade/ && is_first { file = $2; sub(/:$/, "", file); is_first = 0; at = 0 }
        kind ~ /^cascade/ { print > (folder "/" file) }
        kind == "sh" { print > (folder "/commands") }
    ' "$page"
    [ -e "$name/commands" ] || continue
    while read -r command; do
        if ! (cd "$name" && eval "$command") >"$name/out" 2>&1 </dev/null; then
            echo "how_to: $name.md: '$command' fails:"
            cat "$name/out"
            failed=1
        fi
    done <"$name/commands"
done
exit $failed
