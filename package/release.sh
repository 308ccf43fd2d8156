#!/usr/bin/env bash
# Makes a release of the last commit: the source archive, Debian packages, the engine of exported
# pages, the npm package if there is one, and the checksums of all. The same commit gives the same
# bytes if compilers and libraries are the same.
#
# usage: package/release.sh FOLDER
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
. "$root/cmake/setup.sh"
[ $# = 1 ] || { say "usage: package/release.sh FOLDER"; exit 64; }
if [ -n "$(git -C "$root" status --porcelain)" ]; then
    say "there are changes that are not committed: a release is made of a commit"
    exit 1
fi
version=$(sed -nE 's/^project\(cascade VERSION ([0-9.]+) .*/\1/p' "$root/CMakeLists.txt")
SOURCE_DATE_EPOCH=$(git -C "$root" log -1 --format=%ct)
export SOURCE_DATE_EPOCH
umask 022

mkdir -p "$1"
folder=$(cd "$1" && pwd -P)
build=${CASCADE_BUILD:-$root/build/release}
log=$build/release.log
mkdir -p "$build"
: >"$log"
install_packages "$log" build tab tests
say "building what is installed (log: $log)"
configure_and_build "$log" "$build" cascade_installed

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git -C "$root" archive --format=tar --prefix="cascade-$version/" HEAD | gzip -9n >"$work/cascade-$version.tar.gz"
(cd "$build" && cpack -B "$work/packages") >>"$log" 2>&1 || { tail -n 20 "$log" >&2; exit 1; }
mv "$work"/packages/*.deb "$work"
cp "$build/engine.wasm" "$work/cascade-engine-$version.wasm"
package=$(cd "$root" && git ls-files '*/package.json' | xargs -r grep -lE '"name": *"cascade' | head -n 1)
if [ -n "$package" ] && command -v npm >/dev/null; then
    (cd "$(dirname "$root/$package")" && npm pack --pack-destination "$work") >>"$log" 2>&1
fi
rm -rf "$work/packages"
(cd "$work" && LC_ALL=C sha256sum -- * >SHA256SUMS)
cp "$work"/* "$folder"
cat "$folder/SHA256SUMS"
