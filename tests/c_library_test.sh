#!/usr/bin/env bash
# The library can be used from C99: tests/embedding/use_library.c is compiled without extensions or
# warnings, loads the library with dlopen, and calls every function of cascade_c.h.
set -eu
"${CC:-cc}" -std=c99 -pedantic-errors -Wall -Wextra -Werror -D_POSIX_C_SOURCE=200809L -I "$SOURCE/include" \
    ${SANITIZE:+-fsanitize=$SANITIZE} "$SOURCE/tests/embedding/use_library.c" -o use_library -ldl -lm -pthread
declared=$(grep -oE 'cascade_[a-z_]+\(' "$SOURCE/include/cascade/cascade_c.h" | grep -c .)
[ "$declared" -ge 37 ] || { echo "the check itself does not work ($declared functions)"; exit 1; }
for name in $(grep -E '^CASCADE_C_API|^ +cascade_[a-z_]+\(' "$SOURCE/include/cascade/cascade_c.h" |
    grep -oE 'cascade_[a-z_]+\(' | tr -d '(' | sort -u); do
    grep -q "X(${name#cascade_})" "$SOURCE/tests/embedding/use_library.c" ||
        { echo "$name is not used"; exit 1; }
done
rm -rf saved c.png
./use_library "$BUILD/libcascade.so.0" "$PWD"
