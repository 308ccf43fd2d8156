#!/usr/bin/env bash
# `cascade lsp` as editors use it: thirty requests by the client library of Visual Studio Code, and the ends of a
# session. Exit code 77 means that the library could not be installed.
set -u
fail() { echo "language server: $*"; exit 1; }

# Each wrong stream ends the server with a sentence, and a stream that ends without `shutdown` with status 1.
ends() {
    local status=$1 words=$2
    timeout 60 "$CASCADE" lsp >out 2>err
    local found=$?
    [ $found = "$status" ] || fail "'$words': status $found: $(cat err)"
    [ -z "$words" ] || grep -qF -- "$words" out err || fail "no '$words' in: $(cat out err)"
}
ends 1 '' </dev/null
ends 3 'not a stream of messages: a line of a header has no colon' < <(printf 'GET / HTTP/1.1\r\n\r\n')
ends 3 'a header has no Content-Length' < <(printf 'Accept: x\r\n\r\n')
ends 3 'Content-Length is not a number of bytes' < <(printf 'Content-Length: ten\r\n\r\n')
ends 3 'a header has more than 4096 bytes' < <(head -c 100000 /dev/zero)
ends 1 '"code":-32700' < <(printf 'Content-Length: 5\r\n\r\n{"id"')
ends 1 '' < <(printf 'Content-Length: 50\r\n\r\n{"id"')
ends 1 '"code":-32002' < <(printf 'Content-Length: 28\r\n\r\n%sContent-Length: 17\r\n\r\n%s' \
    '{"id":1,"method":"shutdown"}' '{"method":"exit"}')
"$CASCADE" lsp --words | grep -q '"functions"' || fail "--words"

[ "$("$CASCADE" lsp --stdio </dev/null; echo $?)" = 1 ] || fail "--stdio"

command -v node >/dev/null && command -v npm >/dev/null || { echo "language server: not tried: node or npm is missing"; exit 77; }
"$SOURCE/tests/lsp/install.sh" || { echo "language server: not tried: the packages of tests/lsp"; exit 77; }
CASCADE_KERNEL_CACHE=$PWD/cache timeout 120 node "$SOURCE/tests/lsp/replay.mjs" "$CASCADE" || fail "see above"
