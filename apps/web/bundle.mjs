// Packs the page into one file: its HTML, styles, scripts, examples, and the engine, packed.
//   node bundle.mjs SCRIPT=engine.js WASM=engine.wasm SOURCE=repository VERSION=1.2.3 OUT=lyrefit.html LICENCES=file,file
import {existsSync, readFileSync, renameSync, writeFileSync} from 'node:fs';
import {basename, join} from 'node:path';
import {gzipSync} from 'node:zlib';

const given = Object.fromEntries(process.argv.slice(2).map((each) => {
  const at = each.indexOf('=');
  return [each.slice(0, at), each.slice(at + 1)];
}));
const text = (...path) => readFileSync(join(given.SOURCE, ...path), 'utf8');
const page = (name) => text('apps/web/page', name);
const report = (name) => text('lib/lyrefit/report/assets', name);

const packed = (id, bytes) =>
    `<script type="application/gzip" id="${id}">${gzipSync(bytes, {level: 9}).toString('base64')}</script>`;
// Four bytes as five letters, where base64 has three as four; engine.js reads them. None of the letters is of HTML.
const kLetters = [...Array(92).keys()].map((i) => String.fromCharCode(35 + i)).filter((letter) => !'&<\\`'.includes(letter)).slice(0, 85);
function packedTight(id, content) {
  const bytes = gzipSync(content, {level: 9});
  const padded = Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3)]);
  const words = [];
  for (let at = 0; at < padded.length; at += 4) {
    let word = '';
    for (let rest = padded.readUInt32BE(at), i = 0; i < 5; ++i, rest = Math.floor(rest / 85)) word = kLetters[rest % 85] + word;
    words.push(word);
  }
  return `<script type="application/gzip" id="${id}" data-bytes="${bytes.length}">${words.join('')}</script>`;
}
const packedJson = (id, data) => packed(id, JSON.stringify(data));
// A script that the page does not run, for the worker.
const unread = (id, script) => `<script type="text/plain" id="${id}">\n${script}</script>`;

// Example measurements with their sidecar files, under their names in the page.
const examples = {};
for (const [name, folder, file] of [['rtc_france', 'rtc_france', 'curve'], ['shaded_module', 'diagnosis', 'shaded_module'],
                                    ...['pair', 'lit_dark', 'suns'].map((each) => [each, 'cell', each])]) {
  for (const extension of ['csv', 'json']) {
    const path = join(given.SOURCE, 'data', folder, `${file}.${extension}`);
    if (existsSync(path)) examples[`${name}.${extension}`] = readFileSync(path, 'utf8');
  }
}
const licences = given.LICENCES.split(',').filter(Boolean)
    .map((file) => `${'='.repeat(80)}\n${basename(join(file, '..'))}\n${'='.repeat(80)}\n\n${readFileSync(file, 'utf8')}`)
    .join('\n');

const parts = {
  STYLE: report('page.css') + page('app.css'),
  VERSION: given.VERSION,
  DATA: [packed('engine-script', readFileSync(given.SCRIPT)), packedTight('engine-wasm', readFileSync(given.WASM)),
         packedJson('examples', examples), packedJson('licences', licences),
         unread('worker-script', page('worker.js'))].join('\n'),
  SCRIPTS: [report('page.js'), ...['engine', 'verbs', 'form', 'asked', 'file_view', 'read_view',
                                              'report_view', 'result_view', 'app'].map(
      (name) => page(`${name}.js`))].join('\n'),
};
for (const script of [parts.SCRIPTS, page('worker.js')]) {
  if (/<\/script|<!--/i.test(script)) throw new Error('a script would end its element');
}
const filled = (text, of) => text.replace(/@([A-Z]+)@/g, (whole, name) => of[name] ?? whole);
const bytes = Buffer.byteLength(filled(page('index.html'), {...parts, SIZE: '0.0'}));
const html = filled(page('index.html'), {...parts, SIZE: (bytes / 1e6).toFixed(1)});
writeFileSync(`${given.OUT}.part`, html);
renameSync(`${given.OUT}.part`, given.OUT);  // whoever copies it has all of it
const size = (name) => `${(readFileSync(given[name]).length / 1e6).toFixed(2)} MB`;
console.log(`${given.OUT}: ${(bytes / 1e6).toFixed(2)} MB; the engine unpacked ${size('WASM')}, its script ${size('SCRIPT')}`);
