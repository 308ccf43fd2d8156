#!/usr/bin/env bash
# `cascade fmt` as a user meets it: what is written, what is left alone, exit statuses.
set -u
rm -rf ./*

about="format"
source "$SOURCE/tests/support/program_runs.bash"

printf 'stage  s:turing_spots{iterations:5 ;ka:1/80}' >rough.cascade
printf 'stage s: turing_spots { iterations: 5; ka: 1/80 }\n' >smooth.cascade
printf 'stage s: no_such_system { iterations: 5 }\n' >unknown.cascade
printf 'stage s: turing_spots {\n  a: (1\n}\n' >broken.cascade
cp broken.cascade broken.copy
cp rough.cascade rough.copy

run 64 fmt
run 1 fmt --check rough.cascade smooth.cascade
[ "$(cat out)" = rough.cascade ] && cmp -s rough.cascade rough.copy || fail "--check writes"
run 0 fmt --check smooth.cascade unknown.cascade
[ ! -s out ] || fail "nothing was to be changed"

chmod 640 rough.cascade
ln -s rough.cascade link.cascade
before=$(stat -c %Y.%i smooth.cascade)
run 0 fmt link.cascade smooth.cascade
[ "$(cat out)" = link.cascade ] || fail "what changed is named"
cmp -s rough.cascade smooth.cascade || fail "the style"
[ -L link.cascade ] && [ "$(stat -c %a rough.cascade)" = 640 ] || fail "link or permissions were lost"
[ "$(stat -c %Y.%i smooth.cascade)" = "$before" ] || fail "a good script was written again"
run 0 fmt link.cascade
[ ! -s out ] || fail "twice is not once"

run 2 fmt broken.cascade rough.cascade missing.cascade
grep -q "broken.cascade:2:6: error: this '(' is never closed" err || fail "no message"
grep -q missing.cascade err || fail "a missing script is not told"
cmp -s broken.cascade broken.copy || fail "a broken script was changed"

"$CASCADE" fmt - <rough.copy >out 2>err && cmp -s out smooth.cascade || fail "standard input"
"$CASCADE" fmt --check - <rough.copy >out 2>err
[ $? = 1 ] && [ ! -s out ] || fail "--check of standard input"
"$CASCADE" fmt - <broken.copy >out 2>err
[ $? = 2 ] && [ ! -s out ] && [ -s err ] || fail "broken standard input"

run 0 run smooth.cascade -q -o picture.png
run 2 fmt picture.png
if [ "$(id -u)" != 0 ]; then
    mkdir locked && cp rough.copy locked/rough.cascade && chmod 500 locked
    run 3 fmt locked/rough.cascade
    chmod 700 locked
fi

# The project's own scripts are in the style, but for the recipes that are as the thesis prints them.
grep -rL --include='*.cascade' ' - Turk 1992, Appendix C' "$SOURCE/examples" "$SOURCE/lang/systems" >own
[ "$(wc -l <own)" -ge 100 ] || fail "only $(wc -l <own) scripts of the project"
xargs -d '\n' "$CASCADE" fmt --check <own >out 2>err || fail "not in the style: $(cat out err)"
echo "format: right"
