// The page that needs no server, in a browser, from disk:
//   PAGE=lyrefit.html APP=lyrefit CHROMIUM=chromium DATA=data OUT=folder node --test web_test.mjs
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {basename, join} from 'node:path';
import {after, before, test} from 'node:test';

import {barriers, chartsReady, kHangs_ms, kLooks, launch, memoryOf, open} from './browser.mjs';

const {PAGE, APP, CHROMIUM, DATA, OUT} = process.env;
const kMegabyte = 1e6;
const out = (name) => join(OUT, name);
const kFiles = {
  rtc: ['rtc_france.csv', 'rtc_france.json'].map((name, i) => [name, `${DATA}/rtc_france/curve.${['csv', 'json'][i]}`]),
  shaded: ['csv', 'json'].map((end) => [`shaded_module.${end}`, `${DATA}/diagnosis/shaded_module.${end}`]),
  cell: ['pair', 'lit_dark', 'suns'].flatMap((name) => ['csv', 'json'].map((end) => [`${name}.${end}`, `${DATA}/cell/${name}.${end}`]))
            .filter(([, path]) => existsSync(path)),
  tracer: [['tracer.csv', `${DATA}/formats/head_tracer.csv`]],
};
// The command works in other vectors of the processor and with another C library, so that its last digits may differ.
// Numbers agree within this part of themselves, but for those whose size says nothing of their error: how far a
// likelihood ratio lies in a tail, which magnifies what its logarithm misses, what is zero but for rounding, and quotients of
// differences, which have the rounding of what they subtract.
const kSameDigits = 1e-6;
const kTails = {p_value: 1e-4, corrected_p: 1e-4, log_evidence: 1e-3, probability: 1e-2};  // in parts of themselves
const kZeros = {misfit: 1e-5, mean_A: 1e-12, projected_gradient: 1e-8, sensitivity: 1e-9, contribution: 1e-9, share: 1e-9};  // in their own units

let browser;
before(async () => {
  mkdirSync(OUT, {recursive: true});
  browser = await launch(CHROMIUM);
});
after(() => browser?.close());

async function begin(look) {
  const opened = await open(browser, PAGE, look);
  await opened.page.waitForSelector('html[data-engine=ready]', {state: 'attached'});
  return opened;
}

// Drops files as a person would: by what a browser hands over.
async function drop(page, files) {
  const contents = files.map(([name, path]) => [name, readFileSync(path).toString('base64')]);
  const transfer = await page.evaluateHandle((all) => {
    const data = new DataTransfer();
    for (const [name, base64] of all) {
      data.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    }
    return data;
  }, contents);
  await page.dispatchEvent('#drop', 'drop', {dataTransfer: transfer});
  await page.waitForSelector('#read:not([hidden])');
}

const dropText = (page, name, text) => {
  writeFileSync(out(`drop_${name}`), text);
  return drop(page, [[name, out(`drop_${name}`)]]);
};

// What is below may move while files are read and pictures are drawn, so that a click could miss it: a key does not.
const openOptions = (page, of = 'the fit') => page.press(`text=Options of ${of}`, 'Enter');

async function work(page, verb) {
  await page.waitForFunction(() => lyrefitPage.looking() === 0);
  const before = await page.evaluate(() => lyrefitPage.finished());
  await page.press(`[data-verb=${verb}]`, 'Enter');
  await page.waitForFunction((count) => lyrefitPage.finished() > count, before);
}

const report = async (page) => {
  const frame = await (await page.waitForSelector('#report iframe')).contentFrame();
  await chartsReady(frame);
  return frame;
};

async function saved(page, what) {
  const waiting = page.waitForEvent('download');
  await page.click(`[data-save=${what}]`);
  const download = await waiting;
  return {name: download.suggestedFilename(), text: readFileSync(await download.path(), 'utf8')};
}

// The JSON that the command writes of the same files with the same words. `named`: the files among them that it is given.
function commanded(files, verb, flags = [], named = files.slice(0, 1).map(([name]) => name)) {
  const folder = out(`command_${verb}_${basename(files[0]?.[0] ?? 'none', '.csv')}`);
  rmSync(folder, {recursive: true, force: true});
  mkdirSync(folder, {recursive: true});
  for (const [name, path] of files) writeFileSync(join(folder, name), readFileSync(path));
  execFileSync(APP, [verb, ...named, ...flags, '--quiet', '--force', '--json', 'command.out'],
               {cwd: folder, timeout: kHangs_ms});
  return JSON.parse(readFileSync(join(folder, 'command.out'), 'utf8'));
}

// Two records of one measurement: everything that is no number has to be the same, and numbers within what is said
// above. The largest difference of those that have no limit of their own, in parts of the larger.
function compare(one, other, path = '', key = '') {
  const nothing = {part: 0, path};
  if (key === 'seconds') return nothing;
  if (typeof one === 'number' && typeof other === 'number') {
    const apart = Math.abs(one - other);
    const part = apart === 0 ? 0 : apart / Math.max(Math.abs(one), Math.abs(other));
    const what = `${path}: ${one} here, ${other} there`;
    if (key in kZeros && apart <= kZeros[key]) return nothing;
    assert.ok(part <= (kTails[key] ?? kSameDigits), what);
    return key in kTails ? nothing : {part, path};
  }
  if (one === null || other === null || typeof one !== 'object' || typeof other !== 'object') {
    assert.deepEqual(one, other, path);
    return nothing;
  }
  assert.deepEqual(Object.keys(one), Object.keys(other), path);
  return Object.keys(one).map((each) => compare(one[each], other[each], `${path}.${each}`, each))
      .reduce((worst, each) => (each.part > worst.part ? each : worst), nothing);
}

for (const [look, settings] of Object.entries(kLooks)) {
  test(`${look}: no barrier, no overflow, nothing complained of, before and after a result`, async () => {
    const {page, complaints, close} = await begin(settings);
    const check = async (name, whole = true) => {
      await page.screenshot({path: out(`web_${name}_${look}.png`), fullPage: whole});
      assert.deepEqual(await barriers(page), [], name);
      const [width, most] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(width <= most, `${name}: ${width} pixels wide, ${most} to see`);
    };
    await check('empty');
    await page.click('#open-paste');
    await drop(page, kFiles.shaded);
    const picture = await (await page.waitForSelector('#picture iframe')).contentFrame();
    await chartsReady(picture);
    assert.ok(await picture.isVisible('.js-plotly-plot'));
    assert.ok(!await picture.isVisible('footer'));
    assert.deepEqual(await barriers(picture), []);
    await check('read');
    for (const summary of await page.$$('main summary')) await summary.click();
    await check('options');
    for (const summary of await page.$$('main summary')) await summary.click();
    await page.press('[data-verb=diagnose]', 'Enter');
    await page.waitForSelector('#running:not([hidden])');
    await check('running', false);
    await page.waitForSelector('#running', {state: 'hidden'});
    const frame = await report(page);
    await check('result');
    const size = await frame.evaluate(() => [document.documentElement.scrollWidth, innerWidth,
                                            document.documentElement.scrollHeight, innerHeight]);
    assert.ok(size[0] <= size[1] && size[2] <= size[3] + 1, `the report scrolls within the page: ${size}`);
    assert.deepEqual(await barriers(frame), []);
    assert.deepEqual(complaints, []);
    await close();
  });
}

for (const [verb, files] of [['fit', kFiles.rtc], ['diagnose', kFiles.shaded]]) {
  test(`${verb}: a dropped file gives the record of the command`, async (context) => {
    const {page, complaints, close} = await begin();
    await drop(page, files);
    await work(page, verb);
    const record = JSON.parse((await saved(page, 'json')).text);
    const worst = compare(record, commanded(files, verb));
    context.diagnostic(`largest difference to the command: ${worst.part.toExponential(1)} of ${worst.path}`);
    assert.deepEqual(await (await report(page)).evaluate(() => lyrefit.data('record')), record);
    assert.deepEqual(complaints, []);
    await close();
  });
}

test('options and conditions mean what the flags of the command mean', async () => {
  const {page, close} = await begin();
  const [table] = kFiles.rtc;
  await drop(page, [table]);
  await page.fill('#conditions [data-name=cells] input', '1');
  await page.fill('#conditions [data-name=temperature-C] input', '40');
  await page.press('#conditions [data-name=temperature-C] input', 'Tab');
  await openOptions(page);
  await page.selectOption('#options-of-fit [data-name=model] select', 'dd');
  await page.fill('#options-of-fit [data-name=fix] textarea', 'n2=2');
  await page.fill('#options-of-fit [data-name=seed] input', '7');
  await page.press('#options-of-fit [data-name=seed] input', 'Tab');
  await work(page, 'fit');
  const record = JSON.parse((await saved(page, 'json')).text);
  const flags = ['--cells', '1', '--temperature-C', '40', '--model', 'dd', '--fix', 'n2=2', '--seed', '7'];
  assert.equal(record.model, 'dd');
  assert.equal(record.search.seed, 7);
  compare(record, commanded([table], 'fit', flags));
  await close();
});

test('what is typed stays while the file is read anew', async () => {
  const {page, complaints, close} = await begin();
  await drop(page, kFiles.rtc);
  await page.waitForFunction(() => lyrefitPage.looking() === 0);
  const input = (name) => page.inputValue(`#conditions [data-name=${name}] input`);
  // The answer comes after both, since the page does nothing else meanwhile.
  await page.evaluate(() => {
    const field = (name) => document.querySelector(`#conditions [data-name=${name}] input`);
    field('cells').value = '2';
    field('cells').dispatchEvent(new Event('change'));
    field('temperature-C').focus();
    document.execCommand('insertText', false, '4');
  });
  await page.waitForFunction(() => lyrefitPage.looking() === 0);
  assert.equal(await input('temperature-C'), '4');
  await page.keyboard.type('0');
  assert.equal(await input('temperature-C'), '40');
  await page.keyboard.press('Tab');
  await page.waitForFunction(() => lyrefitPage.looking() === 0 &&
      lyrefitPage.files.some(({lookedWith}) => lookedWith === '{"cells":"2","temperature-C":"40"}'));
  assert.deepEqual(complaints, []);
  await close();
});

test('rows pasted from a spreadsheet', async () => {
  const {page, complaints, close} = await begin();
  const rows = readFileSync(`${DATA}/rtc_france/curve.csv`, 'utf8').split('\n').slice(1).join('\n').replaceAll(',', '\t');
  await page.click('#open-paste');
  await page.fill('#pasted', rows);
  await page.click('#take-paste');
  await page.waitForSelector('#picture iframe');
  assert.match(await page.textContent('#files'), /pasted\.txt\s*26 readings/);
  assert.ok(await page.isVisible('#conditions [data-name=cells].unknown'));
  // The same by the keyboard's paste, anywhere.
  await page.evaluate((text) => {
    const data = new DataTransfer();
    data.setData('text/plain', text);
    document.body.dispatchEvent(new ClipboardEvent('paste', {clipboardData: data, bubbles: true}));
  }, rows);
  await page.waitForSelector('#files >> text=pasted_2.txt');
  await page.fill('#conditions [data-name=cells] input', '1');
  await page.fill('#conditions [data-name=temperature-C] input', '33');
  await page.press('#conditions [data-name=temperature-C] input', 'Tab');
  await work(page, 'fit');
  const {rmse} = JSON.parse((await saved(page, 'json')).text);
  assert.ok(Object.values(rmse).flat().length > 0);
  assert.deepEqual(complaints, []);
  await close();
});

test('errors: file, line and what stands there', async () => {
  const {page, complaints, close} = await begin();
  await dropText(page, 'bad.csv', 'V,I\n0,1.5\n0.1,abc\n0.2,1.2\n');
  const shown = await page.textContent('#read-error');
  assert.match(shown, /^bad\.csv:3:5: expected a number/);
  assert.match(shown, /Line 3: 0\.1,abc$/);
  for (const [name, bytes, words] of [
    ['book.xlsx', Buffer.concat([Buffer.from('PK\x03\x04'), Buffer.alloc(900)]), /Excel workbook: save the sheet as CSV/],
    ['photo.jpg', Buffer.concat([Buffer.from([0xff, 0xd8, 0xff, 0xe0, 0]), Buffer.alloc(900, 7)]), /expected text, found a binary file/],
    ['empty.csv', '', /empty/]]) {
    await dropText(page, name, bytes);
    await page.waitForFunction((file) => document.querySelector('#read-title').textContent.includes(file) &&
        !document.querySelector('#read-error').hidden, name);
    assert.match(await page.textContent('#read-error'), words);
  }
  await page.evaluate(() => {
    const data = new DataTransfer();
    const file = new File(['x'], 'huge.csv');
    Object.defineProperty(file, 'size', {value: 70 * 2 ** 20});
    dispatchEvent(Object.assign(new Event('drop', {cancelable: true}), {dataTransfer: {files: [file]}}));
    return data;
  });
  await page.waitForSelector('#trouble:not([hidden])');
  assert.match(await page.textContent('#trouble'), /huge\.csv: the file has 70 MB/);
  // A curve that can be read and not be fitted.
  await dropText(page, 'short.csv', 'V,I\n0,1.5\n0.5,1.2\n');
  await work(page, 'fit');
  assert.match(await page.textContent('#result-error'), /short\.csv: 2 points cannot determine 5 parameters/);
  assert.ok(!await page.isVisible('#downloads'));
  assert.deepEqual(complaints, []);
  await close();
});

// The cell of RTC France as a table of current densities, of 50 cm2.
const densities = () => readFileSync(`${DATA}/rtc_france/curve.csv`, 'utf8').trim().split('\n').map((line, i) => {
  const [voltage, current] = line.split(',');
  return i === 0 ? 'V (V),J (mA/cm2)' : `${voltage},${(20 * Number(current)).toPrecision(12)}`;
}).join('\n');

// What a message says at a field of the page, which it has brought into view and to the keyboard.
async function askedAt(page, place) {
  const field = page.locator(`${place} :is(input, select, textarea)`);
  await page.waitForFunction((selector) => document.activeElement.closest(selector), place);
  assert.ok(await field.isVisible(), `${place} is out of sight`);
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  const described = (await field.getAttribute('aria-describedby')).split(' ').at(-1);
  const words = await page.textContent(`[id="${described}"]`);
  assert.ok(!words.includes('--'), words);
  return words;
}

const said = (page, words) => page.evaluate((text) => document.querySelector('main').innerText.split(text).length - 1, words);

test('a missing area is asked for at its field, once, and by the report too', async () => {
  const {page, complaints, close} = await begin(kLooks.phone);
  await dropText(page, 'density.csv', densities());
  const words = await askedAt(page, '#reading [data-name=area-cm2]');
  assert.match(words, /^density\.csv: the table holds current densities: give the area of the cell with Area \(cm²\), or/);
  assert.equal(await said(page, 'the table holds current densities'), 1);
  await work(page, 'fit');
  await askedAt(page, '#reading [data-name=area-cm2]');
  assert.equal(await said(page, 'the table holds current densities'), 1);
  assert.ok(!await page.isVisible('#result'));
  await page.keyboard.type('50');
  await page.keyboard.press('Tab');
  await page.waitForSelector('#picture iframe');
  assert.equal(await page.locator('[aria-invalid], .asked').count(), 0);
  assert.equal(await said(page, 'the table holds current densities'), 0);
  await work(page, 'fit');
  await report(page);
  // A report on a cell without an area leads to the field as well; what is saved is as the command writes it.
  await dropText(page, 'bare.csv', readFileSync(`${DATA}/rtc_france/curve.csv`, 'utf8'));
  await page.click('[aria-label="Remove density.csv"]');
  await work(page, 'cell');
  const frame = await report(page);
  await frame.click('button.link:has-text("Area (cm²)") >> nth=0');
  await page.waitForFunction(() => document.activeElement.closest('#reading [data-name=area-cm2]'));
  assert.ok(!(await frame.evaluate(() => document.body.innerText)).includes('--area'));
  assert.match((await saved(page, 'page')).text, /give --area-cm2/);
  assert.deepEqual(complaints, []);
  await close();
});

test('datasheet without a file: what is missing is asked for, and the record is that of the command', async () => {
  const {page, complaints, close} = await begin();
  const sheet = {isc: '9.05', voc: '37.8', imp: '8.58', vmp: '30.3', alpha: '0.06%', beta: '-0.31%', gamma: '-0.41', cells: '60'};
  const field = (name) => `#sheet [data-name=${name}]`;
  await page.press('#open-sheet', 'Enter');
  await page.waitForFunction(() => document.activeElement.closest('#sheet [data-name=isc]'));
  await page.keyboard.type(sheet.isc);
  await work(page, 'datasheet');
  assert.match(await askedAt(page, field('voc')), /^Voc is required/);
  assert.ok(!await page.isVisible('#result'));
  for (const [name, text] of Object.entries(sheet)) await page.fill(`${field(name)} input`, text);
  await page.fill(`${field('imp')} input`, '8,58 A');
  await work(page, 'datasheet');
  assert.match(await askedAt(page, field('imp')), /^Imp: expected/);
  await page.fill(`${field('imp')} input`, sheet.imp);
  await work(page, 'datasheet');
  await report(page);
  const record = JSON.parse((await saved(page, 'json')).text);
  const flags = Object.entries(sheet).flatMap(([name, text]) => [`--${name}`, text]);
  compare(record, commanded([], 'datasheet', flags));
  const pvlib = await saved(page, 'pvlib');
  assert.equal(pvlib.name, 'module_datasheet.pvlib.json');
  assert.equal(JSON.parse(pvlib.text).function, 'calcparams_desoto');
  assert.ok(!await page.isVisible('#work'));
  assert.deepEqual(complaints, []);
  await close();
});

test('cell: three files are one', async () => {
  const {page, complaints, close} = await begin();
  await drop(page, kFiles.cell);
  await page.waitForFunction(() => lyrefitPage.looking() === 0);
  assert.match(await page.textContent('#files'), /suns\.csv\s*29 readings/);  // with the current of the others
  await work(page, 'cell');
  await report(page);
  const record = JSON.parse((await saved(page, 'json')).text);
  compare(record, commanded(kFiles.cell, 'cell', [], ['pair.csv', 'lit_dark.csv', 'suns.csv']));
  assert.equal(await page.textContent('#result-title'), 'Cell of pair + lit_dark + suns');
  // What is said of two files must agree.
  const choose = (name) => page.press(`#files .name:has-text("${name}")`, 'Enter');
  const say = async (name, value) => {
    await choose(name);
    await page.fill('#conditions [data-name=cells] input', value);
    await page.press('#conditions [data-name=cells] input', 'Tab');
  };
  await say('pair.csv', '1');
  await say('suns.csv', '2');
  await work(page, 'cell');
  assert.match(await askedAt(page, '#conditions [data-name=cells]'), /^Cells in series: 1 and 2 are said of two files of one cell/);
  assert.deepEqual(complaints, []);
  await close();
});

test('translate: with the sheet of the module that was dropped beside the curve', async () => {
  const {page, complaints, close} = await begin();
  writeFileSync(out('sheet.json'), JSON.stringify({rated_power_W: 280, gamma_pmp_percent_K: -0.4, alpha_sc_percent_K: 0.05, beta_oc_percent_K: -0.3}));
  const files = [['sheet.json', out('sheet.json')], ...kFiles.tracer];
  await drop(page, files);
  await page.waitForFunction(() => lyrefitPage.looking() === 0);
  assert.match(await page.textContent('#files'), /sheet\.json\s*sheet of a module/);
  assert.match(await page.textContent('#read-title'), /tracer\.csv$/);
  await openOptions(page, 'the translation');
  assert.equal(await page.inputValue('#options-of-translate [data-name=module] select'), 'sheet.json');
  await page.fill('#options-of-translate [data-name=modules] input', '1');
  await page.fill('#options-of-translate [data-name=wind] input', '2');
  await page.selectOption('#options-of-translate [data-name=irradiance-from] select', 'reference-cell');
  await work(page, 'translate');
  await report(page);
  const record = JSON.parse((await saved(page, 'json')).text);
  const flags = ['--module', 'sheet.json', '--modules', '1', '--wind', '2', '--irradiance-from', 'reference-cell'];
  compare(record, commanded(files, 'translate', flags, ['tracer.csv']));
  assert.equal(record.field_test.rated_W, 280);
  await page.click('[aria-label="Remove sheet.json"]');
  await work(page, 'translate');
  assert.equal(JSON.parse((await saved(page, 'json')).text).field_test?.rated_W ?? null, null);
  await drop(page, files.slice(0, 1));
  await page.waitForFunction(() => lyrefitPage.looking() === 0);
  assert.match(await page.textContent('#read-title'), /tracer\.csv$/);
  assert.ok(await page.isVisible('#work'));
  assert.equal(await page.inputValue('#options-of-translate [data-name=module] select'), 'sheet.json');
  assert.deepEqual(complaints, []);
  await close();
});

// Drops files, or fills the data sheet, and runs a verb.
const kRuns = {fit: kFiles.rtc, diagnose: kFiles.shaded, translate: kFiles.tracer, cell: kFiles.cell, datasheet: null};
async function run(page, verb) {
  if (kRuns[verb]) await drop(page, kRuns[verb]);
  else await page.press('#open-sheet', 'Enter');
  if (!kRuns[verb]) {
    for (const [name, text] of Object.entries({isc: '9.05', voc: '37.8', imp: '8.58', vmp: '30.3', alpha: '0.06%', beta: '-0.31%', cells: '60'})) {
      await page.fill(`#sheet [data-name=${name}] input`, text);
    }
  }
  await work(page, verb);
  return report(page);
}

// Elements that reach beyond the right edge and do not lie in a box that scrolls.
const cut = (frame) => frame.evaluate(() => {
  const scrolls = (element) => element && (['auto', 'scroll'].includes(getComputedStyle(element).overflowX) || scrolls(element.parentElement));
  return [...document.querySelectorAll('main :is(table, figure, svg, pre, p, h1, h2, h3, dl, button, input, select, .js-plotly-plot)')]
      .filter((each) => each.getClientRects().length > 0 && each.getBoundingClientRect().right > innerWidth + 1 && !scrolls(each.parentElement) && !each.closest('.skip'))
      .map((each) => `${each.tagName} ${each.className.baseVal ?? each.className} ${each.textContent.slice(0, 40)}: ${each.getBoundingClientRect().right}`);
});

for (const look of ['light', 'phone']) {
  test(`${look}: no table and no chart of the five verbs is cut, also on paper`, async () => {
    for (const verb of Object.keys(kRuns)) {
      const {page, complaints, close} = await begin(kLooks[look]);
      const frame = await run(page, verb);
      await page.screenshot({path: out(`web_${verb}_${look}.png`), fullPage: true});
      for (const part of [page, frame]) {
        assert.ok(await part.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${verb}: wider than ${look}`);
        assert.deepEqual(await cut(part), [], verb);
      }
      if (look === 'light') {
        assert.deepEqual(await barriers(frame), [], verb);
        writeFileSync(out(`web_${verb}.pdf`), await page.pdf({preferCSSPageSize: true}));
        writeFileSync(out(`web_${verb}.html`), (await saved(page, 'page')).text);
      }
      assert.deepEqual(complaints, [], verb);
      await close();
    }
  });
}

test('cancel at once, the last result stays, and the next one is that of an undisturbed page', async () => {
  const {page, complaints, close} = await begin();
  await drop(page, kFiles.shaded);
  await work(page, 'diagnose');
  await report(page);
  await openOptions(page);
  await page.fill('#options-of-fit [data-name=iterations] input', '1000000');
  await page.press('#options-of-fit [data-name=iterations] input', 'Tab');
  await page.press('[data-verb=fit]', 'Enter');
  await page.waitForFunction(() => /begins/.test(document.querySelector('#stage').textContent) === false);
  await page.click('#cancel');
  await page.waitForSelector('#running', {state: 'hidden'});
  assert.match(await page.textContent('#result-title'), /^Diagnosis of shaded_module/);
  await page.fill('#options-of-fit [data-name=iterations] input', '');
  await page.press('#options-of-fit [data-name=iterations] input', 'Tab');
  await work(page, 'fit');
  const record = JSON.parse((await saved(page, 'json')).text);
  compare(record, commanded(kFiles.shaded, 'fit'));
  assert.equal(await page.$$eval('#which button', (all) => all.length), 2);
  assert.deepEqual(complaints, []);
  await close();
});

test('several files: a list, each with its result; the examples', async () => {
  const {page, complaints, close} = await begin();
  await page.click('[data-example^=rtc]');
  await page.waitForSelector('#files >> text=26 readings');
  await page.click('[data-example^=shaded]');
  await page.waitForSelector('#files >> text=137 readings');
  await page.check('#every');
  await page.press('[data-verb=fit]', 'Enter');
  await page.waitForFunction(() => [...document.querySelectorAll('#files .state')].filter(
      (each) => /^Fit: done/.test(each.textContent)).length === 2);
  await page.click('#files .name:has-text("rtc_france.csv")');
  assert.equal(await page.textContent('#result-title'), 'Fit of rtc_france');
  await page.click('[aria-label="Remove rtc_france.csv"]');
  assert.ok(!(await page.textContent('#files')).includes('rtc_france.csv'));
  assert.deepEqual(complaints, []);
  await close();
});

test('a saved report opens by itself', async () => {
  const {page, close} = await begin();
  await drop(page, kFiles.rtc);
  await work(page, 'fit');
  const {name, text} = await saved(page, 'page');
  assert.equal(name, 'rtc_france_fit.html');
  assert.match((await saved(page, 'csv')).text, /Iph_A/);
  assert.match((await saved(page, 'text')).text, /Parameters/);
  await close();
  writeFileSync(out(name), text);
  const alone = await open(browser, out(name), kLooks.dark);
  await chartsReady(alone.page);
  assert.ok(await alone.page.isVisible('.js-plotly-plot'));
  assert.deepEqual(await barriers(alone.page), []);
  await alone.page.emulateMedia({media: 'print'});
  assert.ok(await alone.page.isVisible('.js-plotly-plot'));
  writeFileSync(out('web_saved.pdf'), await alone.page.pdf({preferCSSPageSize: true}));
  assert.deepEqual(alone.complaints, []);
  await alone.close();
});

test('whatever a page tries, nothing leaves', async () => {
  const {page, complaints, close} = await begin();
  await drop(page, kFiles.rtc);
  await work(page, 'fit');
  await report(page);
  assert.deepEqual(complaints, []);
  const ends = [];
  page.on('requestfailed', (request) => ends.push(request.failure().errorText));
  page.on('response', (response) => ends.push(`answered: ${response.url()}`));
  const tried = await page.evaluate(async () => {
    const blocked = [];
    addEventListener('securitypolicyviolation', (event) => blocked.push(event.effectiveDirective));
    await fetch('https://x.invalid/').catch(() => {});
    navigator.sendBeacon?.('https://x.invalid/', 'v');
    new Image().src = 'https://x.invalid/i.png';
    try { new WebSocket('wss://x.invalid/'); } catch { blocked.push('connect-src'); }
    while (!['connect-src', 'img-src'].every((each) => blocked.includes(each))) {
      await new Promise((done) => setTimeout(done, 20));
    }
    return blocked;
  });
  assert.ok(tried.includes('connect-src') && tried.includes('img-src'), tried.join());
  for (const end of ends) assert.equal(end, 'csp');
  await close();
});

test('keyboard alone', async () => {
  const {page, complaints, close} = await begin();
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.className), 'skip');
  await page.focus('[data-example^=rtc]');
  await page.keyboard.press('Enter');
  await page.waitForSelector('#picture iframe');
  await page.focus('[data-verb=fit]');
  await page.keyboard.press('Enter');
  await page.waitForSelector('#report iframe');
  await page.waitForFunction(() => document.activeElement.id === 'result-title');
  await page.focus('[data-page=theme]');
  await page.keyboard.press('Enter');
  const frame = await report(page);
  await frame.waitForFunction(() => document.documentElement.dataset.theme === 'dark');
  assert.deepEqual(complaints, []);
  await close();
});

test('size, time to the first result, memory', async (context) => {
  const size = statSync(PAGE).size;
  assert.ok(size < 3 * kMegabyte, `${size} bytes`);
  for (const [verb, files] of [['fit', kFiles.rtc], ['diagnose', kFiles.shaded]]) {
    const {page, close} = await begin();
    const ready = await page.evaluate(() => performance.now());
    await drop(page, files);
    await page.waitForSelector('#picture iframe');
    const seconds = [];
    for (let i = 0; i < 3; ++i) {
      await work(page, verb);
      seconds.push(await page.evaluate(() => {
        const [file] = lyrefitPage.files.filter((each) => each.latest);
        return file.results[file.latest].seconds;
      }));
    }
    await report(page);
    const heap = await page.evaluate(() => lyrefitPage.engines()[1].memory);
    context.diagnostic(`${verb}: ready after ${ready.toFixed(0)} ms, answers after ` +
                       `${seconds.map((each) => (1000 * each).toFixed(0)).join(', ')} ms, engine's memory ` +
                       `${(heap / kMegabyte).toFixed(0)} MB, the tab ${(await memoryOf(browser) / kMegabyte).toFixed(0)} MB`);
    await close();
  }
  context.diagnostic(`${(size / kMegabyte).toFixed(2)} MB`);
});
