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

# Options take times and ranges in other units of the same kind.
log=("$out/line.cascade" -q -o "$out/line.png" --log 't' --log-file)
"$CASCADE" run "${log[@]}" "$out/hours.csv" --at 0.5,1.5 >"$out/said" 2>&1 || fail "--at: $(cat "$out/said")"
"$CASCADE" run "${log[@]}" "$out/minutes.csv" --at '30,90 min' >"$out/said" 2>&1 || fail "--at in min: $(cat "$out/said")"
[[ $(cut -d, -f3 "$out/minutes.csv" | tr '\n' ' ') == "t 0 0.5 1.5 3 " ]] || fail "--at converts to $(cut -d, -f3 "$out/minutes.csv")"
cmp -s "$out/hours.csv" "$out/minutes.csv" || fail "--at in another unit observes other values"
"$CASCADE" run "${log[@]}" "$out/every.csv" --every '3600 s' >"$out/said" 2>&1 || fail "--every in s: $(cat "$out/said")"
[[ $(cut -d, -f3 "$out/every.csv" | tr '\n' ' ') == "t 0 1 2 3 " ]] || fail "--every converts to $(cut -d, -f3 "$out/every.csv")"
refuses() {
    local status=$1 words=$2
    shift 2
    "$CASCADE" "$@" >"$out/said" 2>&1
    [ $? = "$status" ] || fail "cascade $* is not refused with $status: $(cat "$out/said")"
    grep -qF -- "$words" "$out/said" || fail "cascade $* does not say '$words': $(cat "$out/said")"
}
refuses 2 "'mm' is not a unit of time" run "${log[@]}" "$out/no.csv" --every '5 mm'
refuses 64 "'5 parsecs' is not a time above 0" run "${log[@]}" "$out/no.csv" --every '5 parsecs'
refuses 64 "is not a list of times that rise" run "${log[@]}" "$out/no.csv" --at '1 h,2 h'
sed 's/ 3 h/ 3/' "$out/line.cascade" | sed 's| /min||; s|1e-11 m^2/s|0.036|' >"$out/timeless.cascade"
refuses 2 "the script has no unit of time" run "$out/timeless.cascade" -q -o "$out/line.png" --log t --log-file "$out/no.csv" --every '5 min'
[ ! -e "$out/no.csv" ] || fail "a refused run has written"

"$CASCADE" continue "$out/fork.cascade" --vary 'r=-0.1..0.3 /ks' --flat -o "$out/no.csv" >"$out/said" 2>&1 && fail "ks is no unit"
"$CASCADE" continue "$out/fork.cascade" --vary 'r=-6e-3..18e-3 /min' --flat --save "$out/minutes" -o "$out/minutes.csv" \
    >"$out/said" 2>&1 || fail "continue in /min: $(cat "$out/said")"
python3 - "$out/fork.csv" "$out/minutes.csv" <<'END' || fail "a range in another unit gives other branches"
import csv, sys
ends = [[float(row["r"]) for row in csv.DictReader(open(path))] for path in sys.argv[1:]]
for end in min, max:
    assert abs(end(ends[0]) - end(ends[1])) < 1e-9, ends
END
grep -q '"r=[^"]* 1\?/min"' "$out/minutes/branch1_point1/run.json" || fail "a state is saved without its unit"
refuses 3 "the range of 'r' is in mm, but its value is in " analyze "$out/fork.cascade" --vary 'r=1..3 mm'

"$CASCADE" sweep "$out/line.cascade" --vary 'D=10..30 um^2/s:3' --curve mean -q -o "$out/swept" >"$out/said" 2>&1 ||
    fail "sweep in um^2/s: $(cat "$out/said")"
"$CASCADE" sweep "$out/line.cascade" --vary 'D=1e-11,2e-11,3e-11' -q -o "$out/plain" >"$out/said" 2>&1 || fail "sweep"
[[ $(cut -d, -f2- "$out/swept/features.csv") == $(cut -d, -f2- "$out/plain/features.csv") ]] || fail "a sweep in another unit has other features"
grep -qF 'D (um^2/s)' "$out/swept/mean.svg" || fail "the axis of a curve has no unit"
refuses 3 "is not a number in the unit of the first value" sweep "$out/line.cascade" --vary 'D=10 um^2/s,2e-11' --curve mean -q -o "$out/mixed"
