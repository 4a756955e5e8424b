// The generator and the checks as WebAssembly, in a script beside this one (docs/internals/wasm.md).
import { bytesOf, unzipped } from './figure.js';

let starting = null;

async function loaded(load, name, file) {
  if (!window[name]) await load(file).catch(() => { throw new Error(`${file} is missing or damaged`); });
  return window[name];
}

async function start(load) {
  const begun = performance.now();
  const make = await loaded(load, 'contortEngine', 'viewer/engine.js');
  const library = await loaded(load, 'contortLibrary', 'viewer/library.js');
  const engine = await make({ wasmBinary: await unzipped(bytesOf(make.packed)) });
  // Not by ccall, which puts texts on the stack: a character with its skin is larger than that.
  const call = (name, ...texts) => {
    const places = texts.map((text) => engine.allocateUTF8(text));
    const answer = engine.UTF8ToString(engine[name](...places));
    for (const place of places) engine._free(place);
    return answer;
  };
  for (const text of library) {
    const why = call('_contort_add', text);
    if (why) throw new Error(why);
  }
  return { play: (...texts) => call('_contort_play', ...texts), ms: performance.now() - begun };
}

// Starts it once for all cases. play(spec, check, subject) returns the text of a contort.report_case/1; `ms` is the
// time that loading and starting took. load(file) loads a script.
export function startEngine(load) {
  starting ??= start(load).catch((error) => { starting = null; throw error; });
  return starting;
}
