#!/usr/bin/env bash
# Installs and builds everything that `cascade` needs to run with the given arguments.
set -u

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P) || exit 1
. "$root/cmake/fresh.sh"
. "$root/cmake/setup.sh"
log=$build/log

mkdir -p "$build" || exit 1
exec 9>"$build/lock"
if ! flock -n 9; then
    say "waiting for another build of this folder to end"
    flock 9
fi
# Another process, which held the lock, may have built the same meanwhile.
is_ready "$@" && exit
: >"$log"
purposes=(build)
needs_engine "$@" && purposes+=(tab)
install_packages "$log" "${purposes[@]}" || exit 1
if ! is_fresh; then
    list_sources >"$build/begun"
    target=cascade_program what="the rest of Cascade, which this command needs"
    if [ "$program" != "$build/cascade" ]; then
        target=cascade_first what="what draws first pictures"
    fi
    if [ -x "$program" ]; then
        say "building what has changed (log: $log)"
    else
        say "building $what: 2 to 4 minutes of processor time, about"
        say "$((3 / $(nproc) + 1)) minutes with the $(nproc) processors here, if they are idle otherwise (log: $log)"
    fi
    configure_and_build "$log" "$build" "$target" || exit 1
    mv "$build/begun" "$build/built"
fi
if needs_engine "$@"; then
    say "building the engine that pages carry, which takes 2 to 4 minutes of processor time"
    configure_and_build "$log" "$build" cascade_engine || exit 1
    touch "$build/engine.wasm"
fi
