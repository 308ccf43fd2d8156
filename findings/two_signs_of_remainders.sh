#!/usr/bin/env bash
# The remainder of numexpr has the sign of numpy for floats, and the sign of C for whole numbers.
#
# Expected. numexpr evaluates expressions in the way of numpy, faster. -1 % 4 is 3 in Python and numpy, for floats and
# whole numbers alike: the way to reach the left neighbour of cell 0 in a periodic row of 4 cells.
#
# What happens. For floats the result is 3, and for arrays of whole numbers -1, as in C. So x % 1 keeps positions in a
# periodic box, but i % n gives negative indices. numpy counts those from the end, so they even find the right cell;
# but sums of indices, comparisons and other libraries go wrong. Other operators are as in numpy: / is a true division
# of whole numbers, and -7 >> 1 is -4.
#
# Workaround: (i % n + n) % n, or i * 1.0 if the numbers are small.
#
# Seen with python3-numexpr 2.8.4 and python3-numpy 1.24.2 of Debian 12.
set -eu
for p in python3-numexpr=2.8.4; do
  name=${p%%=*}
  if ! dpkg-query -W -f '${Version}' "$name" 2>/dev/null | grep -q .; then
    apt-get update -qq >/dev/null 2>&1 || true
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$name" >/dev/null 2>&1 ||
      { echo "could not install $name (Debian 12, as root)"; exit 2; }
  fi
  version=$(dpkg-query -W -f '${Version}' "$name" 2>/dev/null || true)
  case "${version#*:}" in
    "${p#*=}"[-+~]*) echo "$name $version" ;;
    *) echo "this was seen with $name ${p#*=}; here it is '${version:-not the one of Debian}'"; exit 2 ;;
  esac
done
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
cat > try.py <<'EOF_PY'
import numexpr
import numpy
for kind in "i4", "i8", "f4", "f8":
    i = numpy.array([-9, -4, -1, 0, 5], kind)
    for n in 4, -4:
        print(f"{kind}, {i.astype(int).tolist()} % {n}: numexpr {numexpr.evaluate('i % n').astype(int).tolist()},",
              f"numpy {(i % n).astype(int).tolist()}")
i = numpy.array([-7, 7])
for e in "i / 2", "i >> 1", "(i % 4 + 4) % 4":
    print(f"[-7, 7], {e}: numexpr {numexpr.evaluate(e).tolist()}, numpy {eval(e).tolist()}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
i4, [-9, -4, -1, 0, 5] % 4: numexpr [-1, 0, -1, 0, 1], numpy [3, 0, 3, 0, 1]
i4, [-9, -4, -1, 0, 5] % -4: numexpr [-1, 0, -1, 0, 1], numpy [-1, 0, -1, 0, -3]
i8, [-9, -4, -1, 0, 5] % 4: numexpr [-1, 0, -1, 0, 1], numpy [3, 0, 3, 0, 1]
i8, [-9, -4, -1, 0, 5] % -4: numexpr [-1, 0, -1, 0, 1], numpy [-1, 0, -1, 0, -3]
f4, [-9, -4, -1, 0, 5] % 4: numexpr [3, 0, 3, 0, 1], numpy [3, 0, 3, 0, 1]
f4, [-9, -4, -1, 0, 5] % -4: numexpr [-1, 0, -1, 0, -3], numpy [-1, 0, -1, 0, -3]
f8, [-9, -4, -1, 0, 5] % 4: numexpr [3, 0, 3, 0, 1], numpy [3, 0, 3, 0, 1]
f8, [-9, -4, -1, 0, 5] % -4: numexpr [-1, 0, -1, 0, -3], numpy [-1, 0, -1, 0, -3]
[-7, 7], i / 2: numexpr [-3.5, 3.5], numpy [-3.5, 3.5]
[-7, 7], i >> 1: numexpr [-4, 3], numpy [-4, 3]
[-7, 7], (i % 4 + 4) % 4: numexpr [1, 3], numpy [1, 3]
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
