#!/usr/bin/env bash
# --json: however a command ends, it writes one object to standard output and nothing else.
set -u
rm -rf ./*

command -v python3 >/dev/null || exit 77
failed=0
fail() {
    echo "json: $*"
    failed=1
}
cat >spots.cascade <<'END'
domain { grid: 32, 24 }
stage spots: gray_scott { iterations: 40 }
END
printf 'stage spots: gray_scot { iterations: 40 }\n' >wrong.cascade
printf 'OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' >four.off

# answers STATUS CONDITION ARGUMENTS…: CONDITION is a Python expression of the answer `a`.
answers() {
    local status=$1 condition=$2
    shift 2
    "$CASCADE" "$@" --json >out 2>err
    local got=$?
    [ $got = "$status" ] || fail "'$*' has status $got"
    [ ! -s err ] || fail "'$*' says outside of its answer: $(cat err)"
    python3 - "$status" "$1" "$condition" <<'END' || fail "'$*' answers $(cat out)"
import json, sys
a = json.load(open("out"))
assert a["status"] == int(sys.argv[1]) and a["command"] == sys.argv[2]
assert all(m["severity"] in ("error", "warning", "note") and m["message"] for m in a["messages"])
assert (a["status"] == 0) == all(m["severity"] != "error" for m in a["messages"])
assert eval("(" + sys.argv[3] + ")"), sys.argv[3]
END
}
wrong='(m := a["messages"][0])["line"] == 1 and m["column"] == 14 and m["end_column"] == 23 and "gray_scott" in m["hint"]'
answers 0 'a["scripts"] == [{"file": "spots.cascade", "is_correct": True, "grid": [32, 24, 1], "stages":
    [{"name": "spots", "system": "gray_scott", "iterations": 40}]}] and "no errors" in a["text"]' check spots.cascade
answers 2 "$wrong"' and [s["is_correct"] for s in a["scripts"]] == [False, True]' check wrong.cascade spots.cascade
answers 2 '"scripts" not in a and "none.cascade" in a["messages"][0]["message"]' check none.cascade
answers 0 'a["outcome"] == "finished" and a["steps"] == 40 and a["written"] == ["spots.png"]
    and a["features"]["mean"] > 0' run -q spots.cascade --features
answers 0 'a["outcome"] == "stopped" and a["where"].endswith("step 7 of 40")' run -q spots.cascade --stop-at spots:7
answers 2 "$wrong" run -q wrong.cascade
answers 2 '"is not a parameter" in a["messages"][0]["message"]' run -q spots.cascade --show q
answers 3 '"no folder" in a["messages"][0]["message"]' run -q spots.cascade -o none/x.png
answers 64 '"--bogus" in a["messages"][0]["message"]' run spots.cascade --bogus
answers 0 'a["runs"] == 2 and a["failed"] == 0 and len(a["written"]) == 2' sweep -q spots.cascade --vary feed=0.03,0.04
answers 64 '"nothing is varied" in a["messages"][0]["message"]' sweep -q spots.cascade
cat >fold.cascade <<'END'
system fold { u: 0.8; p: 0.64; u' = p - u^2 + lap(u) }
domain { grid: 8, 1; boundary: noflux }
stage s: fold { iterations: 50; speed: 0.1 }
END
answers 0 'a["varied"] == "p" and a["outcome"] == "finished" and len(a["branches"]) == 1 and len(a["written"]) == 2
    and all(abs(q["max_u"] ** 2 - q["parameter"]) < 1e-9 for q in a["branches"][0]["points"])
    and [abs(q["parameter"]) < 1e-9 for q in a["branches"][0]["points"] if q["kind"] == "fold"] == [True]
    and a["branches"][0]["from"] is None and "growing" in a["branches"][0]["points"][0]
    and "fold at p" in a["text"]' continue -q fold.cascade --vary p=-0.5..1
answers 3 '"outside of the range" in a["messages"][0]["message"]' continue -q fold.cascade --vary p=0.7..1
cat >fork.cascade <<'END'
system fork { u: 0; p: -0.5; u' = p * u - u^3 + lap(u) }
domain { grid: 8, 1; boundary: noflux }
stage s: fork { iterations: 1; speed: 0.1 }
END
answers 0 'len(a["branches"]) == 2 and (b := a["branches"][1])["from"]["branch"] == 1
    and b["begins"] == "at point %d of branch 1" % b["from"]["point"]
    and abs(a["branches"][0]["points"][b["from"]["point"] - 1]["parameter"]) < 1e-6
    and "the range of the parameter ends" in (a["branches"][0]["begins"], b["ends"])' \
    continue -q fork.cascade --flat --vary p=-1..0.1 --branches 2
answers 0 'a["systems"][0]["name"] == "gray_scott" and a["systems"][0]["about"]' systems gray_scott
answers 64 '"no system" in a["messages"][0]["message"]' systems zzz
answers 0 'a["models"][0]["points"] == 4 and a["models"][0]["triangles"] == 4' mesh four.off
answers 3 'len(a["models"]) == 1' mesh four.off none.off
exit $failed
