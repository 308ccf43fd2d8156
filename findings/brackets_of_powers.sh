#!/usr/bin/env bash
# libSBML writes powers of powers without brackets and reads them back as others.
#
# Expected. A library that turns trees into text and text into trees gets the same tree back. (a^b)^c is a^(b c), and
# without brackets a^b^c has to be the form that its own parser takes for this tree.
#
# What happens. formulaToL3String writes (a^b)^c as a^b^c, and parseL3Formula, its partner, reads a^b^c as a^(b^c).
# With the older pair it is the other way round: formulaToString writes a^(b^c) as a^b^c, and parseFormula reads it as
# (a^b)^c. So a Hill function with ((x/k)^2)^n, after it was stored as text once, has another steepness: for x/k = 2
# and n = 3, 64 becomes 256. MathML is not affected. Nothing warns.
#
# Workaround: pow(pow(a, b), c) becomes the same text; multiply the exponents, or keep MathML.
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
def value(node):
    if node.isNumber():
        return node.getValue()
    return value(node.getChild(0)) ** value(node.getChild(1))
pairs = {"formulaToL3String, parseL3Formula": (libsbml.formulaToL3String, libsbml.parseL3Formula),
         "formulaToString, parseFormula": (libsbml.formulaToString, libsbml.parseFormula)}
for formula in "(2^2)^3", "2^(2^3)", "pow(pow(2, 2), 3)", "pow(2, pow(2, 3))":
    for name, (write, read) in pairs.items():
        tree = read(formula)
        text = write(tree)
        print(f"{formula} = {value(tree):g}, by {name}: written as {text}, read back as {value(read(text)):g}")
tree = libsbml.parseL3Formula("(2^2)^3")
print("by MathML:", f"{value(libsbml.readMathMLFromString(libsbml.writeMathMLToString(tree))):g}")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
(2^2)^3 = 64, by formulaToL3String, parseL3Formula: written as 2^2^3, read back as 256
(2^2)^3 = 64, by formulaToString, parseFormula: written as 2^2^3, read back as 64
2^(2^3) = 256, by formulaToL3String, parseL3Formula: written as 2^(2^3), read back as 256
2^(2^3) = 256, by formulaToString, parseFormula: written as 2^2^3, read back as 64
pow(pow(2, 2), 3) = 64, by formulaToL3String, parseL3Formula: written as 2^2^3, read back as 256
pow(pow(2, 2), 3) = 64, by formulaToString, parseFormula: written as pow(pow(2, 2), 3), read back as 64
pow(2, pow(2, 3)) = 256, by formulaToL3String, parseL3Formula: written as 2^(2^3), read back as 256
pow(2, pow(2, 3)) = 256, by formulaToString, parseFormula: written as pow(2, pow(2, 3)), read back as 256
by MathML: 64
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
