// colours.mjs GRAMMAR SCRIPT: prints the colours that a TextMate grammar gives to a script, as the
// library of VS Code computes them.
import fs from "node:fs";
import path from "node:path";
import { createRequire } from "node:module";

const require = createRequire(path.join(process.cwd(), "package.json"));
const textmate = require("vscode-textmate"), oniguruma = require("vscode-oniguruma");
await oniguruma.loadWASM(fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
const [grammarPath, scriptPath] = process.argv.slice(2);
const registry = new textmate.Registry({
    onigLib: { createOnigScanner: (all) => new oniguruma.OnigScanner(all), createOnigString: (text) => new oniguruma.OnigString(text) },
    loadGrammar: () => textmate.parseRawGrammar(fs.readFileSync(grammarPath, "utf8"), grammarPath),
});
const grammar = await registry.loadGrammar("source.cascade");

const classes = [["comment.line.doc", "doc"], ["comment", "comment"], ["string", "string"], ["constant.numeric", "number"],
    ["keyword", "keyword"], ["support.type", "setting"], ["support.function", "function"], ["support.constant", "word"],
    ["constant.language", "value"]];
let state = textmate.INITIAL;
fs.readFileSync(scriptPath, "utf8").split("\n").forEach((line, row) => {
    const result = grammar.tokenizeLine(line, state), colours = Array(line.length).fill("");
    state = result.ruleStack;
    for (const { startIndex, endIndex, scopes } of result.tokens) {
        const name = classes.find(([scope]) => scopes.at(-1).startsWith(scope))?.[1] ?? "";
        const isQuoted = ["doc", "comment", "string"].includes(name);
        for (let k = startIndex; k < Math.min(endIndex, line.length); ++k) colours[k] = isQuoted || !/\s/.test(line[k]) ? name : "";
    }
    for (let first = 0; first < line.length;) {
        let last = first;
        while (last + 1 < line.length && colours[last + 1] === colours[first]) ++last;
        if (colours[first]) console.log(`${row + 1}:${first + 1}-${last + 1} ${colours[first]}`);
        first = last + 1;
    }
});
