#!/usr/bin/env bash
# Branches of the Brusselator and of Schnakenberg's reaction, compared with AUTO-07p on the same grid to four digits.
set -u
rm -rf ./*

[ -d /usr/lib/auto-07p ] && command -v gfortran >/dev/null || exit 77
command -v python3 >/dev/null || exit 77
python3 - "$SOURCE" "$CASCADE" <<'END'
import csv, os, subprocess, sys
sys.path.insert(0, os.path.join(sys.argv[1], "tests/support"))
import auto_peer

CELLS = 24
CASES = {
    "brusselator": dict(
        spacing=0.5, start=2.2, range=(2.0, 4.0), flat="c = (/ 2d0, p / 2d0 /)",
        rates="r(1) = 2 - (p + 1) * c(1) + c(1)**2 * c(2) + l(1)\n    r(2) = p * c(1) - c(1)**2 * c(2) + 8 * l(2)",
        script="u: 2; v: 1.1; p: 2.2; u' = 2 - (p + 1) * u + u^2 * v + lap(u); v' = p * u - u^2 * v + 8 * lap(v)"),
    "schnakenberg": dict(
        spacing=0.5, start=0.6, range=(0.5, 1.6), flat="c = (/ 3.1d0 - p, (3 - p) / (3.1d0 - p)**2 /)",
        rates="r(1) = 0.1d0 - c(1) + c(1)**2 * c(2) + l(1)\n    r(2) = 3 - p - c(1)**2 * c(2) + 30 * l(2)",
        script="u: 2.5; v: 0.384; p: 0.6; u' = 0.1 - u + u^2 * v + lap(u); v' = 3 - p - u^2 * v + 30 * lap(v)"),
}


def own_branches(name, case):
    with open(name + ".cascade", "w") as file:
        file.write(f"system s {{ {case['script']} }}\ndomain {{ grid: {CELLS}, 1; spacing: {case['spacing']}; "
                   "boundary: noflux }\nstage a: s { iterations: 1; speed: 0.001 }\n")
    low, high = case["range"]
    subprocess.run([sys.argv[2], "continue", name + ".cascade", "--vary", f"p={low}..{high}", "--branches", "2", "--step",
                    "0.01", "--points", "2000", "-q", "-o", name + ".csv"], check=True, stdout=subprocess.PIPE)
    branches = {}
    with open(name + ".csv") as file:
        for row in csv.DictReader(file):
            norm = (CELLS * (float(row["norm_u"])**2 + float(row["norm_v"])**2))**0.5
            branches.setdefault(int(row["branch"]), []).append((row["kind"] or None, float(row["p"]), norm))
    return branches


def near(rows, p):
    """The norm at p on a branch whose parameter grows, from the three nearest of its points."""
    (a, fa), (b, fb), (c, fc) = sorted(sorted(rows, key=lambda row: abs(row[0] - p))[:3])
    return (fa * (p - b) * (p - c) / ((a - b) * (a - c)) + fb * (p - a) * (p - c) / ((b - a) * (b - c)) +
            fc * (p - a) * (p - b) / ((c - a) * (c - b)))


wrong = 0
for name, case in CASES.items():
    low, high = case["range"]
    own = own_branches(name, case)
    os.makedirs(name, exist_ok=True)
    system = dict(cells=CELLS, species=2, spacing=case["spacing"], start=case["start"], flat=case["flat"], rates=case["rates"])
    auto_peer.prepare(name, system)
    flat = auto_peer.branch(name, system, low, high, step=0.01, longest=0.02, points=400)
    special = [row for row in flat if row[0]]
    assert special, "AUTO finds special points"
    compared = 0
    for kind, label, p, norm in special:
        found = min((row for row in own[1] if row[0] == kind), key=lambda row: abs(row[1] - p), default=None)
        compared += 1
        if found is None or abs(found[1] - p) > 1e-4 * abs(p) or abs(found[2] - norm) > 1e-4 * norm:
            print(f"{name}: AUTO has a {kind} at {p}, {norm}, cascade {found}")
            wrong = 1
    label = next(row[1] for row in special if row[0] == "branch point")
    theirs = auto_peer.branch(name, system, low, high, restart=label, switch=-1, step=0.01, longest=0.01, points=2000)
    for kind, _, p, norm in [row for row in theirs if row[0]]:
        found = min((row for row in own[2] if row[0] == kind), key=lambda row: abs(row[1] - p) + abs(row[2] - norm), default=None)
        compared += 1
        if found is None or abs(found[1] - p) > 1e-4 * abs(p) or abs(found[2] - norm) > 1e-4 * norm:
            print(f"{name}: on the pattern AUTO has a {kind} at {p}, {norm}, cascade {found}")
            wrong = 1
    # After the last special point of a pattern both branches grow with p.
    curve = [(row[2], row[3]) for row in theirs]
    turn = max([k for k, row in enumerate(theirs) if row[0]], default=0)
    curve = curve[turn:]
    first = curve[0][0] + 0.1 * (high - low)
    points = [row for row in own[2] if first < row[1] < min(high, curve[-1][0])]
    assert len(points) > 10, f"{name}: too few points are compared"
    for _, p, norm in points:
        compared += 1
        if abs(near(curve, p) - norm) > 1e-4 * norm:
            print(f"{name}: at p = {p} the norm is {norm}, AUTO's {near(curve, p)}")
            wrong = 1
    print(f"{name}: {compared} points compared")
sys.exit(wrong)
END
