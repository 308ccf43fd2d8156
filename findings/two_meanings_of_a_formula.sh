#!/usr/bin/env bash
# The two parsers of libSBML give one formula two meanings.
#
# Expected. libSBML turns formulas as text into trees by parseFormula, the older function, and parseL3Formula, which
# knows more functions. For a formula that both accept the tree, and so the model, should be the same.
#
# What happens. log(x) is the natural logarithm for parseFormula and the decimal one for parseL3Formula: a factor of
# 2.3. -x^2 is (-x)^2 for the first and -(x^2) for the second, so a sink becomes a source. 2^3^2 is 64 for the first
# and 512 for the second. The text that formulaToString and formulaToL3String write fits the parser of the same age
# only: log(x) that is written by formulaToString from a natural logarithm and read by parseL3Formula is a decimal
# one. Nothing warns.
#
# Workaround: write ln and log10, and brackets around signs and powers.
#
# Seen with python3-sbml5 5.19.7 of Debian 12.
set -eu
for p in python3-sbml5=5.19.7; do
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
cat > try.py <<'EOF_PY'
import libsbml
from math import log
def value(node, x):
    kind, args = node.getType(), [value(node.getChild(i), x) for i in range(node.getNumChildren())]
    if node.isNumber():
        return node.getValue()
    if node.isName():
        return x
    if kind == libsbml.AST_FUNCTION_LN:
        return log(args[0])
    if kind == libsbml.AST_FUNCTION_LOG:
        return log(args[1]) / log(args[0])
    if kind in (libsbml.AST_POWER, libsbml.AST_FUNCTION_POWER):
        return args[0] ** args[1]
    if kind == libsbml.AST_MINUS:
        return -args[0] if len(args) == 1 else args[0] - args[1]
    raise ValueError(kind)
print("for x = 3:")
for formula in "log(x)", "ln(x)", "log10(x)", "-x^2", "-(x^2)", "2 - x^2", "2^x^2", "x - 1 - 1":
    old, new = libsbml.parseFormula(formula), libsbml.parseL3Formula(formula)
    print(f"{formula}: parseFormula {value(old, 3):.6g}, parseL3Formula {value(new, 3):.6g}")
for formula in "ln(x)", "-(x^2)":
    text = libsbml.formulaToString(libsbml.parseL3Formula(formula))
    print(f"{formula} is written as {text} and read as {value(libsbml.parseL3Formula(text), 3):.6g}")
    text = libsbml.formulaToL3String(libsbml.parseL3Formula(formula))
    print(f"{formula} is written as {text} and read as {value(libsbml.parseFormula(text), 3):.6g} by parseFormula")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
for x = 3:
log(x): parseFormula 1.09861, parseL3Formula 0.477121
ln(x): parseFormula 1.09861, parseL3Formula 1.09861
log10(x): parseFormula 0.477121, parseL3Formula 0.477121
-x^2: parseFormula 9, parseL3Formula -9
-(x^2): parseFormula -9, parseL3Formula -9
2 - x^2: parseFormula -7, parseL3Formula -7
2^x^2: parseFormula 64, parseL3Formula 512
x - 1 - 1: parseFormula 1, parseL3Formula 1
ln(x) is written as log(x) and read as 0.477121
ln(x) is written as ln(x) and read as 1.09861 by parseFormula
-(x^2) is written as -(x^2) and read as -9
-(x^2) is written as -x^2 and read as 9 by parseFormula
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
