#!/usr/bin/env bash
# The commands of docs/tutorial.md do what it says, with the script that stands there. tests/page/tutorial.mjs follows
# its steps on the page.
set -u
fail() { echo "$*"; exit 1; }

sed -n '/^```cascade$/,/^```$/p' "$SOURCE/docs/tutorial.md" | sed '/^```/d' >new.cascade
sed -n '/^```sh$/,/^```$/p' "$SOURCE/docs/tutorial.md" | sed '/^```/d; /cascade view/d' >commands
rm -rf new.png larger.png animal.png new_sweep
count=0
while read -r program words; do
    [ "$program" = ./cascade ] || fail "what is '$program'?"
    # Everything after '#' explains.
    read -ra words <<<"${words%%#*}"
    "$CASCADE" "${words[@]}" --quiet >out 2>&1 </dev/null || fail "cascade ${words[*]}: $(cat out)"
    count=$((count + 1))
done <commands
[ "$count" = 5 ] || fail "$count commands instead of 5"
for file in new.png larger.png animal.png new_sweep/sheet.png; do
    [ -s "$file" ] || fail "$file is missing"
done

"$CASCADE" check "$SOURCE/page/film.cascade" >out 2>&1 || fail "the script of README's first picture is wrong: $(cat out)"
