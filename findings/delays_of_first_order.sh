#!/usr/bin/env bash
# XPPAUT solves delay equations to first order, whatever the method.
#
# Expected. XPPAUT has delay(x, tau) and a dozen methods. x' = -x(t - 1) with x = 1 before 0 has the solution 1 - t up
# to t = 1, and -1/6 at t = 3. Runge-Kutta of order 4 solves polynomials of this kind exactly, except perhaps where
# two pieces meet, and a method that chooses its steps keeps to its tolerance.
#
# What happens. The delayed value is read once per step, at its beginning, and kept for the whole step. So Runge-Kutta
# gives the same numbers as Euler: the error at t = 3 is about half the step, .05 for dt = .1. The methods with a
# tolerance of 1e-8 do the same between two outputs. With cvode the delayed value is read once for the whole run: x
# ends at -2. There is no message. The period and the threshold of oscillations with delays, such as those of somites,
# change with dt.
#
# Workaround: halve dt until nothing changes, and never use cvode; or dede of deSolve in R.
#
# Seen with xppaut 6.11b of Debian 12.
set -eu
for p in xppaut=6.11b; do
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
try() { # method, dt; prints the last x
  cat > try.ode <<EOF_ODE
x'=-delay(x,1)
init x=1
x(0)=1
@ total=3,dt=$2,meth=$1,delay=2,toler=1e-8,atoler=1e-8
done
EOF_ODE
  xppaut try.ode -silent -outfile out >log 2>&1 || { echo "xppaut failed"; exit 1; }
  awk -v m="$1" -v dt="$2" 'END { printf "%s, dt = %s: x(%g) = %.4f, error %.4f\n", m, dt, $1, $2, $2 + 1 / 6 }' out
}
for dt in .1 .05 .01; do
  for method in euler rungekutta; do try "$method" "$dt"; done
done | tee seen
for method in qualrk cvode; do try "$method" .1; done | tee -a seen
cat > expected <<'EOF_TXT'
euler, dt = .1: x(3) = -0.2200, error -0.0533
rungekutta, dt = .1: x(3) = -0.2200, error -0.0533
euler, dt = .05: x(3) = -0.1925, error -0.0258
rungekutta, dt = .05: x(3) = -0.1925, error -0.0258
euler, dt = .01: x(3) = -0.1717, error -0.0050
rungekutta, dt = .01: x(3) = -0.1717, error -0.0050
qualrk, dt = .1: x(3) = -0.2200, error -0.0533
cvode, dt = .1: x(3) = -2.0000, error -1.8333
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
