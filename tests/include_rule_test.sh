#!/usr/bin/env bash
# Rooms include downwards only, and LLVM's headers stay in jit/. Needs no build: reads $SOURCE.
set -u
cd "${SOURCE:-$(dirname "${BASH_SOURCE[0]}")/..}" || exit 1

rooms='core ir lang jit solvers picture measure mesh surface render export run app'
declare -A may=(
    [core]='core'
    [ir]='ir core'
    [lang]='lang ir core'
    [jit]='jit ir core'
    [solvers]='solvers ir core'
    [picture]='picture core'
    [measure]='measure core'
    [mesh]='mesh core'
    [surface]='surface mesh core'
    [render]='render picture core'
    [export]='export surface mesh picture core'
    [run]='run export render surface mesh measure picture solvers jit lang ir core cascade'
    [app]='app run picture measure lang core'
)

# Reads "FILE:#include "PATH"" lines of one room, prints those that break the rule.
offenders() {
    local room=$1 line path target
    while IFS= read -r line; do
        path=${line#*include \"}
        target=${path%%/*}
        [[ " ${may[$room]} " == *" $target "* ]] || printf '%s\n' "$line"
    done
}

broken=''
counted=0
for room in $rooms; do
    includes=$(grep -rEo --include='*.h' --include='*.cpp' '^ *# *include "[^"]+"' "$room")
    counted=$((counted + $(grep -c . <<<"$includes")))
    broken+=$([ -z "$includes" ] || offenders "$room" <<<"$includes")
    if [ "$room" != jit ]; then
        broken+=$(grep -rE --include='*.h' --include='*.cpp' 'include *[<"](llvm|llvm-c)/' "$room")
    fi
    [ "$room" = app ] || broken+=$(grep -rnE --include='*.h' --include='*.cpp' \
        'include *<(CLI/|histedit)' "$room")
done

# A rule that nothing can break would not be noticed: these must be found.
made_up=$(offenders core <<<'core/x.h:#include "ir/y.h"'; offenders lang <<<'lang/x.h:#include "jit/jit.h"')
if [ "$(grep -c . <<<"$made_up")" != 2 ] || [ "$counted" -lt 50 ]; then
    echo "the check itself does not work ($counted includes read)"
    exit 1
fi
if [ -n "$broken" ]; then
    echo "a room includes what it may not (docs/architecture.md has the table):"
    echo "$broken"
    exit 1
fi
echo "$counted includes, all downwards"
