#!/usr/bin/env bash
# `cascade continue` as users call it: table, diagram, saved states, messages, limits.
set -u
rm -rf ./*
unset NO_COLOR

about="continue"
source "$SOURCE/tests/support/program_runs.bash"

cat >fold.cascade <<'END'
system fold { u: 0.8; p: 0.64; u' = p - u^2 + lap(u) }
domain { grid: 8, 1; boundary: noflux }
stage s: fold { iterations: 50; speed: 0.1 }
END

# A table, a diagram, and a line for each special point.
run 0 continue fold.cascade --vary p=-0.5..1
grep -Eq 'fold at p = -?[0-9.]+e-[0-9]+, norm_u' out || fail "no fold at 0: $(cat out)"
says err 'wrote fold_branches.csv'
says err 'wrote fold_branches.svg'
head -1 fold_branches.csv | grep -qx 'branch,point,kind,p,norm_u,min_u,max_u,mean_u,stable,growing,rate,frequency' ||
    fail "the head of the table is $(head -1 fold_branches.csv)"
[ "$(grep -c ',fold,' fold_branches.csv)" = 1 ] || fail "the table has other than one fold"
# Each row obeys u^2 = p, and u is stable above 0.
awk -F, 'NR > 1 && ($5 * $5 - $4) ^ 2 > 1e-20 { exit 1 }' fold_branches.csv || fail "a row is no steady state"
awk -F, 'NR > 1 && $3 == "" && $9 != ($8 > 0) { exit 1 }' fold_branches.csv || fail "stability is wrong"
grep -q 'stroke-dasharray' fold_branches.svg || fail "no dashed line for unstable states"

# Other files; quiet; the same table again.
run 0 continue fold.cascade --vary p=-0.5..1 -q -o again.csv -o up.png -o up.pdf --curve max
cmp fold_branches.csv again.csv || fail "the same command gives another table"
[ ! -s err ] || fail "quiet is not quiet: $(cat err)"
head -c 8 up.png | grep -q PNG || fail "no PNG"

# Pictures of patterns stand below the diagram. Domains may have a mask, and be models.
cat >waves.cascade <<'END'
system waves { u: 0.36 * cos(4 * pi * (x + 1/64)); p: 0.1; u' = p * u - (u + 2 * lap(u) + lap(lap(u))) - u^3 }
domain { grid: 32, 1; spacing: pi / 8 }
stage a: waves { solver: etdrk4; speed: 0.02; duration: 5 }
END
run 0 continue waves.cascade --vary p=-0.2..0.2 -o waves.svg -o waves.csv
says out 'where the pattern vanishes'
says out ': the pattern vanishes'
grep -q ',fold,' waves.csv && fail "the point at which a pattern vanishes is called a fold"
grep -q '>f</text>' waves.svg || fail "the diagram has fewer than six pictures"
run 0 continue waves.cascade --vary p=-0.2..0.2 -q -o none.svg --pictures 0
grep -q '>f</text>' none.svg && fail "--pictures 0 draws pictures"
cat >disc.cascade <<'END'
system s { u: 0; p: 0.05; u' = p * u - u^3 + lap(u); u.border: fixed(0) }
domain { grid: 24, 24; mask: disc(0.5, 0.5, 0.45) }
stage a: s { iterations: 1; speed: 0.1 }
END
run 0 continue disc.cascade --vary p=0..0.1 --branches 2 -q -o disc.csv -o disc.svg --save disc
# The first wave of a disc of radius R between walls at 0 grows at (2.4048 / R)^2. The border of the cells is rough.
awk -F, '$3 == "branch point" { found = $4; exit } END { exit !(found > 0.9 * (2.4048 / 10.8) ^ 2 && found < 1.1 * (2.4048 / 10.8) ^ 2) }' \
    disc.csv || fail "the first wave of a disc: $(grep branch disc.csv)"
cat >ball.cascade <<'END'
system s { u: 0; p: -0.01; u' = p * u - u^3 + lap(u) }
domain { surface: sphere; cells: 200; unit: 0.2 }
stage a: s { iterations: 1; speed: 0.1 }
END
run 0 continue ball.cascade --vary p=-0.02..0.1 --step 0.02 -q -o ball.csv
# Waves of degree 1 on a sphere: p = 2 unit^2, three at once or nearly so, after the uniform wave at 0.
awk -F, '$3 == "branch point" { ++n; if ((n == 1 && $4 ^ 2 > 1e-9) || (n > 1 && ($4 - 0.08) ^ 2 > 1e-5)) exit 1 } END { exit !(n > 1) }' \
    ball.csv || fail "the waves of a sphere: $(grep branch ball.csv)"

# A saved state is steady, stays where it is, and can be continued as a run.
run 0 continue fold.cascade --vary p=0.5..1 -q -o t.csv --save states
run 0 run --resume states/branch1_point1 -q --log 'mean(u over domain)' -o state.png
wanted=$(sed -n 2p t.csv | cut -d, -f8) reached=$(tail -n 1 state.csv | rev | cut -d, -f1 | rev)
awk -v a="$wanted" -v b="$reached" 'BEGIN { exit !((a - b) ^ 2 < 1e-16) }' ||
    fail "the run of the state $wanted reached $reached"

# Messages, before any work.
run 64 continue fold.cascade
says err 'nothing is varied'
run 3 continue fold.cascade --vary q=0..1
says err "has no parameter 'q'"
run 3 continue fold.cascade --vary p=0.7..1
says err 'the run has p = 0.64, which is outside of the range 0.7 to 1'
run 3 continue fold.cascade --vary p=0..1 --curve width
says err "there is no number 'width' of a state"
run 64 continue fold.cascade --vary p=0..1 -o x.gif
says err "'x.gif' does not end in .csv, .png, .svg or .pdf"
printf "system n { u: 1; p: 1; u' = white(0.1) - p * u }\nstage s: n { iterations: 100000000 }\n" >noise.cascade
run 3 continue noise.cascade --vary p=0..2
says err "the states of stage 's' cannot be followed: random numbers in its rates leave no state steady"

# A limit ends it, and what was found is written.
cat >long.cascade <<'END'
system fold { u: 0.8; p: 0.64; u' = p - u^2 + lap(u) }
domain { grid: 64, 64 }
stage s: fold { iterations: 10; speed: 0.1 }
END
run 124 continue long.cascade --vary p=-1..1 --step 0.0001 --points 100000 --limit-time 1s -q -o long.csv
says err 'the limit of 1 s is reached'
[ "$(wc -l <long.csv)" -ge 2 ] || fail "no point was written"
echo "continue: right"
