#!/usr/bin/env bash
# Functions from tables, use "light.csv": their values and integrals, pulses with steps of chosen length, runs again from
# pictures and saved runs without the table, and messages about bad tables.
set -u
rm -rf ./*

about="table functions"
source "$SOURCE/tests/support/program_runs.bash"

printf '\xef\xbb\xbftime, "light [lux]", heat\r\ns,lux,K\r\n0,1,5\r\n10,3,5\r\n\r\n20,+0,7\r\n' >light.csv
mkdir deeper
cat >deeper/lamp.cascade <<'END'
use "../light.csv"
fn lamp(t) = light(t) + 0 * heat(t)
END
cat >grow.cascade <<'END'
use "deeper/lamp.cascade"
system s { u: 0; v: heat(20 * x); u' = lamp(t); v' = 0 }
domain { grid: 8, 1; boundary: noflux; precision: double }
stage grow: s { solver: rk4; speed: 0.5; duration: 25; every: 5 }
END
log=(--log 'light=lamp(t)' --log 'u=mean(u over domain)' --log 'v=max(v over domain)' --log-file log.csv)
run 0 run grow.cascade -q -o grow.png "${log[@]}" --save saved
# The integral of the light is (1 + 3)/2 · 10 + (3 + 0)/2 · 10. Between 10 and 20, the heat rises from 5 to 7.
awk -F, 'NR == 1 { print $3 "," $4 "," $5 "," $6; next } { printf "%.9g,%.9g,%.9g,%.9g\n", $3, $4, $5, $6 }' log.csv >values
cat >wanted <<'END'
t,light,u,v
0,1,0,6.75
5,2,7.5,6.75
10,3,20,6.75
15,1.5,31.25,6.75
20,0,35,6.75
25,0,35,6.75
END
cmp -s values wanted || fail "$(cat values)"
run 0 run grow.cascade -q -o interpreted.png --backend interp
cmp -s grow.png interpreted.png || fail "interpreted, the table has other values"
mkdir elsewhere && mv grow.png saved elsewhere
run 0 run elsewhere/grow.png -q -o again.png
cmp -s elsewhere/grow.png again.png || fail "the picture of a table is not itself again"
run 0 run grow.cascade -q -o stopped.png --stop-at grow:12 --save elsewhere/half
mv light.csv kept.csv
run 0 run --resume elsewhere/half -q -o resumed.png "${log[@]}" --save elsewhere/whole
for array in elsewhere/saved/*.npy; do
    cmp -s "$array" "elsewhere/whole/${array##*/}" || fail "a resumed run has another ${array##*/}"
done
run 2 run grow.cascade -q -o missing.png
says err "deeper/lamp.cascade:1:5: error: cannot read 'light.csv'"

# A pulse of 0.2 in a stage of 100 is seen by a solver that chooses its steps. Its integral is 1.
printf '0,0\n49.9,0\n50,10\n50.1,0\n' >pulse.csv
cat >pulse.cascade <<'END'
use "pulse.csv"
system s { u: 0; u' = pulse(t) }
domain { grid: 4, 4 }
stage grow: s { solver: rk45; duration: 100 }
END
run 0 run pulse.cascade -q -o pulse.png --log 'mean(u over domain)' --log-file pulse.log
tail -n 1 pulse.log | awk -F, '{ exit !($4 > 0.99 && $4 < 1.01) }' || fail "the pulse: $(tail -n 1 pulse.log)"

# Bad tables: one message with its place.
cat >bad.cascade <<'END'
use "bad.csv"
system s { u: bad(0); u' = 0 }
stage a: s { iterations: 1 }
END
bad() {
    local table=$1 place=$2 message=$3
    printf "$table" >bad.csv
    run 2 check bad.cascade
    says err "bad.csv:$place: error: $message"
    [ "$(grep -c 'error:' err)" = 1 ] || fail "more than one error: $table"
}
bad '' 1:1 'this table is empty'
bad 't,bad\n' 1:1 'this table has 0 rows of numbers'
bad 't,bad\n1,2\n' 2:1 'this table has 1 row of numbers'
bad '1\n2\n' 1:1 'this table has one column'
bad '1;2\n2;3\n' 1:1 'the cells of a table must be separated by commas'
bad '1,2,3\n2,3,4\n' 1:1 'this table has several columns of values, but its first row does not name them'
bad 't,1st\n1,2\n2,3\n' 1:3 "'1st' cannot be the name of a function"
bad 't,bad\n1,2\n2,three\n' 3:3 "'three' is not a number"
bad 't,bad\n1,2\n2,nan\n' 3:3 "'nan' is not a number"
bad 't,bad\n1,2\n2,1e999\n' 3:3 "'1e999' is not a number"
bad 't,bad\n1,2\n2,\n' 3:3 'there is no number in this cell'
bad 't,bad\n1,2\n3,2\n  2,4\n' 4:3 '2 comes after 3, but the first column must rise'
bad 't,bad\n1,2\n1,4\n' 3:1 '1 comes after 1, but the first column must rise'
bad 't,bad\n1,2\n2,3,4\n' 3:5 'this row has 3 cells, but the first row has 2'
bad 't,bad\n1,2\n2\n' 3:1 'this row has 1 cell, but the first row has 2'
bad 't,bad\n1,2\n2,"3\n' 3:3 'this quoted cell has no end'
bad 'zeit,bad,bad\n1,2,3\n2,3,4\n' 1:10 "there are two functions 'bad'"
bad 't,bad,sin\n1,2,3\n2,3,4\n' 1:7 "'sin' is a function of the language"
seq 1001 | sed 's/$/,1/' >bad.csv
run 2 check bad.cascade
says err 'bad.csv:1001:1: error: this table has 1001 rows of numbers, but at most 1000 can be read'
yes 0123456789 | head -c 1100000 >bad.csv
run 2 check bad.cascade
says err 'bad.csv'
seq 1000 | sed 's/$/,1/' >bad.csv
run 0 check bad.cascade
mv bad.csv 2nd.csv && sed 's/bad/2nd/' bad.cascade >second.cascade
run 2 check second.cascade
says err "2nd.csv:1:1: error: '2nd' cannot be the name of a function"

# Printed formulas have the numbers of the table.
printf '0,0\n1,10\n3,40\n' >q.csv
printf 'use "q.csv"\nsystem s { u: 0; u%s = q(u) }\nstage a: s { iterations: 1 }\n' "'" >q.cascade
run 0 check q.cascade --dump equations
says out '10 + 15 (t − 1)'

# What other programs call it.
echo 'system s { u: 0; u'"'"' = ramp(t, "light.csv") } stage a: s { iterations: 1 }' >ramp.cascade
run 2 check ramp.cascade
says err 'use "light.csv" makes each column of a table a function'
exit 0
