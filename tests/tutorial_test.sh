#!/usr/bin/env bash
# The commands of docs/tutorial.md work with the script in it. tests/page/tutorial.mjs follows the steps of the tutorial
# on the page.
set -u
fail() { echo "$*"; exit 1; }

sed -n '/^```cascade$/,/^```$/p' "$SOURCE/docs/tutorial.md" | sed '/^```/d' >new.cascade
sed -n '/^```sh$/,/^```$/p' "$SOURCE/docs/tutorial.md" | sed '/^```/d; /cascade view/d' >commands
rm -rf new.png larger.png animal.png new_sweep
count=0
while read -r program words; do
    [ "$program" = ./cascade ] || fail "what is '$program'?"
    # Text after '#' is a comment.
    read -ra words <<<"${words%%#*}"
    count=$((count + 1))
    quiet=(--quiet)
    if [ "${words[0]}" = export ]; then
        [ -z "${SANITIZE:-}" ] || continue  # These builds have no engine.
        quiet=()
    fi
    "$CASCADE" "${words[@]}" ${quiet[@]+"${quiet[@]}"} >out 2>&1 </dev/null || fail "cascade ${words[*]}: $(cat out)"
done <commands
[ "$count" = 6 ] || fail "$count commands instead of 6"
for file in new.png larger.png animal.png new_sweep/sheet.png; do
    [ -s "$file" ] || fail "$file is missing"
done

"$CASCADE" check "$SOURCE/page/film.cascade" >out 2>&1 || fail "the script of README's first picture is wrong: $(cat out)"
