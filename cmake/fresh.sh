# Shell functions that tell whether the program must be built. Every start of `cascade` runs them,
# so they are plain sh and start only one process. Source this file with `root` set to the top
# folder of the source tree.

build=$root/build/release
# The first program (cmake/first.cmake) is built until it needs the whole one and says so
# (app/left_out.cpp).
program=$build/cascade
[ -x "$program" ] || [ -n "${CASCADE_WHOLE-}" ] || program=$build/cascade-first

# list_sources: prints the files and folders from which the program is built, relative to `root`. A
# build writes this list to build/release/built before it begins.
list_sources() {
    printf 'include page cmake CMakeLists.txt '
    sed -n 's/^\([a-z][a-z]*\).*/\1/p' "$root/cmake/rooms.txt" | sort -u | tr '\n' ' '
    echo
}

# is_fresh: true if no source has changed since the last build began. Folders count, too, because
# they change when a file is added or removed. Compares the time of the last status change, because
# a copied file may keep an old time of modification.
is_fresh() {
    [ -x "$program" ] && [ -s "$build/built" ] || return 1
    read -r sources <"$build/built"
    # An optional library may have been installed since the last build.
    for library in /usr/include/openvdb/openvdb.h /usr/include/hdf5/serial/hdf5.h /usr/lib/*/openmpi/include/mpi.h /usr/include/*/mpich/mpi.h; do
        [ ! -e "$library" ] || sources="$sources $library"
    done
    changed=$(CDPATH= cd -- "$root" && exec find $sources -cnewer build/release/built -print -quit 2>/dev/null) && [ -z "$changed" ]
}

# Pages written by `cascade export` carry an engine, whose build takes other packages and another
# compiler. It is built when the first page is written.
needs_engine() { [ "${1-}" = export ]; }
is_engine_fresh() { [ "$build/engine.wasm" -nt "$build/built" ]; }

# is_ready ARGUMENT…: true if the program can run with these arguments.
is_ready() { is_fresh && { ! needs_engine "$@" || is_engine_fresh; }; }
