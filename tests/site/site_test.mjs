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
  await page.waitForSelector('#search-results ul.search li a');
  const found = await page.$$eval('#search-results ul.search li a', (links) => links.map((link) => link.textContent));
  assert.ok(found.includes('Hysteresis of a pair of sweeps'), found.join(', '));
  const around = await page.$$eval('#search-results ul.search li p.context', (texts) => texts.map((text) => text.textContent));
  assert.equal(around.length, found.length);
  for (const text of around) assert.match(text.toLowerCase(), /hysteresi/);
  await page.click('#search-results a:text-is("Hysteresis of a pair of sweeps")');
  await page.waitForSelector('h1');
  assert.match(page.url(), /gallery\/hysteresis\.html/);
  assert.deepEqual(faults(), []);
  await close();
});

test('the search knows names of C++ and of Python', async () => {
  for (const [word, title] of [['FitFamily', 'C++ reference'], ['fit_family', 'lyrefit.fit_family']]) {
    const {page, close} = await opened('search', 'light');
    await page.goto(`${page.url()}?q=${word}`);
    await page.waitForSelector('#search-results ul.search li a');
    const found = await page.$$eval('#search-results ul.search li a', (links) => links.map((link) => link.textContent));
    assert.ok(found.some((text) => text.includes(title)), `${word}: ${found.join(', ')}`);
    await close();
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
