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

# Ends of ranges and the parameters of saved states are in the unit of the value that they replace.
cat >"$out/fork.cascade" <<'SCRIPT'
system fork {
  u: 0.1 uM * cos(2 * pi * x)
  r: 1e-4 /s
  D: 1e-10 m^2/s
  u' = D * lap(u) + r * u - 1 /uM^2/h * u^3
}
domain { grid: 8, 1; extent: 1 cm; boundary: noflux }
stage waves: fork { duration: 1 h; speed: 0.02 h }
SCRIPT
"$CASCADE" continue "$out/fork.cascade" --vary r=-1e-4..3e-4 --flat --save "$out/kept" -o "$out/fork.csv" \
    >"$out/said" 2>&1 || fail "continue: $(cat "$out/said")"
largest=$(python3 -c 'import csv, sys; print(max(float(row["r"]) for row in csv.DictReader(open(sys.argv[1]))))' "$out/fork.csv")
[[ $largest == 1.08* || $largest == 1.07* ]] || fail "continue converts the end of its range to $largest/h"
saved=$(sed -nE 's/.*"r=([^"]*)".*/\1/p' "$out/kept/branch1_point1/run.json")
python3 -c 'import sys; sys.exit(not -1.1e-4 <= float(sys.argv[1]) <= 3.1e-4)' "$saved" || fail "a state is saved with r=$saved"
"$CASCADE" analyze "$out/fork.cascade" --vary r=-1e-4..3e-4 >"$out/said" || fail "analyze"
grep -qF '(-0.36 to 1.08)' "$out/said" || fail "analyze does not convert its range: $(cat "$out/said")"
