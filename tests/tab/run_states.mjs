// Runs the scripts of tests/tab/make_states.cpp in node, with the worker and the engine of exported pages, and compares
// the bits of all species.
//
//   node run_states.mjs ENGINE WORKER STATES
import {readFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

const [engine_file, worker, states_file] = process.argv.slice(2);
const engine = new WebAssembly.Module(readFileSync(engine_file));
const states = JSON.parse(readFileSync(states_file, 'utf8'));

// A worker has one engine, so a new worker runs each script: the module of the worker, with a
// substitute for the page.
let heard;
globalThis.self = {postMessage: (message) => setImmediate(() => heard(message))};
let workers = 0;
const start = () => import(`${pathToFileURL(worker)}?${++workers}`);

function read(frame) {
  const size = new DataView(frame).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 4, size)));
  const words = new Uint32Array(frame, 4 + size, header.columns * header.rows);
  return {header, words};
}

function hashOf(words) {
  let hash = 0x811c9dc5;
  for (const word of words) {
    const isNaN = (word & 0x7f800000) === 0x7f800000 && (word & 0x7fffff) !== 0;
    hash = Math.imul(hash ^ (isNaN ? 0x7fc00000 : word), 0x01000193);
  }
  return hash >>> 0;
}

/// Runs a script, and returns the hashes of its species, or the reason why there are none.
async function run({name, text, overrides, is_exact, files, species}) {
  await start();
  const page = globalThis.self;
  return new Promise((resolve) => {
    const say = (what) => page.onmessage({data: JSON.stringify(what)});
    const hashes = [];
    let isRunning = true, shows = 0;
    heard = (message) => {
      if (typeof message !== 'string') {
        const {header, words} = read(message);
        if (header.kind !== 'snapshot') return;
        if (header.failure) return resolve({fault: header.failure});
        if (isRunning) {
          if (header.is_going_on) return say({do: 'next_snapshot'});
          isRunning = false;
        } else {
          hashes.push(hashOf(words));
        }
        if (hashes.length === species.length) return resolve({hashes, steps: header.steps});
        say({do: 'show', expression: species[hashes.length][0], id: 10 + ++shows});
        return say({do: 'next_snapshot'});
      }
      const answer = JSON.parse(message);
      if (answer.kind === 'palettes') {
        say({do: 'run', id: 1});
        say({do: 'next_snapshot'});
      } else if (answer.kind === 'answer' && !answer.is_done) {
        resolve({fault: JSON.stringify(answer.messages)});
      }
    };
    const carried = {name, text, overrides, is_exact, files: files.map(([file, bytes]) => [file, Buffer.from(bytes, 'base64')])};
    page.onmessage({data: {engine, carried}});
  });
}

let faults = 0;
for (const state of states) {
  const {fault, hashes, steps} = await run(state);
  const wrong = fault ?? (steps !== state.steps ? `${steps} steps and not ${state.steps}`
      : state.species.map(([name, hash], k) => hash === hashes[k] ? '' : `${name} has other bits`).filter(Boolean).join(', '));
  if (!wrong) continue;
  ++faults;
  console.log(`${state.name}: ${wrong}`);
}
console.log(`${states.length - faults} of ${states.length} scripts have the same bits`);
process.exit(faults > 0 || states.length === 0 ? 1 : 0);
