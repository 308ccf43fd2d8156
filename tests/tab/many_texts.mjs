// Runs many texts one after another: kernels of old texts must be released.
//
//   node many_texts.mjs ENGINE WORKER
import {readFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

const [engine_file, worker] = process.argv.slice(2);
const engine = new WebAssembly.Module(readFileSync(engine_file));

// Counts the kernels in the engine's table that were added and not yet dropped.
let held = 0;
const {set} = WebAssembly.Table.prototype;
WebAssembly.Table.prototype.set = function (place, value) {
  held += value === null ? -1 : 1;
  return set.call(this, place, value);
};

let heard = () => {};
globalThis.self = {postMessage: (message) => setImmediate(() => heard(message))};
const page = globalThis.self;
let workers = 0, id = 0;

async function begin(text) {
  await import(`${pathToFileURL(worker)}?${++workers}`);
  page.onmessage({data: {engine, carried: {name: 'test.cascade', text, overrides: '', files: []}}});
}

const ask = (what) => new Promise((resolve) => {
  const mine = ++id;
  heard = (message) => {
    const answer = typeof message === 'string' ? JSON.parse(message) : {};
    if (answer.id === mine) resolve(answer);
  };
  page.onmessage({data: JSON.stringify({...what, id: mine})});
});

function expect(condition, why) {
  if (condition) return;
  console.log(why);
  process.exit(1);
}

const text = (k) => `domain { grid: 8, 8 }\nsystem s { u: x; u' = ${k + 1}/1000 * lap(u) - sin(${k}.5 * u) }\nstage one: s { }`;
await begin(text(0));
for (let k = 0; k < 400; ++k) {
  expect((await ask({do: 'text', text: text(k)})).is_done, `text ${k} is refused`);
  await ask({do: 'step', count: 1});
  await ask({do: 'log'});
}
expect(held > 0 && held < 300, `${held} kernels are held after 400 texts`);
process.exit(0);
