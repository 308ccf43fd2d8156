#!/usr/bin/env bash
# Probes: --log 'u at (x, y)' has the value of the cell at this place, on lines, planes and volumes, in each stage. Also
# speeds and rates from logs, compared with theory.
set -u
rm -rf ./*

about="probes"
source "$SOURCE/tests/support/program_runs.bash"

cat >plane.cascade <<'END'
system s { u: 100 * x + y; v: 1; u' = 1; v' = 0 }
system other { w: 5; w' = 0 }
domain { grid: 10, 4; precision: double; mask: x < 0.9 }
stage a: s { iterations: 2; interval: 1 }
stage b: other { iterations: 1 }
END
# The cells have their middles at x = 0.05, 0.15 … and y = 0.05 … 0.35
run 0 run plane.cascade -q -o plane.png --log 'u at (0.25, 0.25)' --log 'corner=2 * u + v at (0, 0)' --log 'outside=u at (1, 0.4)' \
    --log 'm=mean(w over domain)' --log 'w at (0.31,0.3)' --log-file plane.csv
cat >wanted.csv <<'END'
stage,step,t,"u at (0.25, 0.25)",corner,outside,m,"w at (0.31,0.3)"
a,0,0,25.25,11.1,,,
a,1,1,26.25,13.1,,,
a,2,2,27.25,15.1,,,
b,0,0,,,,5,5
b,1,1,,,,5,5
END
cmp -s plane.csv wanted.csv || fail "$(cat plane.csv)"
# --interval replaces the interval of each stage.
run 0 run plane.cascade -q -o plane.png --interval 2 --log 'corner=2 * u at (0, 0)' --log-file two.csv
[ "$(cut -d, -f1,2 two.csv | tr '\n' ' ')" = "stage,step a,0 a,2 b,0 b,1 " ] || fail "--interval 2: $(cat two.csv)"

echo 'system s { u: x; u'"'"' = 0 } domain { grid: 8 } stage a: s { iterations: 1 }' | sed 's/} domain/}\ndomain/; s/} stage/}\nstage/' >line.cascade
sed 's/grid: 8/grid: 4, 4, 4/; s/u: x/u: x + 10 * y + 100 * z/' line.cascade >volume.cascade
run 0 run line.cascade -q -o line.png --log 'u at (0.5)' --log-file line.csv
[ "$(tail -n 1 line.csv)" = a,1,1,0.5625 ] || fail "$(cat line.csv)"
run 0 run line.cascade -q -o line.png --log 'u at 0.5' --log-file line.csv
[ "$(tail -n 1 line.csv)" = a,1,1,0.5625 ] || fail "without brackets: $(cat line.csv)"
run 0 run volume.cascade -q -o volume.png --log 'u at (0, 0.5, 1)' --log-file volume.csv
[ "$(tail -n 1 volume.csv)" = a,1,1,93.875 ] || fail "$(cat volume.csv)"

# The speed of Fisher's front is 2 - 3/(2 t) for long times t (Bramson, 1983), here on average 1.97 from 40 to 60. In
# cells of length h its limit is the smallest (1 + (2 cosh(k h) - 2)/h^2)/k, which is 2.02 for h = 0.5.
cat >front.cascade <<'END'
system fisher { u: if(x < 0.1, 1, 0); u' = lap(u) + u * (1 - u) }
domain { grid: 480, 1; spacing: 0.5; boundary: noflux }
stage grow: fisher { solver: rk4; speed: 0.05; duration: 60 }
END
run 0 run front.cascade -q -o front.png --at 40,60 --log 'front=integral(u over domain)' --log-file front.csv
awk -F, '$3 == 40 { a = $4 } $3 == 60 { v = ($4 - a) / 20; if (!(v > 1.97 && v < 2.01)) exit 1 }' front.csv ||
    fail "the front: $(cat front.csv)"
# A wave of 64 cells decays with the rate 2 - 2 cos(2 pi/64) = 0.0096305 of the difference equation, in steps of 1/4.
echo "system s { u: sin(2 * pi * x); u' = lap(u) }" >wave.cascade
printf 'domain { grid: 64; precision: double }\nstage a: s { solver: rk4; speed: 0.25; duration: 50 }\n' >>wave.cascade
run 0 run wave.cascade -q -o wave.png --log deviation --log-file wave.csv
awk -F, '$3 == 0 { a = log($4) } $3 == 50 { r = (log($4) - a) / 50; d = r + 0.0096305; if (d < 0) d = -d; if (d > 1e-6) exit 1 }' \
    wave.csv || fail "the rate: $(cat wave.csv)"

refused() {
    run 2 run "$1" -q -o refused.png --log "$2" --log-file refused.csv
    says err "$3"
    [ ! -e refused.csv ] || fail "a log is written"
}
plane='this position is not in the domain, which has x from 0 to 1, y from 0 to 0.4'
for place in '0.5' '0.5, 0.5' '0.5, -0.1' '0.5, nan' '0.5, y' '0.1, 0.1, 0.1' ''; do
    refused plane.cascade "u at ($place)" "$plane"
done
says err "write 'u at (0.5, 0.2)' for the cell in the middle"
refused plane.cascade 'q at (0.5, 0.2)' "'q' is not"
refused line.cascade 'u at (0.5, 0.5)' 'this position is not in the domain, which has x from 0 to 1'
echo 'domain { surface: sphere; cells: 50 } stage a: gray_scott { iterations: 1 }' | sed 's/} stage/}\nstage/' >model.cascade
refused model.cascade 'u at (0.5, 0.5)' 'a value at a position can be read only from fields on a plane or in a volume'
exit 0
