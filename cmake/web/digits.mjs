// Fits and diagnoses every measurement under data/ twice, by the page's engine and by the native command, with default
// options, and says where the records differ and by how much.
//   node digits.mjs ENGINE=<lyrefit_web.js> APP=<lyrefit> DATA=<data> [LIMIT=1e-7]
// They do not agree in every bit: exp, log and pow of the GNU C library take other roads on processors with fused
// multiply-add, which WebAssembly has not, and expm1, log1p, log10, hypot and the rest are other code. Numbers that
// are nothing but what rounding left, as the mean of residuals or the misfit of a base that fits, differ wholly.
// Fails if a parameter of a fit differs by more than LIMIT of itself, or a word of what is concluded.
import {spawnSync} from 'node:child_process';
import {readFileSync, readdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const given = Object.fromEntries(process.argv.slice(2).map((word) => word.split(/=(.*)/s).slice(0, 2)));
const limit = Number(given.LIMIT ?? 1e-7);
const concluded = {
  fit: /^\/(usable|model|parameters\/[a-z_0-9]+\/(refined|at_bound|identifiable))/,
  diagnose: /^\/(usable|verdict\/.*\(words\)$)/,
};
// What no measurement lies in: tables of results, and a plant, whose strings take minutes.
const without = new Set(['batch', 'landscapes', 'paper', 'plant', 'schema']);

function* filesOf(folder) {
  for (const entry of readdirSync(folder, {withFileTypes: true})) {
    const name = path.join(folder, entry.name);
    if (entry.isDirectory() && !without.has(entry.name)) yield* filesOf(name);
    if (entry.isFile() && !/\.(md|svg)$|^expected\.json$|^bounds-/.test(entry.name)) yield name;
  }
}

async function startEngine() {
  globalThis.lyrefitProgress = () => {};
  const script = path.resolve(given.ENGINE);
  const bytes = readFileSync(script.replace(/\.js$/, '.wasm'));
  const started = performance.now();
  const engine = await createRequire(import.meta.url)(script)({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(bytes, imports).then(({instance}) => done(instance));
      return {};
    },
  });
  console.log(`${bytes.length} bytes of WebAssembly, started in ${(performance.now() - started).toFixed(0)} ms`);
  return engine;
}

// The same path in the engine's own files, with what lies beside it.
function copyIn(engine, file) {
  const folder = path.dirname(file);
  engine.FS.mkdirTree(folder);
  for (const entry of readdirSync(folder, {withFileTypes: true})) {
    const name = path.join(folder, entry.name);
    if (entry.isFile()) engine.FS.writeFile(name, readFileSync(name));
  }
}

// A record as pairs of place and value, without times.
function* leaves(value, place = '') {
  if (value !== null && typeof value === 'object') {
    for (const [key, part] of Object.entries(value)) {
      if (!/seconds/.test(key)) yield* leaves(part, `${place}/${key}`);
    }
  } else {
    yield [place, value];
  }
}

// {numbers, other: those that differ, worst: {by, place}, texts: places where words differ}
function difference(ours, theirs) {
  const expected = new Map(leaves(theirs));
  const found = new Map(leaves(ours));
  const result = {numbers: 0, other: 0, worst: {by: 0, place: ''}, texts: [], far: []};
  for (const place of new Set([...expected.keys(), ...found.keys()])) {
    const a = found.get(place), b = expected.get(place);
    if (typeof a !== 'number' || typeof b !== 'number') {
      if (a === b) continue;
      result.texts.push(`${place}: ${a} | ${b}`);
      result.far.push({place: `${place} (words)`, by: 0});
      continue;
    }
    ++result.numbers;
    if (a === b) continue;
    ++result.other;
    const by = Math.abs(a - b) / Math.max(Math.abs(a), Math.abs(b));
    if (by > limit) result.far.push({place, by});
    if (by > result.worst.by) result.worst = {by, place: `${place} ${a} | ${b}`};
  }
  return result;
}

const engine = await startEngine();
const far = new Map();  // kinds of places where numbers differ by more than LIMIT, or words
const sum = {records: 0, equal: 0, numbers: 0, other: 0, refused: 0, failed: 0, worst: 0};
for (const verb of ['fit', 'diagnose']) {
  for (const file of filesOf(given.DATA)) {
    const native = spawnSync(given.APP, [verb, file, '--json', '-'], {encoding: 'utf8', maxBuffer: 1 << 28});
    copyIn(engine, file);
    const started = performance.now();
    const answer = JSON.parse(
        engine.ccall('lyrefit_run', 'string', ['string'], [JSON.stringify({verb, file, options: {}})]));
    const took = performance.now() - started;
    if (native.stdout === '' && answer.error !== undefined) {
      ++sum.refused;
      continue;
    }
    ++sum.records;
    if (native.stdout === '' || answer.error !== undefined) {
      ++sum.failed;
      console.log(`${verb} ${file}: ${answer.error ?? 'read'} | ${native.stderr.trim() || 'read'}`);
      continue;
    }
    const met = difference(JSON.parse(answer.report_json), JSON.parse(native.stdout));
    for (const {place, by} of met.far) {
      const kind = `${verb} ${place.replace(/\/\d+(?=\/|$)/g, '/*')}`;
      const known = far.get(kind) ?? {count: 0, by: 0};
      far.set(kind, {count: known.count + 1, by: Math.max(known.by, by)});
    }
    sum.numbers += met.numbers;
    sum.other += met.other;
    sum.worst = Math.max(sum.worst, met.worst.by);
    if (met.other === 0 && met.texts.length === 0) ++sum.equal;
    if (met.far.some(({place}) => concluded[verb].test(place))) ++sum.failed;
    console.log(`${verb} ${file}: ${took.toFixed(0)} ms, ${met.other} of ${met.numbers} numbers differ` +
                (met.other > 0 ? `, by ${met.worst.by.toExponential(1)} at ${met.worst.place}` : '') +
                met.texts.slice(0, 3).map((text) => `\n    ${text}`).join(''));
  }
}
for (const [kind, {count, by}] of [...far].sort((a, b) => b[1].count - a[1].count)) {
  console.log(`${String(count).padStart(6)} ${by.toExponential(1)} ${kind}`);
}
console.log(`${sum.equal} of ${sum.records} records equal in every bit, ${sum.other} of ${sum.numbers} numbers differ, ` +
            `largest difference ${sum.worst.toExponential(1)}; ${sum.failed} conclude otherwise; ${sum.refused} files refused by both; ` +
            `memory ${(engine.HEAPU8.length / 2 ** 20).toFixed(0)} MiB`);
process.exitCode = sum.failed > 0 ? 1 : 0;
