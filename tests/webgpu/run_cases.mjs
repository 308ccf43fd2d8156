// Runs the cases that tests/webgpu/webgpu_case.h describes on WebGPU, and compares all bits. All NaN count as equal.
// Arguments: files of cases. The packages are found from the working directory.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';
import {Reader} from '../support/case_reader.mjs';

const require = createRequire(pathToFileURL(`${process.cwd()}/`));
const {create, globals} = await import(pathToFileURL(require.resolve('webgpu')));
Object.assign(globalThis, globals);

// Objects that nothing refers to would be destroyed while they compute.
const kept = globalThis.kept = {gpu: create([])};
kept.adapter = await kept.gpu.requestAdapter();
if (!kept.adapter) {
  console.log('there is no WebGPU adapter');
  process.exit(1);
}
const {info, limits} = kept.adapter;
const device = kept.device = await kept.adapter.requestDevice({
  requiredLimits: {maxStorageBuffersPerShaderStage: Math.min(8, limits.maxStorageBuffersPerShaderStage)},
});
const errors = [];
device.addEventListener('uncapturederror', (event) => errors.push(event.error.message));

const wordsOf = (reader) => new Uint32Array(Uint8Array.from(reader.list()).buffer);
const textOf = (reader) => reader.list().toString();
const manyOf = (reader, read) => Array.from({length: reader.number()}, () => read(reader));

const readCall = (reader) => ({
  isHalo: reader.number() === 1,
  kernel: textOf(reader),
  words: wordsOf(reader),
  groups: [reader.number(), reader.number()],
});
const readExpected = (reader) => ({
  name: textOf(reader),
  place: reader.number(),
  words: wordsOf(reader),
  isFree: reader.list(),
});
const readCase = (reader) => ({
  name: textOf(reader),
  programs: [textOf(reader), textOf(reader)],
  buffers: [wordsOf(reader), wordsOf(reader), wordsOf(reader), wordsOf(reader), wordsOf(reader)],
  calls: manyOf(reader, readCall),
  expected: manyOf(reader, readExpected),
});

const visibility = GPUShaderStage.COMPUTE;
const readOnly = {type: 'read-only-storage'};
const groupLayout = device.createBindGroupLayout({
  entries: [
    {binding: 0, visibility, buffer: {type: 'uniform', hasDynamicOffset: true}},
    {binding: 1, visibility, buffer: {type: 'storage'}},
    ...[2, 3, 4, 5].map((binding) => ({binding, visibility, buffer: readOnly})),
  ],
});
const layout = device.createPipelineLayout({bindGroupLayouts: [groupLayout]});
const modules = new Map();
const pipelines = new Map();

async function moduleOf(code) {
  if (modules.has(code)) return modules.get(code);
  const made = device.createShaderModule({code});
  const {messages} = await made.getCompilationInfo();
  for (const {type, lineNum, message} of messages) {
    if (type === 'error') errors.push(`${message}: ${code.split('\n')[lineNum - 1]}`);
  }
  modules.set(code, made);
  return made;
}

async function pipelineOf(code, entryPoint) {
  const key = `${entryPoint} of ${code}`;
  if (!pipelines.has(key)) {
    const module = await moduleOf(code);
    if (errors.length > 0) return undefined;
    pipelines.set(key, device.createComputePipeline({layout, compute: {module, entryPoint}}));
  }
  return pipelines.get(key);
}

function bufferOf(words, usage) {
  const made = device.createBuffer({size: Math.max(16, words.byteLength), usage: usage | GPUBufferUsage.COPY_DST});
  device.queue.writeBuffer(made, 0, words);
  return made;
}

const isNaNWord = (word) => (word & 0x7fffffff) > 0x7f800000;

// The first wrong word, or undefined if there is none.
function difference(found, {name, words, isFree}) {
  for (let k = 0; k < words.length; ++k) {
    if (found[k] === words[k] || isFree[k] === 1 || (isNaNWord(found[k]) && isNaNWord(words[k]))) continue;
    return `${name}: word ${k} is ${found[k].toString(16)} and not ${words[k].toString(16)}`;
  }
}

const alignment = limits.minUniformBufferOffsetAlignment;

async function faultsOf({name, programs, buffers, calls, expected}) {
  const {STORAGE, UNIFORM, COPY_SRC, COPY_DST, MAP_READ} = GPUBufferUsage;
  const most = Math.max(...calls.map(({words}) => words.length));
  const bytesOfCall = Math.ceil(4 * most / alignment) * alignment;
  const words = new Uint32Array(bytesOfCall / 4 * calls.length);
  calls.forEach((call, k) => words.set(call.words, k * bytesOfCall / 4));
  const [planes, ...others] = buffers.map((buffer) => bufferOf(buffer, STORAGE | COPY_SRC));
  const uniforms = bufferOf(words, UNIFORM);
  const entries = [{buffer: uniforms, size: Math.ceil(most / 4) * 16}, {buffer: planes}, ...others.map((buffer) => ({buffer}))];
  const group = device.createBindGroup({layout: groupLayout, entries: entries.map((resource, binding) => ({binding, resource}))});
  const pipelinesOfCalls = [];
  for (const {isHalo, kernel} of calls) pipelinesOfCalls.push(await pipelineOf(programs[isHalo ? 1 : 0], kernel));
  if (errors.length > 0) return errors.splice(0).map((error) => `${name}: ${error}`);
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  calls.forEach(({groups}, k) => {
    pass.setPipeline(pipelinesOfCalls[k]);
    pass.setBindGroup(0, group, [k * bytesOfCall]);
    pass.dispatchWorkgroups(...groups);
  });
  pass.end();
  const result = device.createBuffer({size: buffers[0].byteLength, usage: MAP_READ | COPY_DST});
  encoder.copyBufferToBuffer(planes, 0, result, 0, buffers[0].byteLength);
  device.queue.submit([encoder.finish()]);
  await result.mapAsync(GPUMapMode.READ);
  const all = new Uint32Array(result.getMappedRange());
  const faults = expected.map((each) => difference(all.subarray(each.place), each)).filter(Boolean);
  result.unmap();
  for (const buffer of [planes, ...others, uniforms, result]) buffer.destroy();
  return [...errors.splice(0), ...faults].map((fault) => `${name}: ${fault}`);
}

let cases = 0;
const faults = [];
for (const path of process.argv.slice(2)) {
  const reader = new Reader(readFileSync(path));
  for (; !reader.isAtEnd && faults.length < 20; ++cases) {
    const next = readCase(reader);
    faults.push(...await faultsOf(next));
    if (cases > 0) continue;
    // The comparison itself must work.
    const {words, isFree} = next.expected[0];
    words[isFree.findIndex((free, k) => free === 0 && !isNaNWord(words[k]))] ^= 1;
    if ((await faultsOf(next)).length !== 1) faults.push('a wrong bit was not found');
  }
}
for (const fault of faults) console.log(fault);
if (faults.length > 0 || cases === 0) {
  console.log(`${cases} cases, some of them wrong`);
  process.exitCode = 1;
} else {
  console.log(`${cases} cases have the same bits on ${info.vendor} ${info.device}`);
}
device.destroy();
