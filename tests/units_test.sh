#!/usr/bin/env bash
# Figures and TeX show the units of a script; options and sweeps keep or convert the unit of a value.
set -uo pipefail
fail() { echo "units: $*"; exit 1; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cat >"$out/line.cascade" <<'SCRIPT'
system morphogen {
  c: 0 uM
  D: 1e-11 m^2/s
  k: 0.02 /min
  c' = D * lap(c) - k * c
  c.left: fixed(2 uM)
}
domain { grid: 40; extent: 0.6 mm; boundary: noflux }
stage gradient: morphogen { solver: rkl2; speed: auto; duration: 3 h }
SCRIPT
"$CASCADE" run "$out/line.cascade" -o "$out/line.svg" >"$out/run" 2>&1 || fail "$(cat "$out/run")"
for words in 'x (mm)' 'c (uM)' 't = 3 h'; do
    grep -qF "$words" "$out/line.svg" || fail "the figure does not say $words"
done
tex=$("$CASCADE" check "$out/line.cascade" --dump tex) || fail "no TeX"
[[ $tex == *'\mathrm{m^{2}/s}'* ]] || fail "TeX lacks a unit: $tex"
[[ $tex == *'\frac{\mathrm{width}^{2} \, k}{D}'* ]] || fail "TeX lacks a dimensionless group: $tex"
[[ $tex == *'\mathrm{duration} \, k'* ]] || fail "TeX lacks the other group: $tex"
value() { "$CASCADE" check "$out/line.cascade" --dump program --set "$1" | grep "^  D:.*uniform"; }
[[ $(value 'D=2e-11') == '  D: 0.072  # uniform' ]] || fail "a number does not keep the unit: $(value 'D=2e-11')"
[[ $(value 'D=20 um^2/s') == '  D: 0.072  # uniform' ]] || fail "a unit is not converted"
"$CASCADE" fmt - <"$out/line.cascade" >"$out/formatted" || fail "fmt failed"
cmp -s "$out/line.cascade" "$out/formatted" || fail "fmt changes units: $(diff "$out/line.cascade" "$out/formatted")"
