# Runs in the bare Debian of packages_test.sh, as root: installs the packages in /opt, does the tasks as a user, and
# removes the packages.
set -u
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root
fail() { echo "packages: task $task: $*"; exit 1; }
install() { apt-get install -y --no-install-recommends "$@" >/opt/apt.log 2>&1 || fail "apt: $(tail -n 8 /opt/apt.log)"; }
task=install

# files: all files and folders outside of what apt itself keeps.
files() { find / -xdev \( -path /proc -o -path /dev -o -path /opt -o -path /tmp -o -path /home -o -path /var/lib -o -path /var/cache -o -path /var/log \) -prune -o -print | sort; }
files >/opt/before
apt-get update >/opt/apt.log 2>&1 || fail "apt: $(tail -n 5 /opt/apt.log)"
useradd -m user
install /opt/*.deb
installed=$(dpkg-query -W -f '${Package}\n' | grep -E '^(cascade-patterns|libcascade-dev|python3-cascade)$' | xargs)
[ "$installed" = 'cascade-patterns libcascade-dev python3-cascade' ] || fail "installed are $installed"

# user COMMAND: runs a command of bash as the user, in an empty folder of the task.
user() {
    mkdir -p "/home/user/$task" && chown user: "/home/user/$task"
    runuser -u user -- env HOME=/home/user bash -c "cd /home/user/$task && set -eu && $1" >/opt/out 2>&1 ||
        fail "$1: $(tail -n 10 /opt/out)"
}

task=without_recommended
user 'cascade examples leopard > leopard.cascade && cascade run leopard.cascade --steps 3000 && [ -s leopard.png ]'
grep -q 'code generator could not be loaded' /opt/out || fail "it does not say that LLVM is missing: $(cat /opt/out)"
install $(dpkg-query -W -f '${Recommends}' cascade-patterns | sed 's/([^)]*)//g; s/,//g')

task=1_run
user 'cascade examples leopard > leopard.cascade && cascade run leopard.cascade --steps 300 -q && [ -s leopard.png ] &&
    cascade run leopard.png -q -o again.png && cmp leopard.png again.png'
[ ! -s /opt/out ] || fail "it said $(cat /opt/out)"
task=2_models
user 'cascade run "$(cascade examples on_models/leopard --path)" --steps 20 --cells 2000 --size 320x240 -q -o leopard.png -o leopard.glb &&
    [ -s leopard.png ] && [ -s leopard.glb ]'
task=3_imex
user 'cascade new swift_hohenberg > labyrinth.cascade && cascade run labyrinth.cascade --solver imex --steps 50 --features -q'
task=4_maps
user 'cascade run "$(cascade examples lava --path)" --steps 20 -q -o lava.glb --bake 256 --exr && ls *.exr'
task=5_film
user 'cascade examples gray_scott_worms -o worms.cascade && cascade run worms.cascade --steps 100 --set interval=20 -q -o worms.gif &&
    cascade run worms.cascade --steps 10 -q -o worms.svg && [ -s worms.gif ] && [ -s worms.svg ]'
task=6_analysis
user 'cascade new brusselator -o mine.cascade && cascade check mine.cascade && cascade analyze mine.cascade -o waves.pdf &&
    cascade fmt --check mine.cascade && [ -s waves.pdf ]'
task=7_pages
user 'cascade examples leopard > leopard.cascade && cascade export leopard.cascade && [ "$(stat -c %s leopard.html)" -gt 1000000 ]'
user '(timeout 10 cascade view leopard.cascade --no-browser >address 2>/dev/null || true) & sleep 5;
    address=$(head -n 1 address); port=${address#*:*:}; port=${port%%/*}; exec 3<>/dev/tcp/127.0.0.1/$port;
    printf "GET /%s HTTP/1.0\r\nHost: 127.0.0.1:$port\r\n\r\n" "${address#http://*/}" >&3; timeout 3 cat <&3 | head -n 1 | grep 200; wait'
task=8_programs
install gcc libc6-dev pkg-config
cat >/opt/main.c <<'END'
#include <cascade/cascade_c.h>
#include <stdio.h>
int main(void) {
    cascade_pattern* spots;
    if (cascade_create("stage one: turing_spots { iterations: 5 }", NULL, &spots) != CASCADE_OK) return 1;
    if (cascade_run(spots, NULL, NULL) != CASCADE_OK) return 2;
    puts(cascade_version());
    return 0;
}
END
user 'cc -std=c99 /opt/main.c $(pkg-config --cflags --libs cascade) -o main && [ "$(./main)" = "$(pkg-config --modversion cascade)" ] &&
    cascade compile "$(cascade examples c_program/spots --path)" --per-cell ka -o step.o && [ -s step.h ]'
task=9_python
user 'python3 -c "
import cascade
spots = cascade.Pattern(\"stage one: turing_spots { iterations: 20 }\")
spots.run(progress=False)
assert spots[\"b\"].mean() > 0
spots.write_picture(\"spots.png\")"'
task=10_sweep
user 'cascade new gray_scott > gs.cascade && cascade sweep gs.cascade --steps 20 --vary feed=0.03,0.04 -q && [ -s gs_sweep/sheet.png ] &&
    cascade run gs.cascade --steps 20 --save half -q && cascade run --resume half -q -o half.png && cascade systems gray_scott | grep -q "∂u/∂t"'

task=help
gzip -dc /usr/share/man/man1/cascade-run.1.gz | grep -q 'SH SYNOPSIS' || fail "there is no manual page"
user 'source /usr/share/bash-completion/completions/cascade; COMP_WORDS=(cascade swe); COMP_CWORD=1; _cascade; [ "${COMPREPLY[*]}" = sweep ]'
user '[ -f /usr/share/doc/cascade-patterns/examples/leopard.cascade ] && [ -f /usr/share/doc/cascade-patterns/spec/grammar.md ]'

task=removal
dpkg -L cascade-patterns libcascade-dev python3-cascade | sort -u >/opt/shipped
apt-get purge -y --autoremove cascade-patterns libcascade-dev python3-cascade >/opt/apt.log 2>&1 || fail "apt: $(tail -n 8 /opt/apt.log)"
grep -qi 'not empty' /opt/apt.log && fail "$(grep -i 'not empty' /opt/apt.log)"
files >/opt/after
left=$(comm -13 /opt/before /opt/after | grep -Fxf /opt/shipped | while read -r path; do dpkg -S "$path" >/dev/null 2>&1 || echo "$path"; done)
left+=$(grep -i cascade /opt/after)
[ -z "$left" ] || fail "left behind: $left"
echo "ten tasks are done, and nothing is left"
