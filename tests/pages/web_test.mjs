// The page that needs no server, in a browser, from disk:
//   PAGE=lyrefit.html APP=lyrefit CHROMIUM=chromium DATA=data OUT=folder node --test web_test.mjs
import assert from 'node:assert/strict';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {test} from 'node:test';

import {barriers, chartsReady, kLooks, memoryOf, open} from './browser.mjs';
import {DATA, PAGE, begin, browser, commanded, compare, drop, dropText, kFiles, openOptions, out, report, saved, work} from './web_page.mjs';

const kMegabyte = 1e6;

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
