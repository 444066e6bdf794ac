// The verbs of the page that needs no server, and the fields that it asks for:
//   PAGE=lyrefit.html APP=lyrefit CHROMIUM=chromium DATA=data OUT=folder node --test web_verbs_test.mjs
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {test} from 'node:test';

import {barriers, kLooks} from './browser.mjs';
import {DATA, begin, commanded, compare, drop, dropText, kFiles, openOptions, out, report, saved, work} from './web_page.mjs';

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
