#!/usr/bin/env bash
# The programs of bench/one_step compute the same step as Cascade, and the lines of code in docs/one_step.md are theirs.
set -u
fail() { echo "one_step: $*"; exit 1; }

count=0
while IFS= read -r line; do
    grep -qF -- "$line" "$SOURCE"/bench/one_step/* || fail "no program contains '$line'"
    count=$((count + 1))
done < <(sed -nE '/^```(python|cpp|cascade)$/,/^```$/{/^```/d;s/^ +//;/./p}' "$SOURCE/docs/one_step.md")
[ "$count" -ge 10 ] || fail "the page has only $count lines of code"

[ -z "${SANITIZE:-}" ] && [ "$CASCADE_JIT" = 1 ] || exit 77
PYTHON=''
for python in python3 /usr/bin/python3; do
    "$python" -c 'import numpy' 2>/dev/null && PYTHON=$python && break
done
[ -n "$PYTHON" ] || { echo "one_step: NumPy is missing"; exit 77; }
export PYTHON
"$SOURCE/bench/one_step.sh" "$CASCADE" --check >said 2>&1 || fail "$(cat said)"
cat said
