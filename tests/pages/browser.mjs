// What tests of pages share: a browser that reports everything a page does that it must not do.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';

import {chromium} from 'playwright-core';

const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

// The widths and settings that every page is looked at in.
export const kLooks = {
  light: {viewport: {width: 1280, height: 900}},
  dark: {viewport: {width: 1280, height: 900}, colorScheme: 'dark'},
  phone: {viewport: {width: 390, height: 844}, isMobile: true, hasTouch: true, deviceScaleFactor: 2},
};

// What is waited for comes sooner on any machine, or never: the error names it.
export const kHangs_ms = 180000;

export function launch(executablePath) {
  return chromium.launch({
    executablePath,
    timeout: kHangs_ms,
    args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
           '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });
}

// The page of a file, and what it did: `complaints` are errors on the console, thrown ones, dialogs
// and every request but the file itself.
export async function open(browser, file, look = kLooks.light) {
  const context = await browser.newContext({acceptDownloads: true, ...look});
  context.setDefaultTimeout(kHangs_ms);
  const page = await context.newPage();
  const complaints = [];
  const url = pathToFileURL(file).href;
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) complaints.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('dialog', (dialog) => {
    complaints.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on('request', (request) => {
    const wanted = request.url() === url || /^(data|blob):/.test(request.url());
    if (!wanted) complaints.push(`request: ${request.url()}`);
  });
  await page.goto(url);
  return {page, complaints, close: () => context.close()};
}

// Waits until every chart has taken the place of its picture.
export const chartsReady = (page) =>
    page.waitForFunction(() => document.documentElement.dataset.charts === 'ready');

// Bytes of memory that the page's own process has for itself, and its part of what it shares.
export async function memoryOf(browser) {
  const session = await browser.newBrowserCDPSession();
  const {processInfo} = await session.send('SystemInfo.getProcessInfo');
  const sizes = processInfo.filter(({type}) => type === 'renderer').map(({id}) => {
    const kilobytes = /^Pss:\s+(\d+) kB/m.exec(readFileSync(`/proc/${id}/smaps_rollup`, 'utf8'));
    return 1024 * Number(kilobytes[1]);
  });
  return Math.max(...sizes);
}

// What axe-core finds, a line each; a frame is looked at by itself. A phone shows the colours of the light look, and the
// contrast of colours is what takes longest.
export async function barriers(page, look = 'light') {
  await page.evaluate(axeSource);
  const found = await page.evaluate((contrast) => globalThis.axe.run(
      document, {iframes: false, rules: {'color-contrast': {enabled: contrast}}}), look !== 'phone');
  return found.violations.flatMap((violation) => violation.nodes.map(
      (node) => `${violation.id}: ${node.target.join(' ')}: ${node.failureSummary}`));
}

// The embedded JSON of a page.
export const embedded = (page, id = 'record') => page.evaluate((name) => lyrefit.data(name), id);

// The cells of the table below a heading, the row of its head last.
export const cells = (page, heading) => page.evaluate((words) => {
  const section = [...document.querySelectorAll('section')].find(
      (each) => each.querySelector('h2, h3')?.textContent.startsWith(words));
  return [...section.querySelectorAll('tbody tr')].map(
      (row) => [...row.cells].map((cell) => cell.textContent));
}, heading);

// Whether a text is the number, to the digits that it has.
export function assertSays(text, value, what) {
  const digits = text.replace(/[^0-9.e+-]/g, '').replace(/e.*/, '').replace(/[-+.]/g, '')
                     .replace(/^0+/, '').length;
  const shown = Number(text.replace(/[^0-9.e+-]/g, ''));
  const unit = 10 ** (Math.floor(Math.log10(Math.abs(value) || 1)) + 1 - Math.max(1, digits));
  assert.ok(Math.abs(shown - value) <= 0.51 * unit, `${what}: page says ${text}, data ${value}`);
}
