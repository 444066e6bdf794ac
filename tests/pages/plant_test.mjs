// The page of a plant in a browser, of made rows (tests/plant/synthetic_rows.h):
//   SYNTHETIC_PLANT_PAGE=synthetic_plant_page CHROMIUM=chromium OUT=folder node --test plant_test.mjs
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {barriers, cells, chartsReady, kLooks, launch, open} from './browser.mjs';

const {SYNTHETIC_PLANT_PAGE, CHROMIUM, OUT} = process.env;
const kMegabyte = 1e6;
const kPlants = [0, 1, 5, 500, 10000, 100000, 'hostile'];
const page = (plant) => join(OUT, `plant_${plant}.html`);
const results = (plant, name) => readFileSync(join(OUT, `plant_${plant}`, name), 'utf8');
const rowsOf = (plant) => results(plant, 'results.jsonl').split('\n').filter(Boolean).map((line) => JSON.parse(line));
// Those to visit first: of the strings that do not pass the 100 of the least performance.
// A string that fails needs work, and one that is undecided and has a cause of its own.
const kOfTheMeasurement = ['sweep', 'instrument', 'conditions'];
const needsWork = (row) => row.zone.startsWith('fail') ||
    (row.zone === 'undecided' && row.cause !== 'none' && !kOfTheMeasurement.includes(row.cause_about));
// What needs work goes first, then what passes and shows a cause; of each what loses most, then what performs worst.
const needsInspection = (row) => row.zone.startsWith('pass') && row.cause !== 'none' && !kOfTheMeasurement.includes(row.cause_about);
const worstOf = (plant) => rowsOf(plant).filter((row) => row.status === 'fine' && (needsWork(row) || needsInspection(row)))
                               .sort((a, b) => needsWork(b) - needsWork(a) || (b.recoverable_power_W ?? 0) - (a.recoverable_power_W ?? 0) ||
                                               a.performance_factor - b.performance_factor).slice(0, 100);

let browser;
before(async () => {
  mkdirSync(OUT, {recursive: true});
  for (const plant of kPlants) execFileSync(SYNTHETIC_PLANT_PAGE, [plant, join(OUT, `plant_${plant}`), page(plant)]);
  browser = await launch(CHROMIUM);
});
after(() => browser?.close());

// With every picture drawn, and the table of rows, which is filled when its place comes near.
async function openPlant(plant, look) {
  const opened = await open(browser, page(plant), look);
  await opened.page.waitForFunction(() => document.readyState === 'complete');
  if (await opened.page.$('figure')) await chartsReady(opened.page);
  if (await opened.page.$('#rows-table')) {
    await opened.page.evaluate(() => document.getElementById('rows-table').scrollIntoView());
    await opened.page.waitForSelector('html[data-rows]', {state: 'attached'});
  }
  return opened;
}

// What the table shows of a column.
const column = (page, name) => page.evaluate((wanted) => {
  const heads = [...document.querySelectorAll('.tabulator-col')].filter((each) => each.offsetParent);
  const field = heads.find((each) => each.querySelector('[data-sort]').dataset.sort === wanted).getAttribute('tabulator-field');
  return [...document.querySelectorAll(`.tabulator-row [tabulator-field="${field}"]`)].map((cell) => cell.textContent.trim());
}, name);
const waitForState = (page, words) => page.waitForFunction(
    (text) => document.querySelector('.rows-tools [role=status]').textContent === text, words);
async function filter(page, name, text) {
  await page.focus(`[aria-label="Filter ${name}"]`);
  await page.keyboard.press('Control+A');
  await page.keyboard.press('Delete');
  await page.keyboard.insertText(text.slice(0, -1));  // typed, an exclamation mark would have the code of another key
  await page.keyboard.type(text.slice(-1));
}
const button = (page, name) => page.locator('#rows-table').getByRole('button', {name, exact: true});

for (const plant of kPlants.filter((each) => each !== 100000 && each !== 10000)) {
  for (const [look, settings] of Object.entries(kLooks)) {
    if (plant !== 500 && look !== 'phone') continue;  // few rows have the colours of many
    test(`${plant} strings, ${look}: nothing fetched, nothing complained of, no barrier, no overflow`, async () => {
      const {page: tab, complaints, close} = await openPlant(plant, settings);
      for (const summary of await tab.$$('summary')) await summary.click();
      assert.deepEqual(await barriers(tab, look), []);
      const [width, most] = await tab.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(width <= most, `${width} pixels wide, ${most} to see`);
      if (plant !== 0) {
        await tab.click('.tabulator-row button.link');
        await tab.waitForSelector('dialog[open]');
        assert.deepEqual(await barriers(tab, look), []);
      }
      assert.deepEqual(complaints, []);
      await close();
    });
  }
}

test('the file of the results is in the page, byte for byte', async () => {
  const {page: tab, close} = await openPlant(500);
  assert.equal(await tab.evaluate(() => lyrefit.text('rows')), results(500, 'results.csv'));
  const waiting = tab.waitForEvent('download');
  await tab.click('[data-page=save]');
  assert.equal(readFileSync(await (await waiting).path(), 'utf8'), results(500, 'results.csv'));
  await close();
});

test('the table shows the rows, to five digits, and a dialog all cells of one', async () => {
  const rows = rowsOf(500);
  const {page: tab, close} = await openPlant(500);
  assert.deepEqual(await column(tab, 'id'), rows.slice(0, 25).map((row) => row.id));
  for (const name of ['performance_factor', 'Pmax_stc_W', 'group_deviation_percent']) {
    (await column(tab, name)).forEach((text, i) => {
      const value = rows[i][name];
      if (value === null) return assert.equal(text, '');
      assert.ok(Math.abs(Number(text) - value) <= 0.6e-4 * Math.max(1, Math.abs(value)), `${name}: ${text} for ${value}`);
    });
  }
  await tab.click('.tabulator-row:nth-child(3) button.link');
  await tab.waitForSelector('dialog[open]');
  const shown = await tab.$$eval('dialog tr', (all) => all.map((row) => [row.cells[0].textContent, row.cells[1].textContent]));
  const known = Object.entries(rows[2]).filter(([, value]) => value !== null && value !== '').map(([name, value]) => [name, String(value)]);
  assert.deepEqual(new Map(shown), new Map(known));
  await close();
});

test('verdict, zones and causes count the rows, and the worst are those that need work and lose most', async () => {
  const rows = rowsOf(500).filter((row) => row.status === 'fine');
  const {page: tab, close} = await openPlant(500);
  const passed = rows.filter((row) => row.zone.startsWith('pass')).length;
  const undecided = rows.filter((row) => row.zone === 'undecided').length;
  const verdict = await tab.textContent('.verdict p');
  const between = undecided > 0 ? ` ${undecided} ${undecided > 1 ? 'are' : 'is'} undecided.` : '';
  const needed = rows.filter(needsWork).length;
  assert.ok(verdict.startsWith(`${passed} of 500 strings pass.${between} ${needed} need work: `), verdict);
  const counts = (await cells(tab, 'What was found')).map(([name, count]) => [name, Number(count)]);
  const isZone = ([name]) => /^(pass|fail|undecided)/.test(name);
  const zones = counts.filter(isZone);
  assert.equal(zones.reduce((sum, [, count]) => sum + count, 0), rows.length);
  for (const [zone, count] of zones) assert.equal(count, rows.filter((row) => row.zone === zone).length, zone);
  assert.equal(counts.filter((count) => !isZone(count)).reduce((sum, [, count]) => sum + count, 0), rows.filter((row) => row.cause !== 'none').length);
  const worst = worstOf(500);
  assert.deepEqual((await cells(tab, 'Which strings')).map(([id]) => id), worst.map((row) => row.id));
  const links = await tab.$$eval('section th a', (all) => all.map((link) => [link.textContent, link.getAttribute('href')]));
  const [id, href] = links.find(([text]) => text === worst[0].id);
  assert.equal(href, `./plant_500/${worst[0].page}`, id);
  await close();
});

test('sorting by keyboard: unknown last either way, said to screen readers, the focus stays', async () => {
  const rows = rowsOf(500);
  const known = rows.filter((row) => row.performance_factor !== null).sort((a, b) => a.performance_factor - b.performance_factor);
  const {page: tab, complaints, close} = await openPlant(500);
  await tab.focus('[data-sort=performance_factor]');
  for (const [direction, first] of [['ascending', known[0]], ['descending', known.at(-1)]]) {
    await tab.keyboard.press('Enter');
    await tab.waitForSelector(`.tabulator-col[aria-sort=${direction}]`);
    assert.equal((await column(tab, 'id'))[0], first.id);
    assert.equal(await tab.evaluate(() => document.activeElement.dataset.sort), 'performance_factor');
    await button(tab, 'Last Page').click();
    assert.equal((await column(tab, 'performance_factor')).at(-1), '');
    await button(tab, 'First Page').click();
    await tab.focus('[data-sort=performance_factor]');
  }
  assert.deepEqual(complaints, []);
  await close();
});

test('search and filters by keyboard, and their removal', async () => {
  const rows = rowsOf(500);
  const {page: tab, complaints, close} = await openPlant(500);
  await tab.focus('input[type=search]');
  await tab.keyboard.type('INV02/comb3');
  const inside = rows.filter((row) => row.id.includes('inv02/comb3'));
  await waitForState(tab, `${inside.length} of 500 rows`);
  assert.deepEqual(await column(tab, 'id'), inside.map((row) => row.id));
  await button(tab, 'Reset').focus();
  await tab.keyboard.press('Enter');
  await waitForState(tab, 'All 500 rows');

  const count = async (name, text, expected) => {
    await filter(tab, name, text);
    await waitForState(tab, `${expected} of 500 rows`);
  };
  await count('zone', '=fail', rows.filter((row) => row.zone === 'fail').length);
  await count('zone', 'FAIL', rows.filter((row) => row.zone?.includes('fail')).length);
  await count('zone', '!pass', rows.filter((row) => !row.zone?.includes('pass')).length);
  await count('zone', 'fail', rows.filter((row) => row.zone?.includes('fail')).length);
  await count('performance_factor', '<=0.9', rows.filter((row) => row.performance_factor !== null && row.performance_factor <= 0.9).length);
  await filter(tab, 'zone', '');
  await count('performance_factor', '0.92..1', rows.filter((row) => row.performance_factor >= 0.92 && row.performance_factor <= 1).length);
  await count('performance_factor', '>1.01', rows.filter((row) => row.performance_factor > 1.01).length);
  assert.deepEqual(complaints, []);
  await close();
});

test('columns are chosen, and rows are saved as they are shown', async () => {
  const rows = rowsOf(500).filter((row) => row.zone === 'fail');
  const {page: tab, close} = await openPlant(500);
  await tab.click('#rows-table summary');
  await tab.getByLabel('Rsh_ohm', {exact: true}).check();
  await tab.getByLabel('status', {exact: true}).uncheck();
  await filter(tab, 'zone', '=fail');
  await waitForState(tab, `${rows.length} of 500 rows`);
  const waiting = tab.waitForEvent('download');
  await button(tab, 'Save these rows as CSV').click();
  const lines = readFileSync(await (await waiting).path(), 'utf8').trim().split('\n').map((line) => line.split(',').map((text) => text.replaceAll('"', '')));
  assert.ok(lines[0].includes('Rsh_ohm') && !lines[0].includes('status'), lines[0].join());
  for (const name of ['id', 'Rsh_ohm']) {
    const at = lines[0].indexOf(name);
    assert.deepEqual(lines.slice(1).map((line) => line[at]), rows.map((row) => String(row[name])));
  }
  await close();
});

test('rows are grouped by the levels of their ids, one within the other, and by words, with counts; by keyboard', async () => {
  const rows = rowsOf(500);
  const {page: tab, complaints, close} = await openPlant(500);
  const heads = () => tab.$$eval('.tabulator-group', (all) => all.map((head) => head.textContent));
  const headOf = (name, some) => {
    const fail = some.filter((row) => row.zone?.startsWith('fail')).length;
    return `${name || 'not known'}: ${some.length} ${some.length === 1 ? 'row' : 'rows'}${fail ? `, ${fail} fail` : ''}`;
  };
  const headsOf = (keyOf, some = rows) => [...new Set(some.map(keyOf))].map((key) => headOf(key, some.filter((row) => keyOf(row) === key)));
  const group = (label) => tab.getByLabel('Group by').selectOption({label});
  const waitForHeads = async (expected) => {
    await tab.waitForFunction((count) => document.querySelectorAll('.tabulator-group').length === count, expected.length);
    assert.deepEqual(await heads(), expected);
  };
  await group('zone');
  await waitForHeads(headsOf((row) => row.zone ?? ''));
  await group('id: site1/inv01');
  const [site] = headsOf((row) => row.id.split('/')[0]);
  await waitForHeads([site]);
  assert.deepEqual(await barriers(tab), []);
  const inverters = headsOf((row) => row.id.split('/').slice(0, 2).join('/'));
  await button(tab, site).focus();
  await tab.keyboard.press('Enter');
  await waitForHeads([site, ...inverters]);
  await tab.waitForFunction(() => document.activeElement.ariaExpanded === 'true');
  assert.equal(await tab.evaluate(() => document.activeElement.textContent), site);
  await button(tab, inverters[1]).click();
  const inside = rows.filter((row) => row.id.startsWith('site1/inv02/'));
  await tab.waitForSelector('.tabulator-row:not(.tabulator-group)');
  assert.equal((await column(tab, 'id'))[0], inside[0].id);
  await tab.fill('input[type=search]', 'no such row');
  await waitForState(tab, '0 of 500 rows');
  assert.deepEqual(await barriers(tab), []);
  await button(tab, 'Show all rows').click();
  await waitForState(tab, 'All 500 rows');
  await group('nothing');
  await waitForHeads([]);
  assert.deepEqual(complaints, []);
  await close();
});

// The parts of a chart as Plotly has them: what each filters, how high it is and where it is drawn.
const partsOf = (page, figure) => page.evaluate((id) => {
  const plot = document.querySelector(`#${id} .js-plotly-plot`);
  const bars = [...plot.querySelectorAll('.bars .point path')];
  return plot.data.filter(({type}) => type === 'bar').flatMap(({x, y, meta, customdata}) => x.map((_, i) => ({meta, texts: customdata[i], count: y[i]})))
    .map((part, i) => ({...part, at: bars[i]}))
    .map(({at, ...part}, i) => { at.id = `${id}-part-${i}`; return {...part, path: `#${at.id}`}; });
}, figure);
async function clickPart(page, path) {  // Plotly takes the pointer with a layer above its parts, and notes what is below it
  await page.hover(path, {force: true});
  await page.waitForSelector('.hoverlayer .hovertext');
  await page.click(path, {force: true});
}
const told = (page, figure) => page.locator(`#${figure} .live [role=status]`);

test('a click on a part of a chart shows its rows, and so does its name in a list', async () => {
  const rows = rowsOf(500);
  const {page: tab, complaints, close} = await open(browser, page(500));  // the table is not filled yet
  await chartsReady(tab);
  const shows = async (figure, count) => {
    await tab.waitForFunction(([id, text]) => document.querySelector(`#${id} .live [role=status]`).textContent === text,
                              [figure, `The table shows ${count === 500 ? 'All' : `${count} of`} 500 rows`]);
  };
  const [cell] = (await partsOf(tab, 'figure-2')).filter(({texts}) => texts[0] === '^site1/inv02/comb3/');
  await clickPart(tab, cell.path);
  const inside = rows.filter((row) => row.id.startsWith('site1/inv02/comb3/'));
  await shows('figure-2', inside.length);
  await waitForState(tab, `${inside.length} of 500 rows`);
  assert.deepEqual(await column(tab, 'id'), inside.map((row) => row.id));
  assert.equal(await tab.inputValue('[aria-label="Filter id"]'), '^site1/inv02/comb3/');

  for (const part of await partsOf(tab, 'figure-4')) {  // every bar of the distributions holds as many rows as it says
    await tab.selectOption('#figure-4 .tools select', JSON.stringify([part.meta, part.texts]));
    await shows('figure-4', part.count);
  }
  const [loss] = await partsOf(tab, 'figure-1');
  await clickPart(tab, loss.path);
  const [under, , , title] = loss.texts;
  await shows('figure-1', rows.filter((row) => row.id.startsWith(under.slice(1)) && row.zone?.startsWith('fail') && `=${row.cause_title}` === title).length);
  await told(tab, 'figure-1').getByRole('link').click();
  await tab.waitForFunction(() => document.getElementById('rows-table').getBoundingClientRect().top < innerHeight);
  assert.deepEqual(complaints, []);
  await close();
});

test('the chart of the rows shows the columns that are chosen, of the rows that pass the filters', async () => {
  const rows = rowsOf(500);
  const {page: tab, complaints, close} = await openPlant(500);
  const chart = tab.locator('#rows-chart');
  await chart.locator('.bars .point').first().waitFor();
  const drawn = () => tab.evaluate(() => document.querySelector('#rows-chart .js-plotly-plot').data.map(({name, x, y}) => ({name, x, y})));
  const waitForPoints = (count) => tab.waitForFunction((most) => document.querySelector('#rows-chart .js-plotly-plot').data.reduce(
      (sum, {type, x, y}) => sum + (type === 'bar' ? y.reduce((a, b) => a + b, 0) : x.length), 0) === most, count);
  await chart.locator('.rows-tools select').nth(0).selectOption({label: 'FF'});
  await waitForPoints(rows.filter((row) => row.FF !== null).length);
  for (const part of (await partsOf(tab, 'rows-chart')).slice(0, 5)) {
    const [low, high] = part.texts[0].split('..<').map(Number);
    assert.equal(part.count, rows.filter((row) => row.FF !== null && row.FF >= low && row.FF < high).length, part.texts[0]);
  }
  await chart.locator('.rows-tools select').nth(1).selectOption({label: 'Rs_ohm'});
  await chart.locator('.rows-tools select').nth(2).selectOption({label: 'zone'});
  const zones = [...new Set(rows.map((row) => row.zone).filter(Boolean))];
  await tab.waitForFunction((count) => document.querySelector('#rows-chart .js-plotly-plot').data.length === count, zones.length);
  for (const {name, x, y} of await drawn()) {
    const some = rows.filter((row) => row.zone === name);
    assert.deepEqual([x, y], [some.map((row) => row.FF), some.map((row) => row.Rs_ohm)], name);
  }
  await filter(tab, 'zone', '=fail');
  await waitForPoints(rows.filter((row) => row.zone === 'fail').length);
  await button(tab, 'Reset').click();
  await chart.locator('.rows-tools select').nth(1).selectOption({label: 'count'});
  await waitForPoints(rows.filter((row) => row.FF !== null).length);
  await tab.waitForTimeout(200);
  const bar = (await partsOf(tab, 'rows-chart')).reduce((most, part) => (part.count > most.count ? part : most));
  await clickPart(tab, bar.path);  // and the chart shows its rows in finer steps
  await waitForState(tab, `${bar.count} of 500 rows`);
  await waitForPoints(bar.count);
  assert.deepEqual(await barriers(tab), []);
  assert.deepEqual(complaints, []);
  await close();
});

test('the dialog opens and closes by keyboard, links to the page of its string, and gives the focus back', async () => {
  const row = rowsOf(500).find((each) => each.page);
  const {page: tab, close} = await openPlant(500);
  await tab.fill('input[type=search]', row.id);
  await waitForState(tab, '1 of 500 rows');
  assert.equal(await tab.getAttribute('.tabulator-row a', 'href'), `./plant_500/${row.page}`);
  await tab.focus('.tabulator-row button.link');
  await tab.keyboard.press('Enter');
  await tab.waitForSelector('dialog[open]');
  assert.equal(await tab.textContent('dialog h2'), row.id);
  assert.equal(await tab.getAttribute('dialog a', 'href'), `./plant_500/${row.page}`);
  await tab.keyboard.press('Escape');
  await tab.waitForSelector('dialog', {state: 'detached'});
  assert.equal(await tab.evaluate(() => document.activeElement.textContent), row.id);
  await close();
});

test('hostile texts are texts, in pictures, tables, filters, links and saved rows', async () => {
  const rows = rowsOf('hostile');
  const {page: tab, complaints, close} = await openPlant('hostile');
  const shown = (text) => text.trim().replaceAll(/\s+/g, ' ');
  assert.deepEqual((await column(tab, 'id')).map(shown), rows.map((row) => shown(row.id.startsWith('=') ? `'${row.id}` : row.id)));
  for (const link of await tab.$$eval('a[href]', (all) => all.map((each) => each.getAttribute('href')))) assert.match(link, /^(#|\.\/)[^:]*$/);
  assert.equal(await tab.$$eval('main :is(img, script)', (all) => all.length), 0);
  await filter(tab, 'cause_title', '=<img src=x onerror=alert(1)>');
  await waitForState(tab, `1 of ${rows.length} rows`);
  await tab.click('.tabulator-row button.link');
  await tab.waitForSelector('dialog[open]');
  assert.equal(await tab.textContent('dialog h2'), rows[0].id);
  await tab.keyboard.press('Escape');
  await button(tab, 'Reset').click();
  const formula = rows.find((row) => Object.values(row).some((value) => String(value).startsWith('=1+cmd')));
  const [name, text] = Object.entries(formula).find(([, value]) => String(value).startsWith('=1+cmd'));
  await filter(tab, name, `=${text}`);  // the file has an apostrophe before it
  await waitForState(tab, `1 of ${rows.length} rows`);
  await button(tab, 'Reset').click();
  for (const head of await tab.$$('[data-sort]')) if (await head.isVisible()) await head.click();
  const waiting = tab.waitForEvent('download');
  await button(tab, 'Save these rows as CSV').click();
  assert.ok(readFileSync(await (await waiting).path(), 'utf8').includes(`"'=1+cmd`));
  for (const bars of await tab.$$('figure .bars .point path')) await bars.hover({force: true});
  assert.deepEqual(complaints, []);
  await close();
});

test('reads without scripts and on paper', async () => {
  const worst = worstOf(500).length;
  const still = await open(browser, page(500), {...kLooks.light, javaScriptEnabled: false});
  for (const words of ['Strings by zone', `The ${worst} worst strings`, 'Why there is no result']) {
    assert.ok(await still.page.isVisible(`text=${words}`), words);
  }
  assert.match(await still.page.innerText('noscript p'), /^The table of all rows needs scripts/);
  assert.equal(await still.page.$$eval('.still svg', (all) => all.length), 5);
  assert.equal((await cells(still.page, 'Which strings')).length, worst);
  assert.deepEqual(still.complaints, []);
  await still.close();

  const {page: tab, close} = await openPlant(500, kLooks.dark);
  await tab.emulateMedia({media: 'print'});
  assert.equal(await tab.$$eval('.still', (all) => all.filter((each) => each.offsetParent).length), 5);
  assert.ok(!await tab.isVisible('#rows-table'));
  assert.ok(!await tab.isVisible('button[data-page]'));
  assert.equal(await tab.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
  writeFileSync(join(OUT, 'plant_500.pdf'), await tab.pdf({preferCSSPageSize: true}));
  await close();

  const many = await open(browser, page(10000));  // a table that scrolls on the screen is whole on paper
  await many.page.emulateMedia({media: 'print'});
  const printed = await many.page.$$eval('.box.long tbody tr', (all) => all.filter((row) => row.offsetParent).length);
  assert.equal(printed, worstOf(10000).length);
  assert.equal(printed, 100);
  await many.close();
});

for (const [rows, mostMegabytes] of [[500, 1.5], [10000, 5], [100000, 40]]) {
  test(`size, first paint and memory at ${rows} strings`, async (context) => {
    const size = statSync(page(rows)).size;
    const {page: tab, complaints, close} = await open(browser, page(rows));
    await chartsReady(tab);
    const drawn = await tab.evaluate(() => performance.now());
    const paint = await tab.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0].startTime);
    const start = Date.now();
    await tab.evaluate(() => document.getElementById('rows-table').scrollIntoView());
    await tab.waitForSelector('html[data-rows]', {state: 'attached'});
    const filled = Date.now();
    await tab.click('[data-sort=Pmax_stc_W]');
    await tab.waitForSelector('.tabulator-col[aria-sort=ascending]');
    const sorted = Date.now();
    const session = await tab.context().newCDPSession(tab);
    await session.send('Performance.enable');
    const {metrics} = await session.send('Performance.getMetrics');
    const heap = metrics.find(({name}) => name === 'JSHeapUsedSize').value;
    context.diagnostic(`${(size / kMegabyte).toFixed(2)} MB, first paint ${paint.toFixed(0)} ms, pictures drawn within ${drawn.toFixed(0)} ms, ` +
                       `rows filled in ${filled - start} ms, sorted in ${sorted - filled} ms, heap ${(heap / kMegabyte).toFixed(0)} MB`);
    assert.ok(size < mostMegabytes * kMegabyte);
    assert.ok(heap < 500 * kMegabyte);
    assert.deepEqual(complaints, []);
    await close();
  });
}
