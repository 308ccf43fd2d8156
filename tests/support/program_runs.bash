# What tests of the program share: runs of it with their status, and what they print. A test sources
# this file and sets `about`, which begins its messages.

fail() {
    echo "$about: $*"
    echo "--- out"; cat out
    echo "--- err"; cat err
    exit 1
}
# run STATUS ARGUMENTS…: what it prints is in the files out and err.
run() {
    local wanted=$1 got
    shift
    "$CASCADE" "$@" >out 2>err </dev/null
    got=$?
    [ "$got" = "$wanted" ] || fail "cascade $* gave $got, not $wanted"
}
# says FILE TEXT: the text is in the file.
says() { grep -qF -- "$2" "$1" || fail "no '$2' in $1"; }
# write_square: square.obj, a square with texture coordinates, which fill the texture.
write_square() {
    cat >square.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
END
}
