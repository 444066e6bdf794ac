// The site in a browser, from disk:
//   SITE=folder CHROMIUM=chromium OUT=folder node --test site_test.mjs
import assert from 'node:assert/strict';
import {mkdirSync, readdirSync} from 'node:fs';
import {join, relative, sep} from 'node:path';
import {after, before, test} from 'node:test';
import {pathToFileURL} from 'node:url';

import {barriers, kLooks, launch, open} from './browser.mjs';

const {SITE, CHROMIUM, OUT} = process.env;
const kPictured = ['index', 'start', 'gallery/index', 'gallery/compare', 'notebooks/compare', 'verbs/fit', 'how_a_fit_works',
                   'diagnosis', 'formats', 'python/lyrefit.fit', 'cpp'];
const pages = readdirSync(SITE, {recursive: true, withFileTypes: true})
                  .map((entry) => relative(SITE, join(entry.path, entry.name)).split(sep).join('/'))
                  .filter((name) => name.endsWith('.html') && !name.startsWith('cpp/') && !name.startsWith('_static/'))
                  .map((name) => name.slice(0, -'.html'.length))
                  .sort();

let browser;
before(async () => {
  mkdirSync(OUT, {recursive: true});
  browser = await launch(CHROMIUM);
});
after(() => browser?.close());

// A page of the site may load other files of the site, and nothing else.
const file = (name) => join(SITE, `${name}.html`);
const foreign = (complaints) => complaints.filter((complaint) => !complaint.startsWith('request: file:'));

const finished = () => /found \d+/.test(document.querySelector('#search-results .search-summary')?.textContent);

async function opened(name, look) {
  const page = await open(browser, file(name), kLooks[look]);
  return {...page, faults: () => foreign(page.complaints)};
}

test('every page, at 1280 and 390 px: no error, nothing from elsewhere, no wider than the screen', async () => {
  assert.ok(pages.length > 100);
  const {page, complaints, close} = await open(browser, file('index'));
  const faults = [];
  for (const name of pages) {
    await page.goto(pathToFileURL(file(name)).href);
    for (const [look, {viewport}] of Object.entries({wide: kLooks.light, phone: kLooks.phone})) {
      await page.setViewportSize(viewport);
      const content = await page.evaluate(() => document.documentElement.scrollWidth);
      if (content > viewport.width) faults.push(`${name}: ${content} px wide on ${viewport.width}`);
      if (kPictured.includes(name)) await page.screenshot({path: join(OUT, `site_${name.replaceAll('/', '_')}_${look}.png`)});
    }
    const broken = await page.evaluate(() => [...document.images].filter((image) => image.complete && !image.naturalWidth)
                                                 .map((image) => image.src));
    faults.push(...foreign(complaints.splice(0)).concat(broken).map((fault) => `${name}: ${fault}`));
  }
  assert.deepEqual(faults, []);
  await close();
});

test('the search finds a word, from disk, and leads to its page', async () => {
  const {page, faults, close} = await opened('index', 'light');
  await page.fill('input[name=q]', 'hysteresis');
  await page.press('input[name=q]', 'Enter');
  await page.waitForFunction(finished);
  const found = await page.$$eval('#search-results ul.search li a', (links) => links.map((link) => link.textContent));
  assert.ok(found.includes('Hysteresis of a pair of sweeps'), found.join(', '));
  const around = await page.$$eval('#search-results ul.search li p.context', (texts) => texts.map((text) => text.textContent));
  assert.equal(around.length, found.length);
  for (const text of around) assert.match(text.toLowerCase(), /hysteresi/);
  await page.locator('#search-results a', {hasText: /^Hysteresis of a pair of sweeps$/}).click();  // what was asked for is marked in it
  await page.waitForSelector('h1');
  assert.match(page.url(), /gallery\/hysteresis\.html/);
  assert.deepEqual(faults(), []);
  await close();
});

// What a search lists: the title and the page of each.
async function found(word) {
  const {page, close} = await opened('search', 'light');
  await page.goto(`${page.url()}?q=${word}`);
  await page.waitForFunction(finished);
  const links = await page.$$eval('#search-results ul.search li a', (all) => all.map((link) => [link.textContent, link.getAttribute('href')]));
  await close();
  return links;
}

test('the page of a verb comes first for its name, no page is listed twice, and titles say of what they are', async () => {
  for (const verb of ['certify', 'batch', 'trend', 'audit']) {
    const links = await found(verb);
    assert.match(links[0][1], new RegExp(`^verbs/${verb}\\.html`), links.join('; '));
    const places = links.map(([, link]) => link.replace(/\?[^#]*/, ''));
    assert.deepEqual(places.filter((link, number) => places.indexOf(link) !== number), [], verb);
    assert.ok(!links.some(([title]) => title === verb), links.join('; '));
  }
  assert.ok((await found('optimizer')).some(([title]) => title.startsWith('Your optimizer beside twelve others')));
});

test('numbers and flags of tables do not break on a phone', async () => {
  const {page, close} = await open(browser, file('index'), kLooks.phone);
  for (const [name, whole] of [['benchmark_curves', '9.860218779e-4'], ['modules/certify/index', '8.7e-11'], ['verbs/fit', '--irradiance-Wm2']]) {
    await page.goto(pathToFileURL(file(name)).href);
    const lines = await page.$$eval('td :is(.number, code .pre)', (all) => all.map((part) => [part.textContent, part.getClientRects().length]));
    assert.deepEqual(lines.filter(([, count]) => count > 1), [], name);
    assert.ok(lines.some(([text]) => text === whole), name);
  }
  await close();
});

test('a page of the C++ reference begins with its text on a phone, its tree follows', async () => {
  const {page, close} = await open(browser, file('cpp/group__estimate'), kLooks.phone);
  await page.waitForSelector('#nav-tree li');
  const top = (selector) => page.$eval(selector, (element) => element.getBoundingClientRect().top);
  assert.ok(await top('.title') < 200);
  assert.ok(await top('#nav-tree') > await top('.contents'));
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= kLooks.phone.viewport.width);
  await close();
});

test('the search knows names of C++ and of Python', async () => {
  for (const [word, title] of [['FitFamily', 'C++ reference'], ['fit_family', 'lyrefit.fit_family']]) {
    const links = await found(word);
    assert.ok(links.some(([text]) => text.includes(title)), `${word}: ${links.join('; ')}`);
  }
});

test('search and the name of the project are in view, wherever in the menu a page is', async () => {
  for (const name of ['gallery/own_effect', 'cite', 'project/index']) {
    const {page, close} = await opened(name, 'light');
    for (const part of ['input[name=q]', '.wy-side-nav-search > a', '.wy-menu-vertical a.current']) {
      const seen = await page.evaluate((selector) => {
        const element = document.querySelector(selector);
        const box = element?.getBoundingClientRect();
        const on = box && document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
        return Boolean(element?.contains(on));
      }, part);
      assert.ok(seen, `${name}: ${part}`);
    }
    await close();
  }
});

test('the menu of a phone opens and leads on; next leads on', async () => {
  const {page, faults, close} = await opened('index', 'phone');
  assert.equal(await page.locator('.wy-nav-side.shift').count(), 0);
  await page.click('[data-toggle=wy-nav-top]');
  await page.waitForSelector('.wy-nav-side.shift');
  await page.click('.wy-menu-vertical a:text-is("Gallery")');
  await page.waitForSelector('h1:has-text("Gallery")');
  await page.click('.sphx-glr-thumbcontainer a');
  await page.waitForSelector('h1:has-text("Fit one curve")');
  await page.click('a[rel=next]');
  await page.waitForSelector('h1:has-text("Bounds")');
  assert.deepEqual(faults(), []);
  await close();
});

test('the C++ reference is reached, opens and leads back', async () => {
  const {page, close} = await opened('cpp', 'light');
  await page.click('a:text-is("The reference of all public headers")');
  await page.waitForSelector('#projectname');
  assert.match(page.url(), /cpp\/index\.html/);
  await page.click('#projectname a');
  await page.waitForSelector('h1:has-text("lyrefit")');
  await close();
});

test('pages have no barriers that axe knows', async () => {
  for (const name of ['index', 'start', 'gallery/index', 'gallery/fit', 'notebooks/compare', 'verbs/fit', 'how_a_fit_works',
                      'diagnosis', 'formats', 'glossary', 'cite', 'python', 'python/lyrefit.fit', 'cpp', 'speed', 'project/index']) {
    const {page, close} = await opened(name, 'light');
    assert.deepEqual(await barriers(page), [], name);
    await close();
  }
});
