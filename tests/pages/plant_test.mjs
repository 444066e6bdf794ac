// The page of a plant in a browser, of made rows (tests/batch/synthetic_plant.h):
//   SYNTHETIC_PLANT_PAGE=synthetic_plant_page CHROMIUM=chromium OUT=folder node --test plant_test.mjs
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {barriers, kLooks, launch, open} from './browser.mjs';

const {SYNTHETIC_PLANT_PAGE, CHROMIUM, OUT} = process.env;
const kMegabyte = 1e6;
const kSizes = [0, 1, 5, 500, 10000, 100000];
const file = (rows, end = 'html') => join(OUT, `plant_${rows}.${end}`);
const rowsOf = (rows) => readFileSync(file(rows, 'jsonl'), 'utf8').split('\n').filter(Boolean).map((line) => JSON.parse(line));

let browser;
before(async () => {
  mkdirSync(OUT, {recursive: true});
  for (const rows of kSizes) execFileSync(SYNTHETIC_PLANT_PAGE, [rows, file(rows), 0, file(rows, 'jsonl')]);
  browser = await launch(CHROMIUM);
});
after(() => browser?.close());

// With everything drawn.
async function openPlant(rows, look) {
  const opened = await open(browser, file(rows), look);
  await opened.page.waitForSelector('html[data-ready]', {state: 'attached'});
  return opened;
}

const tableIds = (page) => page.$$eval('#table-body th', (all) => all.map((cell) => cell.textContent));
const column = (page, name) => page.$$eval('#table-head th', (all, wanted) =>
    all.findIndex((cell) => cell.querySelector('button').dataset.sort === wanted), name);
const cellsOf = async (page, name) => page.$$eval('#table-body tr', (all, at) =>
    all.map((row) => row.cells[at].textContent), await column(page, name));
const waitForState = (page, text) => page.waitForFunction(
    (words) => document.getElementById('live-state').textContent.startsWith(words), text);

for (const rows of [0, 1, 5, 500]) {
  for (const [look, settings] of Object.entries(kLooks)) {
    if (rows < 500 && look !== 'phone') continue;  // few rows have the colours of many
    test(`${rows} strings, ${look}: nothing fetched, nothing complained of, no barrier, no overflow`, async () => {
      const {page, complaints, close} = await openPlant(rows, settings);
      await page.screenshot({path: join(OUT, `plant_${rows}_${look}.png`), fullPage: true});
      for (const summary of await page.$$('summary')) await summary.click();
      assert.deepEqual(await barriers(page, look), []);
      const [width, most] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(width <= most, `${width} pixels wide, ${most} to see`);
      if (rows > 0) {
        await page.click('#table-body th button');
        await page.waitForSelector('#detail[open]');
        assert.deepEqual(await barriers(page, look), []);
      }
      assert.deepEqual(complaints, []);
      await close();
    });
  }
}

test('every column is unpacked to the rows that were written', async () => {
  const rows = rowsOf(10000);
  const {page, close} = await openPlant(10000);
  for (const name of Object.keys(rows[0])) {
    const values = await page.evaluate(async (wanted) => Array.from(await load(wanted),
        (value) => (Number.isNaN(value) ? null : value)), name);
    const given = rows.map((row) => (typeof row[name] === 'boolean' ? Number(row[name]) : row[name]));
    assert.deepEqual(values, given, name);
  }
  await close();
});

test('the table shows the rows, to five digits, and the panel all of them', async () => {
  const rows = rowsOf(500);
  const {page, close} = await openPlant(500);
  assert.deepEqual(await tableIds(page), rows.slice(0, 25).map((row) => row.id));
  for (const name of ['performance_factor', 'Pmax_stc_W', 'group_deviation_percent']) {
    (await cellsOf(page, name)).forEach((text, i) => {
      const value = rows[i][name];
      if (value === null) return assert.equal(text, '');
      assert.ok(Math.abs(Number(text) - value) <= 0.6e-4 * Math.max(1, Math.abs(value)), `${name}: ${text} for ${value}`);
    });
  }
  await page.click('#table-body tr:nth-child(3) th button');
  await page.waitForSelector('#detail[open]');
  const panel = await page.$$eval('#detail tbody tr', (all) => all.map((row) => [row.cells[0].textContent, row.cells[1].textContent]));
  for (const [name, text] of panel) {
    const value = rows[2][name];
    const said = value === null ? 'not known' : typeof value === 'boolean' ? (value ? 'yes' : 'no') : String(value);
    assert.equal(text, said, name);
  }
  assert.equal(panel.length, Object.keys(rows[0]).length - 1);  // all but the sparkline
  await page.keyboard.press('Escape');
  const ill = rows.find((row) => row.cause_sentence && row.performance_factor < 0.95);
  await page.click(`.card:has-text("${ill.id}")`);
  await page.waitForSelector('#detail[open]');
  assert.deepEqual(await page.$$eval('#detail > p', (all) => all.map((each) => each.textContent)),
                   [ill.cause_sentence, 'The page of this string']);
  await close();
});

test('verdict, zones and causes count the rows', async () => {
  const rows = rowsOf(500).filter((row) => row.status === 'fine');
  const {page, close} = await openPlant(500);
  const passed = rows.filter((row) => row.zone.startsWith('pass')).length;
  const inNeed = rows.length - passed;
  assert.ok((await page.textContent('.verdict')).startsWith(`${passed} of 500 strings pass; ${inNeed} need work: `));
  const counts = await page.$$eval('tr[data-column]', (all) => all.map((row) => [row.dataset.column, row.dataset.value, Number(row.cells[1].textContent)]));
  for (const [name, value, count] of counts.filter(([each]) => each === 'zone')) {
    assert.equal(count, rows.filter((row) => row[name] === value).length, value);
  }
  const causes = counts.filter(([each]) => each === 'cause').reduce((sum, [, , count]) => sum + count, 0);
  assert.equal(causes, rows.filter((row) => row.cause !== 'none').length);
  await close();
});

test('sorting by keyboard: unknown last either way, said to screen readers, the focus stays', async () => {
  const rows = rowsOf(500);
  const known = rows.filter((row) => row.performance_factor !== null)
      .sort((a, b) => a.performance_factor - b.performance_factor);
  const {page, complaints, close} = await openPlant(500);
  await page.focus('[data-sort=performance_factor]');
  for (const [direction, first] of [['ascending', known[0]], ['descending', known.at(-1)]]) {
    await page.keyboard.press('Enter');
    await page.waitForSelector(`th[aria-sort=${direction}]`);
    assert.equal((await tableIds(page))[0], first.id);
    assert.equal(await page.evaluate(() => document.activeElement.dataset.sort), 'performance_factor');
    await page.selectOption('.pager select', '100');
    while (await page.isEnabled('#page-on')) await page.click('#page-on');
    const last = await cellsOf(page, 'performance_factor');
    assert.equal(last.at(-1), '');
    await page.focus('[data-sort=performance_factor]');
  }
  assert.deepEqual(complaints, []);
  await close();
});

test('filters by keyboard: text, word, number, their removal', async () => {
  const rows = rowsOf(500);
  const {page, complaints, close} = await openPlant(500);
  await page.focus('#search');
  await page.keyboard.type('INV02/comb3');
  const inside = rows.filter((row) => row.id.includes('inv02/comb3'));
  await waitForState(page, `${inside.length} of 500`);
  assert.deepEqual(await tableIds(page), inside.slice(0, 25).map((row) => row.id));
  await page.focus('#chips button');
  await page.keyboard.press('Enter');
  await waitForState(page, 'All 500');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'search');

  await page.focus('tr[data-value=fail] button');
  await page.keyboard.press('Enter');
  const failed = rows.filter((row) => row.zone === 'fail');
  await waitForState(page, `${failed.length} of 500`);
  assert.deepEqual(await cellsOf(page, 'zone').then((all) => all.map((text) => text.slice(1))), failed.map(() => 'fail'));

  await page.focus('.toolbox summary');
  await page.keyboard.press('Enter');
  await page.selectOption('.toolbox form select', 'performance_factor');
  await page.fill('#range-high', '0.9');
  await page.keyboard.press('Enter');
  const worst = failed.filter((row) => row.performance_factor <= 0.9);
  await waitForState(page, `${worst.length} of 500`);
  assert.deepEqual(await tableIds(page), worst.map((row) => row.id));
  assert.deepEqual(complaints, []);
  await close();
});

test('the panel opens and closes by keyboard and gives the focus back', async () => {
  const {page, close} = await openPlant(500);
  await page.focus('#table-body th button');
  await page.keyboard.press('Enter');
  await page.waitForSelector('#detail[open]');
  assert.equal(await page.textContent('#detail-h'), 'site1/inv01/comb1/str01');
  await page.keyboard.press('Escape');
  await page.waitForSelector('#detail:not([open])', {state: 'attached'});
  assert.equal(await page.evaluate(() => document.activeElement.textContent), 'site1/inv01/comb1/str01');
  await close();
});

test('links go to the pages of strings that have one', async () => {
  const row = rowsOf(500).find((each) => each.page);
  const {page, close} = await openPlant(500);
  await page.fill('#search', row.id);
  await waitForState(page, '1 of 500');
  await page.click('#table-body th button');
  await page.waitForSelector('#detail[open]');
  assert.equal(await page.getAttribute('#detail a', 'href'), `./pages/${row.id}.html`);
  await close();
});

test('the tree: down by keyboard, back, and its strings alone', async () => {
  const rows = rowsOf(10000);
  const {page, complaints, close} = await openPlant(10000);
  const below = () => page.evaluate(() => document.querySelector('#live-map .crumbs strong').textContent);
  assert.equal(await below(), 'The plant (10,000)');
  for (const part of ['site2', 'inv01']) {
    await page.focus('#live-map summary');
    await page.keyboard.press('Enter');
    await page.focus(`#live-map td button, #live-map th button:text-is("${part}")`);
    await page.keyboard.press('Enter');
    await page.waitForFunction((name) => document.activeElement.textContent.startsWith(name), part);
  }
  const inside = rows.filter((row) => row.id.startsWith('site2/inv01/'));
  assert.equal(await below(), `inv01 (${inside.length})`);
  await page.click('text=Show only these strings');
  await waitForState(page, `${inside.length} of 10,000`);
  assert.equal((await tableIds(page))[0], inside[0].id);
  assert.deepEqual(complaints, []);
  await close();
});

test('a part of the plant says its lowest, mean and highest', async () => {
  const rows = rowsOf(10000).filter((row) => row.id.startsWith('site2/') && row.performance_factor !== null)
      .map((row) => row.performance_factor);
  const {page, close} = await openPlant(10000);
  const cells = await page.$$eval('#live-map details tbody tr', (all) => [...all.find((row) => row.cells[0].textContent === 'site2').cells].map((cell) => cell.textContent));
  const mean = rows.reduce((sum, value) => sum + value, 0) / rows.length;
  [Math.min(...rows), mean, Math.max(...rows)].forEach((value, i) => assert.ok(Math.abs(Number(cells[2 + i]) - value) < 1e-4));
  await close();
});

test('the worst are the worst', async () => {
  const rows = rowsOf(500).filter((row) => row.performance_factor !== null).sort((a, b) => a.performance_factor - b.performance_factor);
  const {page, close} = await openPlant(500);
  const shown = await page.$$eval('.card .name', (all) => all.map((each) => each.textContent));
  assert.deepEqual(shown, rows.slice(0, 24).map((row) => row.id));
  await close();
});

test('rows are saved as they are shown', async () => {
  const rows = rowsOf(500).filter((row) => row.zone === 'fail');
  const {page, close} = await openPlant(500);
  await page.click('tr[data-value=fail] button');
  await waitForState(page, `${rows.length} of 500`);
  const waiting = page.waitForEvent('download');
  await page.click('text=Save these rows');
  const lines = readFileSync(await (await waiting).path(), 'utf8').trim().split('\n');
  const at = lines[0].split(',').indexOf('id');
  assert.deepEqual(lines.slice(1).map((line) => line.split(',')[at]), rows.map((row) => row.id));
  await close();
});

test('reads without scripts and on paper', async () => {
  const still = await open(browser, file(500), {...kLooks.light, javaScriptEnabled: false});
  for (const words of ['Strings by zone', 'The 25 worst strings', 'Why there is no result']) {
    assert.ok(await still.page.isVisible(`text=${words}`), words);
  }
  assert.equal(await still.page.$$eval('svg', (all) => all.length), 2);
  assert.ok(!await still.page.isVisible('#strings'));
  assert.deepEqual(still.complaints, []);
  await still.page.screenshot({path: join(OUT, 'plant_still.png'), fullPage: true});
  await still.close();

  const {page, close} = await openPlant(500, kLooks.dark);
  await page.emulateMedia({media: 'print'});
  assert.ok(await page.isVisible('#still-map svg'));
  assert.ok(await page.isVisible('#still-worst table'));
  assert.ok(!await page.isVisible('button[data-page]'));
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
  writeFileSync(join(OUT, 'plant_500.pdf'), await page.pdf({preferCSSPageSize: true}));
  await close();
});

for (const [rows, mostMegabytes] of [[500, 1], [10000, 6], [100000, 40]]) {
  test(`size, first paint and memory at ${rows} strings`, async (context) => {
    const size = statSync(file(rows)).size;
    const {page, complaints, close} = await openPlant(rows);
    const ready = await page.evaluate(() => performance.now());
    const paint = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0].startTime);
    const session = await page.context().newCDPSession(page);
    await session.send('Performance.enable');
    const {metrics} = await session.send('Performance.getMetrics');
    const heap = metrics.find(({name}) => name === 'JSHeapUsedSize').value;
    const start = Date.now();
    await page.focus('[data-sort=Pmax_stc_W]');
    await page.keyboard.press('Enter');
    await page.waitForSelector('th[aria-sort=ascending]');
    const sorted = Date.now() - start;
    context.diagnostic(`${(size / kMegabyte).toFixed(2)} MB, first paint ${paint.toFixed(0)} ms, all drawn within ` +
                       `${ready.toFixed(0)} ms, sorted in ${sorted} ms, heap ${(heap / kMegabyte).toFixed(0)} MB`);
    assert.ok(size < mostMegabytes * kMegabyte);
    assert.ok(heap < 400 * kMegabyte);
    assert.deepEqual(complaints, []);
    await close();
  });
}
