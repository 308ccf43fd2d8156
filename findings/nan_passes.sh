#!/usr/bin/env bash
# idiff of OpenImageIO passes pictures in which numbers have become NaN or infinite.
#
# Expected. idiff compares two pictures, and tests of renderers and of simulations use its status: 0 if they agree
# within a limit, 2 if they do not. A pixel that is 0 in one picture and NaN in the other is the worst of differences,
# as numpy.allclose and h5diff say.
#
# What happens. If one pixel is NaN or infinite in one of the two pictures, idiff prints PASS; even if all pixels of one
# are NaN. It is so with -fail 0 as well. So a simulation that has blown up passes its test against the reference
# picture, which fails if a number is wrong by .5. oiiotool --diff of the same package fails for one such pixel, but
# passes if all are NaN.
#
# Workaround: oiiotool --stats counts the numbers that are NaN, infinite and finite (last line).
#
# Seen with openimageio-tools 2.4.7.1 of Debian 12.
set -eu
for p in openimageio-tools=2.4.7.1; do
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
python=$(command -v python3 || true)
[ -n "$python" ] || { echo "this script needs Python 3"; exit 2; }
"$python" - <<'EOF_PY'
import struct
nan, inf = float("nan"), float("inf")
for name, row in {"reference": [0, 0.25, 0.5, 1], "wrong": [0.5, 0.25, 0.5, 1], "one_nan": [nan, 0.25, 0.5, 1],
                  "all_nan": [nan] * 4, "one_inf": [inf, 0.25, 0.5, 1]}.items():
    with open(f"{name}.pfm", "wb") as file:
        file.write(b"Pf\n4 1\n-1.0\n" + struct.pack("<4f", *row))
EOF_PY
verdict() { # the last line and the status of a comparison
  local status=0
  "$@" > told 2>&1 || status=$?
  echo "$(grep -oE 'PASS|FAILURE' told | tail -n 1), status $status"
}
for name in reference wrong one_nan all_nan one_inf; do
  echo "$name: idiff $(verdict idiff reference.pfm $name.pfm); idiff -fail 0" \
    "$(verdict idiff -fail 0 -failpercent 0 $name.pfm reference.pfm);" \
    "oiiotool $(verdict oiiotool reference.pfm $name.pfm --diff)"
done | tee seen
counts=$(oiiotool --stats all_nan.pfm | grep -oE '(Nan|Inf|Finite)Count: [0-9]+' | paste -sd ' ')
echo "statistics of all_nan: $counts" | tee -a seen
cat > expected <<'EOF_TXT'
reference: idiff PASS, status 0; idiff -fail 0 PASS, status 0; oiiotool PASS, status 0
wrong: idiff FAILURE, status 2; idiff -fail 0 FAILURE, status 2; oiiotool FAILURE, status 1
one_nan: idiff PASS, status 0; idiff -fail 0 PASS, status 0; oiiotool FAILURE, status 1
all_nan: idiff PASS, status 0; idiff -fail 0 PASS, status 0; oiiotool PASS, status 0
one_inf: idiff PASS, status 0; idiff -fail 0 PASS, status 0; oiiotool FAILURE, status 1
statistics of all_nan: NanCount: 4 InfCount: 0 FiniteCount: 0
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
