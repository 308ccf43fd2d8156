// Runs the cases that tests/wasm/recorded_kernel.h describes, and compares all bits. All NaN count as equal. Arguments:
// files of cases.
import {readFileSync} from 'node:fs';
import {Reader} from '../support/case_reader.mjs';

const memory = new WebAssembly.Memory({initial: 1});

// The numbers in the bytes, copied so that they are aligned.
function numbers(bytes, numberBytes) {
  const copy = Uint8Array.from(bytes).buffer;
  return numberBytes === 4 ? {values: new Float32Array(copy), words: new Uint32Array(copy)}
                           : {values: new Float64Array(copy), words: new BigUint64Array(copy)};
}

// The first difference between two lists of numbers, or undefined if there is none.
function difference(found, expected, isFree) {
  for (let k = 0; k < expected.words.length; ++k) {
    if (found.words[k] === expected.words[k] || isFree[k] === 1) continue;
    if (Number.isNaN(found.values[k]) && Number.isNaN(expected.values[k])) continue;
    return `element ${k} is ${found.values[k]} (${found.words[k].toString(16)}) and not ` +
        `${expected.values[k]} (${expected.words[k].toString(16)})`;
  }
}

function runCase(reader) {
  const name = reader.list().toString();
  const module = new WebAssembly.Module(reader.list());
  const image = reader.list();
  const missing = Math.ceil((image.length - memory.buffer.byteLength) / 65536);
  if (missing > 0) memory.grow(missing);
  const bytes = new Uint8Array(memory.buffer);
  bytes.set(image);
  const {run} = new WebAssembly.Instance(module, {env: {memory}}).exports;
  for (let calls = reader.number(); calls > 0; --calls) {
    const call = reader.list();
    run(...new Uint32Array(Uint8Array.from(call).buffer));
  }
  const numberBytes = reader.number();
  const resultCount = reader.number();
  const faults = [];
  for (let k = 0; k < resultCount; ++k) {
    const address = reader.number();
    const expected = reader.list();
    const found = bytes.subarray(address, address + expected.length);
    const wrong =
        difference(numbers(found, numberBytes), numbers(expected, numberBytes), reader.list());
    if (wrong) faults.push(`${name}: result ${k}: ${wrong}`);
  }
  return faults;
}

let cases = 0;
const faults = [];
for (const path of process.argv.slice(2)) {
  const reader = new Reader(readFileSync(path));
  for (; !reader.isAtEnd; ++cases) faults.push(...runCase(reader));
}
for (const fault of faults.slice(0, 20)) console.log(fault);
if (faults.length > 0 || cases === 0) {
  console.log(`${faults.length} results of ${cases} cases are wrong`);
  process.exit(1);
}
console.log(`${cases} cases have the same bits`);
