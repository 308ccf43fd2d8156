#!/usr/bin/env bash
# After an event, radau of deSolve can report a value from before the event.
#
# Expected. deSolve lets a table of events add to a variable at given times, as for doses, bites and amputations. All
# solvers of the package accept such a table, and should give the same course within their tolerances.
#
# What happens. With method "radau", the first value after the event can still be the value without it; the next
# value is right. A substance that decays, dosed with 1 at time 2.5, is .61 at time 3 with lsoda and 0 with radau;
# both say .22 at time 4. It happens if the last step was longer than the way from the event to that output. The
# time of the event itself is in the list of output times, so deSolve has no reason to warn, and does not. If
# nothing else changes, each event comes late.
#
# Workaround: set hmax to the shortest way from an event to the next output, or use lsoda or daspk.
#
# Seen with r-cran-desolve 1.34 of Debian 12.
set -eu
for p in r-cran-desolve=1.34; do
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
cat > try.R <<'EOF_R'
library(deSolve)
options(warn = 2) # a warning would be an error
course <- function(rate, method, times, ...) {
  doses <- data.frame(var = "x", time = c(2.5, 5.5), value = 1, method = "add")
  f <- function(t, y, p) list(-rate * y)
  o <- ode(c(x = 0), times, f, NULL, method = method, events = list(data = doses), ...)
  cat(sprintf("%.2f", o[o[, 1] %in% 0:8, 2]), "\n")
}
for (rate in c(0, 1)) {
  for (method in c("lsoda", "daspk", "radau")) {
    cat("decay ", rate, ", ", method, " at 0 1 2 ... 8: ", sep = "")
    course(rate, method, c(0:2, 2.5, 3:5, 5.5, 6:8))
  }
}
cat("decay 1, radau, output every .5:       ")
course(1, "radau", seq(0, 8, .5))
cat("decay 1, radau, hmax .5:               ")
course(1, "radau", c(0:2, 2.5, 3:5, 5.5, 6:8), hmax = .5)
EOF_R
Rscript --vanilla try.R | tee seen
cat > expected <<'EOF_TXT'
decay 0, lsoda at 0 1 2 ... 8: 0.00 0.00 0.00 1.00 1.00 1.00 2.00 2.00 2.00 
decay 0, daspk at 0 1 2 ... 8: 0.00 0.00 0.00 1.00 1.00 1.00 2.00 2.00 2.00 
decay 0, radau at 0 1 2 ... 8: 0.00 0.00 0.00 0.00 1.00 1.00 1.00 2.00 2.00 
decay 1, lsoda at 0 1 2 ... 8: 0.00 0.00 0.00 0.61 0.22 0.08 0.64 0.23 0.09 
decay 1, daspk at 0 1 2 ... 8: 0.00 0.00 0.00 0.61 0.22 0.08 0.64 0.23 0.09 
decay 1, radau at 0 1 2 ... 8: 0.00 0.00 0.00 0.00 0.22 0.08 0.64 0.23 0.09 
decay 1, radau, output every .5:       0.00 0.00 0.00 0.61 0.22 0.08 0.64 0.23 0.09 
decay 1, radau, hmax .5:               0.00 0.00 0.00 0.61 0.22 0.08 0.64 0.23 0.09 
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
