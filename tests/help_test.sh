#!/bin/bash
# spec/command_line.md names every option of every command's --help and every command of the prompt.
set -u
page=$SOURCE/spec/command_line.md
failed=0
count=0

expect_named() {
    count=$((count + 1))
    if ! grep -qF -- "\`$1" "$page"; then
        echo "help: spec/command_line.md does not name $1"
        failed=1
    fi
}

for command in run sweep continue check analyze bench compile systems new import fmt mesh repl view lsp export; do
    for option in $("$CASCADE" $command --help | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
        [ "$option" = --help ] || expect_named "$option"
    done
    grep -q "cascade $command" "$page" || { echo "help: no $command"; failed=1; }
done 2>/dev/null
for command in $(printf ':help\n' | "$CASCADE" repl 2>&1 | grep -oE '^ +:[a-z]+'); do
    expect_named "$command"
done
[ "$count" -gt 30 ] || { echo "help: only $count names were looked at"; failed=1; }
exit $failed
