// Uses the installed npm package, as tests/npm_package_test.sh prepares it.
import { deepEqual, equal, ok, throws } from "node:assert/strict";
import { readFileSync } from "node:fs";
import * as everything from "cascade-patterns";

const { CascadeError, Cascade, Pattern, load } = everything;
const cascade = await load();
const script = readFileSync("spots.cascade", "utf8");

/// The numbers of an array that `cascade run --save` wrote.
function numbers(file) {
    const bytes = readFileSync(file);
    const start = 10 + bytes.readUInt16LE(8);
    return new Float32Array(bytes.buffer.slice(bytes.byteOffset + start, bytes.byteOffset + bytes.length));
}
const bits = (data) => [...new Uint32Array(data.slice().buffer)];

// Patterns have the same bits as in the program, also in a volume, and however many steps are taken
// at a time.
for (const name of ["spots", "volume"]) {
    const pattern = cascade.pattern(readFileSync(`${name}.cascade`, "utf8"), { set: { rate: 0.15 } });
    deepEqual(pattern.stages, ["one", "two"]);
    equal(pattern.step(7), 7);
    equal(pattern.step(60), 60);
    deepEqual([pattern.stage, pattern.steps, pattern.finished], ["two", 7, false]);
    pattern.run();
    equal(pattern.finished, true);
    equal(pattern.step(), 0);
    const u = pattern.values("u");
    deepEqual([u.width, u.height, u.depth], name === "spots" ? [40, 24, 1] : [12, 10, 6]);
    deepEqual(bits(u.data), bits(numbers(`${name}/two.u.npy`)));
}

// Errors have their places and hints, and refused changes have no effect.
const [error] = cascade.check("stage one: turing_spots {\n  kaa: 1\n}\n");
deepEqual([error.is_error, error.from], [true, [2, 2]]);
ok(error.message.includes("kaa") && error.hint.includes("ka"));
deepEqual(cascade.check(script), []);
throws(() => cascade.pattern("nonsense"), CascadeError);
throws(() => cascade.pattern(script, { set: { rote: 1 } }), /rote/);
const pattern = cascade.pattern(script);
const before = bits(pattern.values("u").data);
for (const wrong of [() => pattern.set("rote", 1), () => pattern.paint("u", "1/0"), () => pattern.values("nobody"),
                     () => pattern.values("rgb(1, 0, 0)"), () => pattern.set_script("stage x: nobody {}"), () => pattern.undo(),
                     () => pattern.picture({ palette: "nothing" }), () => pattern.features("nobody")]) {
    throws(wrong, CascadeError);
}
throws(() => pattern.step(-1), RangeError);
throws(() => pattern.step(0.5), RangeError);
deepEqual(bits(pattern.values("u").data), before);
const bomb = cascade.pattern("system bomb { u: 1; u' = u * u * u }\nstage one: bomb { iterations: 1000 }\ndomain { grid: 4, 4 }");
throws(() => bomb.run(), /not finite/);

// Changes, undo, parameters, pictures and features.
pattern.step(5);
pattern.set("one.rate", "1/8");
pattern.paint("u", "if(disc(0.5, 0.5, 0.2) > 0, 3, u)");
equal(Math.max(...pattern.values("u").data), 3);
pattern.undo();
deepEqual(pattern.parameters.map(({ name, value, doc }) => [name, value, doc])[0], ["one.rate", 0.125, "How fast it goes."]);
pattern.redo();
pattern.begin_next_stage();
equal(pattern.stage, "two");
ok(pattern.session().startsWith("cascade session 1\n"));
deepEqual(pattern.species, ["u"]);
const picture = pattern.picture({ show: "u", palette: "viridis", scale: 2, range: [0, 3] });
deepEqual([...picture.slice(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
equal(new DataView(picture.buffer).getUint32(16), 80);
equal(pattern.features("u").largest, 3);
const seeded = (seed) => bits(cascade.pattern(script, { seed }).values("u").data);
deepEqual(seeded(7), seeded(7));
ok(seeded(7).some((word, k) => word !== seeded(8)[k]));

// Patterns do not disturb each other, and the engine can be given as bytes.
const other = await Cascade.load(readFileSync("node_modules/cascade-patterns/engine.wasm"));
const [one, two] = [cascade.pattern(script), other.pattern(script)];
one.step(10);
two.run();
one.run();
deepEqual(bits(one.values("u").data), bits(two.values("u").data));

// Every exported name and every public member has a type, and every type belongs to a member that
// exists.
const types = readFileSync("node_modules/cascade-patterns/index.d.ts", "utf8");
const class_text = (name) => types.split(`export class ${name} `)[1].split("\n}")[0];
for (const name of Object.keys(everything)) ok(new RegExp(`export (class|function) ${name}\\b`).test(types), name);
for (const [type, one_of_it] of [["Pattern", pattern], ["Cascade", cascade]]) {
    const typed = [...class_text(type).matchAll(/^ {4}(?:readonly )?([a-z_]+)[(:]/gm)].map(([, name]) => name);
    for (const name of typed) ok(name in one_of_it, `${type}.${name} is missing`);
    ok(typed.length > 0);
}
const is_private = new Set(["constructor", "volume", "change", "take", "ask", "refusal", "look"]);
for (const name of Object.getOwnPropertyNames(Pattern.prototype)) {
    ok(is_private.has(name) || new RegExp(`\\b${name}[(:]`).test(class_text("Pattern")), `${name} has no type`);
}
console.log("the package works");
