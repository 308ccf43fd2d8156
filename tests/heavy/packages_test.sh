#!/usr/bin/env bash
# The Debian packages in a bare Debian 12, made by debootstrap: lintian finds no error, apt installs them, a user does
# ten tasks with them, and after apt has removed them nothing is left. Needs root and Debian's archive.
set -u
fail() { echo "packages: $*"; exit 1; }
for program in debootstrap lintian desktop-file-validate; do
    PATH=$PATH:/usr/sbin command -v $program >/dev/null || fail "$program is missing; cmake/packages.txt names its package"
done
[ "$(id -u)" = 0 ] || { echo "packages: only root can enter another tree of files"; exit 77; }
[ -z "$SANITIZE" ] || exit 77

# The packages, twice: they have the same bytes.
export SOURCE_DATE_EPOCH=1700000000
umask 022
cmake --build "$BUILD" --target cascade_installed >build.log 2>&1 || fail "the build failed: $(tail -n 5 build.log)"
for folder in made again; do
    rm -rf $folder
    (cd "$BUILD" && cpack -B "$OLDPWD/$folder") >cpack.log 2>&1 || fail "cpack failed: $(tail -n 20 cpack.log)"
done
for deb in made/*.deb; do
    cmp "$deb" "again/$(basename "$deb")" || fail "$deb is not the same when it is made again"
done
[ "$(ls made/*.deb | wc -l)" = 3 ] || fail "there are not three packages: $(ls made)"
lintian --fail-on error made/*.deb >lintian.log 2>&1 || fail "lintian: $(cat lintian.log)"
desktop-file-validate "$SOURCE/package/cascade.desktop" || fail "the .desktop file is wrong"

# A bare Debian, kept for the next time.
if [ ! -f bare.tar ]; then
    rm -rf tree
    PATH=$PATH:/usr/sbin debootstrap --variant=minbase bookworm tree http://deb.debian.org/debian >debootstrap.log 2>&1 ||
        fail "debootstrap failed: $(tail -n 5 debootstrap.log)"
    tar -cf bare.part tree && mv bare.part bare.tar
fi
rm -rf tree && tar -xf bare.tar || fail "the tree could not be unpacked"
cp /etc/resolv.conf tree/etc/resolv.conf
cp /etc/apt/apt.conf.d/*proxy* tree/etc/apt/apt.conf.d/ 2>/dev/null
printf '#!/bin/sh\nexit 101\n' >tree/usr/sbin/policy-rc.d && chmod +x tree/usr/sbin/policy-rc.d
cp made/*.deb "$SOURCE/tests/heavy/packages_tasks.sh" tree/opt/
# In a new namespace, so that no process or mount is left when it ends.
unshare --mount --pid --fork --kill-child bash -c '
    mount -t proc proc tree/proc && mount --bind /dev tree/dev && exec chroot tree bash /opt/packages_tasks.sh' ||
    fail "a task failed"
rm -rf tree
