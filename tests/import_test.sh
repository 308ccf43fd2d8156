#!/usr/bin/env bash
# `cascade import`: scripts of models of other programs that run, and refusals of models that no script can express.
set -u
rm -rf ./*
unset NO_COLOR

about="import"
source "$SOURCE/tests/support/program_runs.bash"
models=$SOURCE/tests/import
sbml_refusals=()

# imports MODEL NAME [OPTION…]: the script is the expected one, and takes 50 finite steps.
imports() {
    run 0 import "$1" -o "$2.cascade" "${@:3}"
    says out "wrote $2.cascade"
    diff "$models/$2.expected" "$2.cascade" || fail "another script of $1"
    run 0 check "$2.cascade"
    [ ! -s err ] || fail "the script of $1 has warnings"
    run 0 run "$2.cascade" --steps 50 -q -o "$2.png"
}

imports "$models/spots.vti" spots
imports "$models/operators.vti" operators
says_note() { grep -qF "$1" "$2.cascade" || fail "no comment '$1' in $2.cascade"; }
imports "$models/waves.json" waves
imports "$(cat "$models/link.txt")" link

# Presets of a file, with their parents: domains that grow, that a species bounds, cells that read
# others, and pictures read at other places.
cp "$SOURCE/examples/leopard.png" painted_first.png
cp "$SOURCE/examples/leopard.png" painted_second.png
imports "$models/presets.js" growing --preset growing
imports "$models/presets.js" dug --preset Dug
imports "$models/presets.js" life --preset Life
imports "$models/presets.js" painted --preset Painted
run 0 import "$models/presets.js" --preset Spots
run 0 check Spots.cascade
printf '{"parent": "Growing", "minX": 0, "numSpecies": 1, "reactionStr_1": "0"}' >kept.json
run 0 import kept.json --presets "$models/presets.js" -o kept.cascade
run 0 import "https://visualpde.com/sim/?preset=Kept" --presets "$models/presets.js" -o kept_link.cascade
diff <(grep -v '^#' kept.cascade) <(grep -v '^#' kept_link.cascade) || fail "another script of a link"
# Nothing flows through the border of a domain that grows.
sums() {
    run 0 run kept.cascade --steps "$1" -q --precision double --save "kept$1" -o kept.png
    python3 -c '
import array, sys
data = open(sys.argv[1], "rb").read()
print(sum(array.array("d", data[-64 * 64 * 8:])))' "kept$1/grow.u.npy"
}
python3 -c 'import sys; a, b = map(float, sys.argv[1:]); assert a > 100 and abs(a / b - 1) < 1e-9, (a, b)' \
    "$(sums 0)" "$(sums 400)" || fail "the sum in a growing domain changes"

imports "$models/fronts.ode" fronts
imports "$models/clock.ode" clock

# Reactions in SBML, if this build has libSBML.
if [ -e "$BUILD/libcascade_sbml.so" ]; then
    run 0 import "$models/enzyme.xml" -o enzyme.cascade
    diff "$models/enzyme.expected" enzyme.cascade || fail "another script of enzyme.xml"
    run 0 run enzyme.cascade -q --precision double --save enzyme -o enzyme.png
    # Two of S make one of P. All of S reacts, and the integral of sin(t) is added.
    python3 -c '
import array, math
value = lambda name: array.array("d", open(f"enzyme/grow.{name}.npy", "rb").read()[-16:])[0]
s, p = value("S"), value("P")
assert abs(s + 2 * p - 4) < 1e-9, (s, p)
assert 0 < s < 0.01, s
assert abs(value("heat") - (3 + 1 - math.cos(100))) < 1e-3, value("heat")
assert 0 < value("x_") < 4, value("x_")' || fail "other numbers of enzyme.xml"
    run 0 import "$models/enzyme.xml" --diffusion P=0.5 -o spread.cascade
    says_note 'P'"'"' = 0.5 * lap(P)' spread
    math='<math xmlns="http://www.w3.org/1998/Math/MathML"><true/></math>'
    event="<event useValuesFromTriggerTime=\"true\"><trigger initialValue=\"true\" persistent=\"true\">$math</trigger></event>"
    sed "s|</model>|<listOfEvents>$event</listOfEvents>&|" "$models/enzyme.xml" >event.xml
    sed 's|<kineticLaw>|<!-- |; s|</kineticLaw>| -->|' "$models/enzyme.xml" >norate.xml
    sed 's|<plus/><ci> k|<factorial/><ci> k|' "$models/enzyme.xml" >factorial.xml
    sed 's|?>|?><!DOCTYPE sbml>|' "$models/enzyme.xml" >type.xml
    head -30 "$models/enzyme.xml" >half.xml
    sbml_refusals=(event.xml "have no counterpart" norate.xml "has no rate" factorial.xml "factorial"
        type.xml "document types and entities of XML cannot be read" half.xml "this is not valid XML")
fi

# The name that -o gives, and no file is replaced.
rm spots.cascade
run 0 import "$models/spots.vti"
cmp spots.cascade "$models/spots.expected" || fail "another script without -o"
run 3 import "$models/spots.vti"
says err 'spots.cascade already exists'
run 64 import
run 2 import "$SOURCE/README.md"
says err 'has no format that can be imported'
run 64 import "$models/spots.vti" --diffusion a=1
says err 'has its own diffusion'
run 0 import "$models/clock.ode" --diffusion x=0.5 -o disc.cascade
says_note '0.5 * lap(x_)' disc

# A flat start waits for a click.
run 0 import "$(cat "$models/link.txt")" -o flat.cascade
says err 'cascade view flat.cascade'

# A step that is too long for the differences here is shortened, with a note.
sed 's|> 0.002 <|> 0.2 <|; s|c = [^;]*;||; s|number_of_chemicals|accuracy="low" &|' "$models/operators.vti" >long.vti
run 0 import long.vti
says err 'it was shortened to'
says_note "Note: The source's step of 0.2 is unstable" long
says_note "Note: Ready's bilaplacian has its own stencil" long
run 0 run long.cascade --steps 8 -q -o long.png

# Values of all cells: as text, in Base64, compressed, and after all elements, all the same.
cat >make.py <<'END2'
import base64, struct, sys, zlib
W, H = 8, 4
values = [0.25 * i + j for j in range(H) for i in range(W)]
raw = struct.pack("<%df" % len(values), *values)

def b64(data): return base64.b64encode(data).decode()
def block(data, size=64):
    parts = [data[k:k + size] for k in range(0, len(data), size)]
    packed = [zlib.compress(p) for p in parts]
    last = len(parts[-1]) % size
    head = struct.pack("<%dI" % (3 + len(parts)), len(parts), size, last, *map(len, packed))
    return head, b"".join(packed)

def file(name, array, compressed=False, after="", extent=(W, H), head=""):
    kind = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    with open(name, "wb") as out:
        out.write(('%s<VTKFile type="ImageData" byte_order="LittleEndian"%s><RD><rule name="R" type="formula">'
                   '<param name="timestep">0.1</param>'
                   '<formula number_of_chemicals="1">delta_a = laplacian_a;</formula></rule>'
                   '<initial_pattern_generator apply_when_loading="false"/></RD>'
                   '<ImageData WholeExtent="0 %d 0 %d 0 0"><Piece><PointData>%s</PointData></Piece></ImageData>'
                   % (head, kind, extent[0] - 1, extent[1] - 1, array)).encode())
        out.write(after if isinstance(after, bytes) else after.encode())
        out.write(b"</VTKFile>\n")

def array(attributes, text=""):
    return '<DataArray type="Float32" Name="a" %s>%s</DataArray>' % (attributes, text)

size = struct.pack("<I", len(raw))
head, packed = block(raw)
binary = b64(head) + b64(packed)
file("ascii.vti", array('format="ascii"', " ".join(map(str, values))))
file("binary.vti", array('format="binary"', b64(size + raw)))
file("zlib.vti", array('format="binary"', binary), True)
file("later.vti", array('format="appended" offset="0"'), True,
     '<AppendedData encoding="base64">_' + binary + "</AppendedData>")
file("raw.vti", array('format="appended" offset="0"'), False,
     b'<AppendedData encoding="raw">_' + size + raw + b"</AppendedData>")
# Hostile files.
file("short.vti", array('format="binary"', binary[:-40]), True)
file("wrong.vti", array('format="binary"', "????" + binary), True)
bomb = zlib.compress(bytes(50_000_000))
file("bomb.vti", array('format="binary"', b64(struct.pack("<4I", 1, 128, 0, len(bomb))) + b64(bomb)), True)
file("large.vti", array('format="binary"', b64(struct.pack("<4I", 1, 50_000_000, 0, len(bomb))) + b64(bomb)), True)
file("many.vti", array('format="binary"', b64(struct.pack("<3I", 0xffffffff, 0xffffffff, 0))), True)
file("fewer.vti", array('format="ascii"', "1 2 3"))
file("huge.vti", array('format="ascii"', "1"), extent=(200_000, 200_000))
file("none.vti", array('format="ascii"', "1"), extent=(0, 1))
file("beyond.vti", array('format="appended" offset="99999999"'), False, "<AppendedData>_</AppendedData>")
file("entity.vti", array('format="ascii"', "&x;"), head='<!DOCTYPE x [<!ENTITY x "1 1 1">]>')
open("deep.vti", "w").write("<VTKFile>" * 1_000_000)
open("open.vti", "w").write("<VTKFile><RD><rule type='formula'")
formulas = {
    "loop": "while (1) { a = 1; }", "function": "delta_a = erf(a);", "name": "delta_a = sesame;",
    "vector": "delta_a = (float4)(1, 2, 3, 4);", "bits": "delta_a = a ^ 2;", "compare": "delta_a = a &lt; 1;",
    "brackets": "delta_a = " + "(" * 5000 + "a" + ")" * 5000 + ";",
    "rounds": "delta_a = " + "round(" * 60 + "a" + ")" * 60 + ";",
    "sum": "delta_a = a" + "+a" * 3_000 + ";", "ends": "delta_a = a +"}
for name, formula in formulas.items():
    text = open("ascii.vti").read().replace("delta_a = laplacian_a;", formula)
    open(name + ".vti", "w").write(text)
text = open("ascii.vti").read()
open("kernel.vti", "w").write(text.replace('type="formula"', 'type="kernel"'))
END2
python3 make.py || fail "make.py"
for name in ascii binary zlib later raw; do
    run 0 import $name.vti
    [ "$(wc -c <${name}_a.npy)" -gt 128 ] || fail "no values of $name.vti"
    cmp ascii_a.npy ${name}_a.npy || fail "other values of $name.vti"
    run 0 run $name.cascade --steps 5 -q -o $name.png
done
# Rows are turned upside down.
python3 -c '
import struct
data = open("ascii_a.npy", "rb").read()
values = struct.unpack("<32f", data[-128:])
assert values[0] == 3 and values[-1] == 1.75, values' || fail "rows in another order"

# refuses FILE TEXT: nothing is written, and the message has this text.
refuses() {
    run 2 import "$1" -o refused.cascade
    says err "$2"
    [ ! -e refused.cascade ] && [ ! -e refused_a.npy ] || fail "$1 was refused, but something was written"
}
refuses short.vti "is not valid Base64, or ends too early"
refuses wrong.vti "is not valid Base64, or ends too early"
refuses bomb.vti "is not compressed by zlib as its header says"
refuses large.vti "is larger than the domain"
refuses many.vti "is larger than the domain"
refuses fewer.vti "does not have 32 numbers"
refuses huge.vti "a domain of 1 to 67108864 cells is expected"
refuses none.vti "a domain of 1 to 67108864 cells is expected"
refuses beyond.vti "begins beyond the end of the file"
refuses entity.vti "document types and entities of XML cannot be read"
refuses deep.vti "nested more than 100 deep"
refuses open.vti "this is not valid XML"
refuses loop.vti "'while' of OpenCL has no counterpart"
refuses function.vti "the function 'erf' of 1 arguments has no counterpart"
refuses name.vti "'sesame' has no meaning here"
refuses vector.vti "a vector of several values has no counterpart in Cascade"
refuses bits.vti "'^' combines the bits"
refuses compare.vti "a comparison is used as a number here"
refuses brackets.vti "nested more than 200 deep"
refuses rounds.vti "has no counterpart"
refuses sum.vti "nested more than 1000 deep"
refuses ends.vti "where a value is missing"
refuses kernel.vti "is a program, not a formula"

for ((k = 0; k < ${#sbml_refusals[@]}; k += 2)); do
    refuses "${sbml_refusals[k]}" "${sbml_refusals[k + 1]}"
done

# Meshes are not listed among the formats, and refused by name.
sed 's/ImageData/UnstructuredGrid/g' "$models/spots.vti" >mesh.vtu
refuses mesh.vtu "on meshes (.vtu) cannot be imported"

# VisualPDE and XPPAUT.
border='"numSpecies": 1, "reactionStr_1": "0", "domainViaIndicatorFun": true, "domainIndicatorFun": "x > t"'
printf '{%s, "boundaryConditions_1": "neumann", "neumannStr_1": "1"}' "$border" >mask.json
refuses mask.json "a slope at a border that moves has no counterpart"
printf '{%s, "boundaryConditions_1": "neumann", "diffusionStr_1_1": "1; 2"}' "$border" >tensor.json
refuses tensor.json "two coefficients of diffusion in a domain that changes have no counterpart"
printf '{"initCond_1": "I_S(x^2, y)"}' >bent.json
refuses bent.json "only at positions that are linear in x and y"
printf '{"initialState": "state.bin"}' >state.json
refuses state.json "a state that VisualPDE reads from a file has no counterpart"
refuses "$models/presets.js" "the file has 8 presets"
refuses_with() {
    run 2 import "$1" "${@:3}" -o refused.cascade
    says err "$2"
    [ ! -e refused.cascade ] || fail "$1 was refused, but something was written"
}
refuses_with "$models/presets.js" "did you mean 'Painted'?" --preset Paintd
refuses_with "$models/presets.js" "is based on too many other presets" --preset Round
printf '{"parent": "Turing"}' >child.json
refuses child.json "which is missing"
echo "let nothing = {};" >nothing.js
refuses_with child.json "this file has no presets of VisualPDE" --presets nothing.js
refuses "https://visualpde.com/sim/?preset=Kept" "does not contain its options"
sed 's/};$/}}/; s/"Growing"] = {/"Growing"] = {{/' "$models/presets.js" >broken.js
refuses_with broken.js "this preset cannot be read" --preset Growing
says err 'presets["Growing"] = {{'
run 64 import "$models/spots.vti" --preset a
says err "so --preset has no meaning"
run 2 import child.json --presets missing.js
printf '{"numSpecies": 1, "reactionStr_1": "sesame(u)"}' >word.json
refuses word.json "'sesame'"
printf '{"numSpecies": 9}' >nine.json
refuses nine.json "1 to 4 species are expected"
printf '{"numSpecies": ' >cut.json
refuses cut.json "this is not the JSON of a simulation"
refuses "https://visualpde.com/sim/?options=N4IgDiBcIMIK4" "damaged or incomplete"
refuses "https://visualpde.com/sim/" "lacks 'options=…'"
printf "u'=-u\ntable f f.dat\n" >table.ode
refuses table.ode "'table' has no counterpart"
printf "u'=-u+erf(u)\n" >erf.ode
refuses erf.ode "the function 'erf' has no counterpart"
printf "# nothing\n" >empty.ode
refuses empty.ode "has no equation"
echo "import: ok"
