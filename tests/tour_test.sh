#!/usr/bin/env bash
# The dumps in docs/tour.md agree with the program's output for the script on that page.
#
# A block "```text dump=WHAT" is compared with `cascade check tour.cascade --dump WHAT`: its lines must occur there in
# this order, each as the beginning of a line. Other lines may be in between. Widths of vectors, and whether a vector is
# loaded or carried from one iteration to the next, depend on the processor; they and the numbers of LLVM's values count
# as equal. In assembly a line is an instruction's name.
set -u
page=$SOURCE/docs/tour.md
fail() { echo "$*"; exit 1; }

sed -n '/^```cascade$/,/^```$/p' "$page" | sed '/^```/d' >tour.cascade
[ -s tour.cascade ] || fail "the page has no script"

normalised() { sed -E 's/<[0-9]+ x /<N x /g; s/%carried[0-9]*/%0/g; s/^[[:space:]]+//; s/%[0-9]+( = f|, |$)/%_\1/g; s/%[0-9]+$/%_/'; }

# Is the first file a subsequence of the second, line by line? Prints the first line that is missing.
first_missing() {
    awk 'NR == FNR { want[++count] = $0; next }
         next_line <= count && index($0, want[next_line]) == 1 { ++next_line }
         BEGIN { next_line = 1 }
         END { if (next_line <= count) print want[next_line] }' "$1" "$2"
}

blocks=0
compare() {
    local what=$1 missing
    "$CASCADE" check tour.cascade --dump "$what" >dump 2>err || fail "--dump $what: $(cat err)"
    normalised <block >wanted
    normalised <dump >found
    missing=$(first_missing wanted found)
    [ -z "$missing" ] || fail "docs/tour.md: --dump $what does not print '$missing' there"
    blocks=$((blocks + 1))
}

what=''
while IFS= read -r line; do
    case $line in
        '```text dump='*) what=${line#*dump=}; : >block ;;
        '```')
            if [ -n "$what" ] && { [ "$CASCADE_JIT" = 1 ] || [[ $what != llvm && $what != asm ]]; } &&
                { [ "$what" != asm ] || [ "$(uname -m)" = x86_64 ]; }; then
                compare "$what"
            fi
            what='' ;;
        *) [ -z "$what" ] || printf '%s\n' "$line" >>block ;;
    esac
done <"$page"
[ "$blocks" -ge 6 ] || fail "only $blocks dumps were compared"

# The comparison can fail.
printf '%s\n' a c >wanted
printf '%s\n' c b a >found
[ "$(first_missing wanted found)" = c ] || fail "the comparison itself does not work"
