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
