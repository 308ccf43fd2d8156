// Prints the seconds that a call of a kernel's module takes, at best, on planes of one value:
//
//   node bench/wasm_kernels.mjs MODULE WIDTH HEIGHT STRIDE FIELDS MASKS UNIFORMS RESULTS
import {readFileSync} from 'node:fs';

const [width, height, stride, fields, masks, uniforms, results] = process.argv.slice(3).map(Number);
const planeBytes = 4 * stride * (height + 2);
const tableBytes = 4 * (fields + masks + uniforms + results);
const memory = new WebAssembly.Memory(
    {initial: Math.ceil((tableBytes + 64 + (fields + masks + results) * planeBytes) / 65536)});
const words = new Uint32Array(memory.buffer);
const numbers = new Float32Array(memory.buffer);

// Tables are at the beginning of the memory, one after another. Planes follow.
let table = 0;
let plane = Math.ceil(tableBytes / 64) * 64;
function tableOf(count, value) {
  const address = 4 * table;
  for (let k = 0; k < count; ++k) {
    words[table++] = plane + 4 * (stride + 16);
    numbers.fill(value, plane / 4, (plane + planeBytes) / 4);
    plane += planeBytes;
  }
  return address;
}
const tables = [tableOf(fields, 0.5), tableOf(masks, 0), 4 * table];
for (let k = 0; k < uniforms; ++k) numbers[table++] = 0.25;
tables.push(tableOf(results, 0));

const module = new WebAssembly.Module(readFileSync(process.argv[2]));
const {run} = new WebAssembly.Instance(module, {env: {memory}}).exports;
const calls = 100;
let least = Infinity;
for (const end = performance.now() + 500; performance.now() < end;) {
  const before = performance.now();
  for (let k = 0; k < calls; ++k) run(...tables, 0, width, stride, 0, height, -1, -1);
  least = Math.min(least, (performance.now() - before) / calls / 1000);
}
console.log(least);
