// The pages of the command in a browser:
//   APP=lyrefit CHROMIUM=chromium DATA=data OUT=folder node --test pages_test.mjs
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {copyFileSync, mkdirSync, readFileSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {assertSays, barriers, cells, chartsReady, embedded, kLooks, launch, memoryOf, open} from './browser.mjs';

const {APP, CHROMIUM, DATA, OUT} = process.env;
const kMegabyte = 1e6;
const file = (name) => join(OUT, name);
const json = (name) => JSON.parse(readFileSync(file(`${name}.json`), 'utf8'));

// A file whose name is a page's nightmare.
const kHostile = '<img src=x onerror=alert(1)> "\'&amp;%{x}.csv';
const kPages = {
  fit: ['fit', `${DATA}/rtc_france`],
  diagnose: ['diagnose', `${DATA}/diagnosis/shaded_module.csv`],
  certify: ['certify', `${DATA}/rtc_france`],
  family: ['fit', `${DATA}/s75_constructed`, '--family', 'desoto'],
  matrix: ['fit', `${DATA}/formats/matrix_wide.csv`, '--family', 'pvsyst'],
  cell: ['cell', ...['pair', 'lights', 'lit_dark', 'suns'].map((name) => `${DATA}/cell/${name}.csv`)],
  junctions: ['fit', file('white.csv'), file('red.csv'), '--junctions', '2', '--light', 'white=1:1',
              '--light', 'red=0.9:1.1'],
  compare: ['compare', `${DATA}/rtc_france`, '--runs', '4', '--models', 'sd', '--iterations', '50'],
  translate: ['translate', `${DATA}/diagnosis/shaded_module.csv`, '--rated-W', '475', '--gamma', '-0.4',
              '--irradiance-from', 'reference-cell', '--temperature-from', 'back', '--tracer', 'PVA-1500',
              '--serial', '4711', '--operator', 'Crew B', '--draws', '2000'],
  hostile: ['fit', file(kHostile), '--cells', '1', '--temperature-C', '33'],
};

let browser;
before(async () => {
  mkdirSync(OUT, {recursive: true});
  copyFileSync(`${DATA}/rtc_france/curve.csv`, file(kHostile));
  for (const [name, light] of [['white', [0.0195, 0.0202]], ['red', [0.01755, 0.02222]]]) {
    const device = {Iph1: light[0], Is1: 1e-14, n1: 1.4, Rsh1: 3000, Iph2: light[1], Is2: 4e-10, n2: 1.2,
                    Rsh2: 1500, Rs: 2};
    const set = Object.entries(device).flatMap(([symbol, value]) => ['--set', `${symbol}=${value}`]);
    execFileSync(APP, ['simulate', '--junctions', '2', ...set, '--noise-A', '2e-5', '--out', file(`${name}.csv`)]);
  }
  for (const [name, command] of Object.entries(kPages)) {
    execFileSync(APP, [...command, '--quiet', '--html', file(`${name}.html`), '--json',
                       file(`${name}.json`)]);
  }
  browser = await launch(CHROMIUM);
});
after(() => browser?.close());

for (const name of Object.keys(kPages)) {
  // The hostile page is that of a fit but for its name.
  for (const [look, settings] of Object.entries(name === 'hostile' ? {light: kLooks.light} : kLooks)) {
    test(`${name}, ${look}: nothing fetched, nothing complained of, no barrier, no overflow`, async () => {
      const {page, complaints, close} = await open(browser, file(`${name}.html`), settings);
      await chartsReady(page);
      await page.screenshot({path: file(`${name}_${look}.png`), fullPage: true});
      for (const summary of await page.$$('summary')) await summary.click();
      assert.deepEqual(await barriers(page, look), []);
      const [width, most] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(width <= most, `${width} pixels wide, ${most} to see`);
      assert.deepEqual(complaints, []);
      await close();
    });
  }

  test(`${name}: the record in the page is that of --json`, async () => {
    const {page, close} = await open(browser, file(`${name}.html`));
    assert.deepEqual(await embedded(page), json(name));
    const waiting = page.waitForEvent('download');
    await page.click('text=Save data');
    const saved = await (await waiting).path();
    assert.deepEqual(JSON.parse(readFileSync(saved, 'utf8')), json(name));
    await close();
  });

  test(`${name}: reads without scripts and on paper`, async () => {
    const still = await open(browser, file(`${name}.html`), {...kLooks.light, javaScriptEnabled: false});
    assert.ok(await still.page.isVisible('figure .still svg'));
    assert.ok(!await still.page.isVisible('button'));
    assert.ok((await still.page.textContent('main')).length > 500);
    await still.page.screenshot({path: file(`${name}_still.png`), fullPage: true});
    await still.page.setViewportSize(kLooks.phone.viewport);
    const pictures = await still.page.$$eval('.still svg', (all) => all.map((svg) => svg.getBoundingClientRect().right));
    assert.ok(pictures.every((right) => right <= kLooks.phone.viewport.width), `cut on a phone: ${pictures}`);
    assert.deepEqual(still.complaints, []);
    await still.close();

    const {page, close} = await open(browser, file(`${name}.html`), kLooks.dark);
    await chartsReady(page);
    await page.emulateMedia({media: 'print'});
    assert.ok(await page.isVisible('figure .still svg'));
    assert.ok(!await page.isVisible('figure .live'));
    assert.ok(!await page.isVisible('button'));
    const paper = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.equal(paper, 'rgb(255, 255, 255)');
    const pdf = await page.pdf({preferCSSPageSize: true});
    writeFileSync(file(`${name}.pdf`), pdf);
    assert.match(pdf.toString('latin1'), /MediaBox \[0 0 59[45](\.\d+)? 84[12]/);  // A4
    await close();
  });
}

test('fit: parameters, key points and readings are those of the record', async () => {
  const {page, close} = await open(browser, file('fit.html'));
  const record = await embedded(page);
  const parameters = Object.values(record.parameters);
  const rows = await cells(page, 'Parameters');
  assert.equal(rows.length, parameters.length);
  rows.forEach((row, i) => {
    assert.ok(row[0].startsWith(parameters[i].symbol));
    assertSays(row[2], parameters[i].refined, `${row[0]} refined`);
    assertSays(row[3], parameters[i].standard_error, `${row[0]} standard error`);
    const [low, high] = row[4].split(' .. ');
    assertSays(low, parameters[i].low_95, `${row[0]} low`);
    assertSays(high, parameters[i].high_95, `${row[0]} high`);
  });
  await chartsReady(page);
  const [points, expected] = await page.evaluate(async () => {
    const {data} = await lyrefit.data('figure-1-chart');
    const drawn = document.querySelector('.js-plotly-plot').data;
    const of = (traces) => traces.filter((trace) => trace.x.length > 1).map(({x, y}) => [x, y]);
    return [of(drawn), of(data)];
  });
  assert.deepEqual(points, expected);
  const readings = await page.$$eval('details.readings tbody tr', (all) => all.map(
      (row) => [...row.cells].map((cell) => Number(cell.textContent))));
  assert.equal(readings.length, record.curve.points);
  const measured = points.find(([x]) => x.length === readings.length);
  readings.forEach((row, i) => {
    assert.ok(Math.abs(row[0] - measured[0][i]) < 1e-5 && Math.abs(row[1] - measured[1][i]) < 1e-5);
    // Six digits of currents below 1 A and three of residuals below 10 mA are rounded.
    assert.ok(Math.abs(row[2] - row[1] - row[3]) < 2 * 5e-7 + 5e-6);
  });
  await close();
});

test('cell: sweeps, hysteresis and series resistance are those of the record', async () => {
  const {page, close} = await open(browser, file('cell.html'));
  const {sweeps, hysteresis, resistance_series: found} = await embedded(page);
  const rows = await cells(page, 'Sweeps');
  assert.equal(rows.length, sweeps.length);
  rows.forEach((row, i) => {
    assert.equal(row[0], sweeps[i].name);
    if (sweeps[i].kind !== 'lit') return;
    assertSays(row[1], sweeps[i].jsc_mA_cm2, `${row[0]} Jsc`);
    assertSays(row[6], 100 * sweeps[i].key_points.fill_factor, `${row[0]} FF`);
    assertSays(row[7], 100 * sweeps[i].efficiency, `${row[0]} efficiency`);
  });
  const [byPower] = await cells(page, 'Hysteresis');
  assertSays(byPower[1], 100 * hysteresis[0].index_power, 'index by power');
  (await cells(page, 'Series resistance')).forEach((row, i) => {
    assert.equal(row[0], found[i].method);
    assertSays(row[2], found[i].ohm_cm2, row[0]);
  });
  await close();
});

test('matrix: the verdict speaks of power, as the record has it', async () => {
  const {page, close} = await open(browser, file('matrix.html'));
  const {rms: found} = (await embedded(page)).key_points;
  const [errors, held_out] = (await page.textContent('.verdict p')).match(/[0-9.e-]+(?= %)/g);
  assertSays(errors, 100 * found.max_power_of_reference, 'rms error of Pmp');
  assertSays(held_out, 100 * found.held_out_max_power_of_reference, 'of conditions held out');
  await close();
});

test('diagnose: verdict, sizes and gain are those of the record', async () => {
  const {page, close} = await open(browser, file('diagnose.html'));
  const {verdict, gain, curves, points} = await embedded(page);
  assert.equal(await page.textContent('.verdict p'), verdict.sentence);
  const [cause] = verdict.causes;
  const text = await page.textContent('main');
  assert.ok(text.includes(cause.title) && text.includes(cause.sentence));
  const [all] = await cells(page, 'Gain');
  assertSays(all[1], gain.rmse_before_A, 'RMSE of the base model');
  assertSays(all[2], gain.rmse_after_A, 'RMSE with causes');
  // The band lies where the record says that the cause acts.
  await chartsReady(page);
  const band = await page.evaluate(() => document.querySelector('.js-plotly-plot').layout.shapes
      .filter((shape) => shape.type === 'rect' && shape.yref.endsWith('domain'))
      .map(({x0, x1}) => [x0, x1])[0]);
  const at = cause.points.map((i) => points.voltage_V[i]);
  const span = Math.max(...points.voltage_V) - Math.min(...points.voltage_V);
  assert.ok(Math.abs(band[0] - Math.min(...at)) < 0.01 * span);
  assert.ok(Math.abs(band[1] - Math.max(...at)) < 0.01 * span);
  assert.equal(curves.length, 1);
  await close();
});

test('certify: the floor and the models are those of the record', async () => {
  const {page, close} = await open(browser, file('certify.html'));
  const record = await embedded(page);
  const rows = await cells(page, 'Models');
  rows.forEach((row) => {
    const model = record.models.find((each) => each.model === row[0]);
    assertSays(row[1], model.rmse_A, `${row[0]} RMSE`);
  });
  assert.equal(rows.length, record.models.length);
  await close();
});

test('family: the curves are those of the record', async () => {
  const {page, close} = await open(browser, file('family.html'));
  const record = await embedded(page);
  const rows = await cells(page, 'Curves');
  assert.equal(rows.length, record.curves.length);
  rows.forEach((row, i) => {
    assertSays(row[1], record.curves[i].irradiance_Wm2, 'irradiance');
    assertSays(row[4], record.curves[i].rmse.solved_current_A, 'RMSE');
  });
  await close();
});

test('a barrier, an overflow and a request are seen where there are some', async () => {
  const bad = '<html><body><main><h1>x</h1><p style="color:#ddd">pale</p><img src="https://x.invalid/y">' +
              '<div style="width:3000px">wide</div></main></body></html>';
  writeFileSync(file('bad.html'), bad);
  const {page, complaints, close} = await open(browser, file('bad.html'));
  const found = (await barriers(page)).join();
  for (const barrier of ['color-contrast', 'image-alt', 'html-has-lang']) assert.ok(found.includes(barrier));
  assert.ok(complaints.some((complaint) => complaint.startsWith('request: https://x.invalid')));
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth > innerWidth));
  await close();
});

test('hostile names are letters', async () => {
  const {page, close} = await open(browser, file('hostile.html'));
  await chartsReady(page);
  const name = kHostile.replace('.csv', '');
  assert.ok((await page.textContent('h1')).includes(name));
  assert.ok((await page.textContent('.live-title')).includes(name));
  assert.equal(await page.$('img'), null);
  await close();
});

test('keyboard: skip link, legend, buttons, theme', async () => {
  const {page, complaints, close} = await open(browser, file('fit.html'));
  await chartsReady(page);
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.className), 'skip');
  await page.keyboard.press('Enter');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'main');

  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await paper();
  await page.focus('[data-page=theme]');
  await page.keyboard.press('Enter');
  assert.notEqual(await paper(), light);
  assert.equal(await page.textContent('[data-page=theme]'), 'Light');

  const traces = () => page.evaluate(() => document.querySelector('.js-plotly-plot').data.length);
  const all = await traces();
  await page.focus('.legend button');
  await page.keyboard.press('Enter');
  assert.equal(await page.getAttribute('.legend button', 'aria-pressed'), 'false');
  assert.ok(await traces() < all);

  const range = () => page.evaluate(() => document.querySelector('.js-plotly-plot')._fullLayout.xaxis.range);
  const [low, high] = await range();
  await page.click('text=Zoom in');
  const [zoomed_low, zoomed_high] = await range();
  assert.ok(Math.abs((zoomed_high - zoomed_low) / (high - low) - 0.5) < 1e-6);
  await page.click('text=Reset');
  assert.deepEqual(await range(), [low, high]);
  assert.equal(await traces(), all);
  const waiting = page.waitForEvent('download');
  await page.click('text=PNG');
  const png = readFileSync(await (await waiting).path());
  assert.equal(png.subarray(1, 4).toString(), 'PNG');
  writeFileSync(file('fit_button.png'), png);
  assert.deepEqual(complaints, []);
  await close();
});

test('the pointer says values with their units', async () => {
  const {page, close} = await open(browser, file('fit.html'));
  await chartsReady(page);
  const at = await page.evaluate(() => {
    const plot = document.querySelector('.js-plotly-plot');
    const {xaxis, yaxis} = plot._fullLayout;
    const trace = plot.data.find(({x}) => x.length === 26);
    const box = plot.getBoundingClientRect();
    return [box.x + xaxis._offset + xaxis.d2p(trace.x[5]), box.y + yaxis._offset + yaxis.d2p(trace.y[5])];
  });
  await page.mouse.move(...at);
  await page.waitForSelector('.hovertext');
  const text = await page.textContent('.hoverlayer');
  assert.match(text, /V/);
  assert.match(text, /A/);
  assert.match(text, /I (measured|model)/);
  await close();
});

test('size, first paint and memory of one curve', async (context) => {
  const size = statSync(file('diagnose.html')).size;
  const {page, close} = await open(browser, file('diagnose.html'));
  await chartsReady(page);
  const paint = await page.evaluate(
      () => performance.getEntriesByName('first-contentful-paint')[0].startTime);
  const memory = await memoryOf(browser);
  const ready = await page.evaluate(() => performance.now());
  context.diagnostic(`${(size / kMegabyte).toFixed(2)} MB, first paint ${paint.toFixed(0)} ms, ` +
                     `charts within ${ready.toFixed(0)} ms, memory ${(memory / kMegabyte).toFixed(0)} MB`);
  assert.ok(size < 1.6 * kMegabyte);
  assert.ok(memory < 150 * kMegabyte);
  await close();
});

test('translate: the verdict, the table and the sources are those of the record; paper has lines to sign', async () => {
  const {page, close} = await open(browser, file('translate.html'));
  const record = await embedded(page);
  const best = record.results.find((each) => each.procedure === record.recommended);
  const verdict = await page.textContent('.verdict');
  assert.ok(verdict.toLowerCase().includes(`${record.field_test.zone}:`), verdict);
  assert.ok(verdict.includes(`${record.field_test.standard_W.toFixed(0)} W at 1000 W/m2`), verdict);
  assert.ok(verdict.includes(record.field_test.performance_factor.toFixed(3)), verdict);
  const rows = await cells(page, 'At 1000 W/m2');
  const power = (name) => rows.find((row) => row[0].startsWith(name)).at(5);  // Isc, Voc, Imp, Vmp, Pmax, FF
  assertSays(power('measured'), record.measured.max_power_W, 'Pmax as measured');
  assert.ok(Math.abs(Number(power('here').split(' ')[0]) / best.budget.results[4].value - 1) < 0.005, power('here'));
  const text = await page.textContent('main');
  for (const words of ['by a reference cell', 'by a sensor on the back', 'PVA-1500, serial 4711', 'Crew B']) {
    assert.ok(text.includes(words), words);
  }
  assert.ok(!await page.isVisible('.sign'));
  await page.emulateMedia({media: 'print'});
  assert.ok(await page.isVisible('.sign'));
  await close();
});

test('a plant leads to the page of a string, wherever both lie', async () => {
  const module = file('module.json');
  writeFileSync(module, '{"rated_power_W": 500, "gamma_pmp_percent_K": -0.4, "beta_oc_percent_K": -0.3}');
  const lines = readFileSync(`${DATA}/plant/strings.csv`, 'utf8').split('\n');
  writeFileSync(file('two.csv'), [lines[0], ...lines.slice(1, 3)].join('\n') + '\n');
  execFileSync(APP, ['batch', file('two.csv'), '--task', 'field-test', '--module', module, '--modules', '20',
                     '--effects', 'clip', '--pages', 'all', '--force', '--quiet',
                     '--out', file('my results #1'), '--html', file('two.html')]);
  const {page, close} = await open(browser, file('two.html'));
  await page.evaluate(() => document.getElementById('rows-table').scrollIntoView());
  await page.waitForSelector('html[data-rows]', {state: 'attached'});
  for (const link of ['.tabulator-row a', 'section th a']) {
    const [href, id] = await page.$eval(link, (each) => [each.href, each.closest('tr, .tabulator-row').firstElementChild.textContent]);
    const string = await page.context().newPage();
    await string.goto(href);
    assert.ok((await string.textContent('h1')).startsWith(id), href);
    assert.ok(await string.isVisible('figure .still svg'));
    await string.close();
  }
  await close();
});
