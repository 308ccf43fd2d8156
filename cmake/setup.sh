# Shell functions that `cascade` and `tests/run` share: they install missing packages, configure and
# build. Source this file with `root` set to the top folder of the source tree.

say() {
    printf 'cascade: %s\n' "$*" >&2
}

# packages_for PURPOSE…: prints the names of the packages in packages.txt that serve any of these
# purposes.
packages_for() {
    local name purpose command wanted
    while read -r name purpose command; do
        [ -n "$command" ] && command -v "$command" >/dev/null && continue
        for wanted in "$@"; do
            [ "$purpose" = "$wanted" ] && printf '%s\n' "$name"
        done
    done < <(grep -v '^#' "$root/cmake/packages.txt")
    return 0
}

# missing_packages NAME…: prints the names of packages that are not installed.
missing_packages() {
    local installed name
    installed=$(dpkg-query -W -f='${db:Status-Status} ${binary:Package}\n' "$@" 2>/dev/null)
    for name in "$@"; do
        grep -Eq "^installed ${name//+/\\+}(:.*)?$" <<<"$installed" || printf '%s\n' "$name"
    done
}

# install_packages LOG PURPOSE…: installs missing packages. Does nothing on systems other than
# Debian. There CMake reports what it does not find.
install_packages() {
    local log=$1 list missing as_root=()
    shift
    command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || return 0
    mapfile -t list < <(packages_for "$@")
    [ "${#list[@]}" -gt 0 ] || return 0
    mapfile -t missing < <(missing_packages "${list[@]}")
    [ "${#missing[@]}" -gt 0 ] || return 0
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            say "these packages are missing: ${missing[*]}"
            say "install them as root: apt-get install --no-install-recommends ${missing[*]}"
            return 1
        fi
        as_root=(sudo)
    fi
    say "installing ${missing[*]}"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
        apt-get -o DPkg::Lock::Timeout=900)
    if ! { "${apt[@]}" update &&
        "${apt[@]}" install -y --no-install-recommends "${missing[@]}"; } \
        </dev/null >>"$log" 2>&1; then
        say "the packages could not be installed; the end of $log:"
        tail -n 20 "$log" >&2
        return 1
    fi
}

# compilers: prints how many compilers may run at a time: at most one for each processor and one for
# each GiB of free memory.
compilers() {
    local free
    free=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo 2>/dev/null)
    if [ -n "$free" ] && [ "$free" -lt "$(nproc)" ]; then
        [ "$free" -ge 1 ] || free=1
        printf '%s\n' "$free"
    else
        nproc
    fi
}

# time_left SECONDS DONE ALL: prints the remaining time, as "about 3 minutes left", once a twentieth
# is done.
time_left() {
    [ $(($2 * 20)) -ge "$3" ] || return 0
    local seconds=$(($1 * ($3 - $2) / $2))
    if [ "$seconds" -ge 90 ]; then
        printf ', about %d minutes left' $(((seconds + 30) / 60))
    else
        printf ', about a minute left'
    fi
}

# progress LOG SECONDS: prints the number of steps that are done, as logged by ninja or make, and
# the remaining time.
progress() {
    local step
    step=$(tail -c 4000 "$1" | grep -oE '^\[ *[0-9]+(/[0-9]+|%)\]' | tail -n 1 | tr -d '[] ')
    case $step in
        */*) printf '%s steps%s' "${step/\// of }" "$(time_left "$2" "${step%/*}" "${step#*/}")" ;;
        *%) printf '%s%s' "$step" "$(time_left "$2" "${step%\%}" 100)" ;;
    esac
}

# show_progress LOG: shows the progress until it is killed. In a terminal it changes one line.
# Elsewhere it prints a line every half minute.
show_progress() {
    local line begun=$SECONDS next=${CASCADE_PROGRESS_SECONDS:-30}
    # Ends if the script was interrupted, because an interruption does not reach a process in the
    # background.
    while sleep 0.5 && kill -0 $$ 2>/dev/null; do
        if [ ! -t 2 ]; then
            [ $((SECONDS - begun)) -ge "$next" ] || continue
            next=$((next + ${CASCADE_PROGRESS_SECONDS:-30}))
        fi
        line=$(progress "$1" $((SECONDS - begun)))
        if [ -z "$line" ]; then
            continue
        elif [ -t 2 ]; then
            printf '\rcascade: %s\033[K' "$line" >&2
        else
            say "$line"
        fi
    done
}

# explain_failure LOG: prints the end of the log of a failed build, and the cause if it is a known
# one.
explain_failure() {
    say "the build failed; the end of $1:"
    tail -n 40 "$1" >&2
    if grep -q 'No space left on device' "$1"; then
        say "the disk is full: a build takes 1 GiB"
    elif grep -qE 'Killed signal|Cannot allocate memory|out of memory' "$1"; then
        say "there was not enough memory: a compiler takes up to 1 GiB"
    fi
}

# configure_and_build LOG BUILD_FOLDER TARGET [CMAKE OPTION]…
configure_and_build() {
    local log=$1 build=$2 target=$3 jobs
    shift 3
    # A build folder contains absolute paths, so it is configured anew if the source tree was moved
    # or copied.
    local home
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt" 2>/dev/null)
    if [ -n "$home" ] && [ "$home" != "$root" ]; then
        rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles"
    fi
    local options=(-DCMAKE_BUILD_TYPE=Release "$@")
    if [ ! -e "$build/CMakeCache.txt" ] && command -v ninja >/dev/null; then
        options+=(-G Ninja)
    fi
    if command -v ccache >/dev/null; then
        options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
        export CCACHE_SLOPPINESS=pch_defines,time_macros  # ccache otherwise ignores precompiled headers.
    fi
    jobs=$(compilers)
    [ "$jobs" = "$(nproc)" ] || say "$jobs of $(nproc) processors compile, since a compiler takes up to 1 GiB of memory"
    local watcher status=0
    show_progress "$log" 9>&- &
    watcher=$!
    { cmake -S "$root" -B "$build" "${options[@]}" &&
        cmake --build "$build" --target "$target" --parallel "$jobs"; } \
        </dev/null >>"$log" 2>&1 || status=1
    kill "$watcher" 2>/dev/null
    wait "$watcher" 2>/dev/null
    [ ! -t 2 ] || printf '\r\033[K' >&2
    [ "$status" = 0 ] || explain_failure "$log"
    return "$status"
}
