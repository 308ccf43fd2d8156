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
    if [ -x "$build/cascade" ]; then
        say "building what has changed (log: $log)"
    else
        say "building for the first time, which takes 4 to 8 minutes of processor time: about"
        say "$((6 / $(nproc) + 1)) minutes with the $(nproc) processors here, if they are idle otherwise (log: $log)"
    fi
    configure_and_build "$log" "$build" cascade_program || exit 1
    mv "$build/begun" "$build/built"
fi
if needs_engine "$@"; then
    say "building the engine that pages carry, which takes 2 to 4 minutes of processor time"
    configure_and_build "$log" "$build" cascade_engine || exit 1
    touch "$build/engine.wasm"
fi
