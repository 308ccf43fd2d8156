# Shell functions shared by `cascade` and `tests/run`: install missing packages, configure, build.
# Source it with `root` set to the top folder of the source tree.

say() {
    printf 'cascade: %s\n' "$*" >&2
}

# packages_for PURPOSE…: prints names from packages.txt.
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

# missing_packages NAME…: prints those that are not installed.
missing_packages() {
    local installed name
    installed=$(dpkg-query -W -f='${db:Status-Status} ${binary:Package}\n' "$@" 2>/dev/null)
    for name in "$@"; do
        grep -Eq "^installed ${name//+/\\+}(:.*)?$" <<<"$installed" || printf '%s\n' "$name"
    done
}

# install_packages LOG PURPOSE…: installs missing packages. Does nothing on systems other than Debian;
# there CMake reports what it does not find.
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

# time_left SECONDS DONE ALL: prints "about 3 minutes left" once a twentieth is done.
time_left() {
    [ $(($2 * 20)) -ge "$3" ] || return 0
    local seconds=$(($1 * ($3 - $2) / $2))
    if [ "$seconds" -ge 90 ]; then
        printf ', about %d minutes left' $(((seconds + 30) / 60))
    else
        printf ', about a minute left'
    fi
}

# show_progress LOG: shows the number of steps done, as ninja and make log it, and the time left, until
# it is killed.
show_progress() {
    local line begun=$SECONDS
    while sleep 0.5; do
        line=$(tail -c 4000 "$1" | grep -oE '^\[ *[0-9]+(/[0-9]+|%)\]' | tail -n 1 | tr -d '[] ')
        case $line in
            */*) printf '\rcascade: %s steps%s\033[K' "${line/\// of }" \
                "$(time_left $((SECONDS - begun)) "${line%/*}" "${line#*/}")" >&2 ;;
            *%) printf '\rcascade: %s%s\033[K' "$line" \
                "$(time_left $((SECONDS - begun)) "${line%\%}" 100)" >&2 ;;
        esac
    done
}

# configure_and_build LOG BUILD_FOLDER TARGET [CMAKE OPTION]…
configure_and_build() {
    local log=$1 build=$2 target=$3
    shift 3
    # A build folder holds absolute paths, so a moved or copied tree is configured anew.
    local home
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt" 2>/dev/null)
    if [ -n "$home" ] && [ "$home" != "$root" ]; then
        rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles"
    fi
    local options=(-DCMAKE_BUILD_TYPE=Release "$@")
    if [ ! -e "$build/CMakeCache.txt" ] && command -v ninja >/dev/null; then
        options+=(-G Ninja)
    fi
    command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    local watcher='' status=0
    if [ -t 2 ]; then
        show_progress "$log" &
        watcher=$!
    fi
    { cmake -S "$root" -B "$build" "${options[@]}" &&
        cmake --build "$build" --target "$target" --parallel "$(nproc)"; } \
        </dev/null >>"$log" 2>&1 || status=1
    if [ -n "$watcher" ]; then
        kill "$watcher" 2>/dev/null
        wait "$watcher" 2>/dev/null
        printf '\r\033[K' >&2
    fi
    if [ "$status" != 0 ]; then
        say "the build failed; the end of $log:"
        tail -n 40 "$log" >&2
        return 1
    fi
}
