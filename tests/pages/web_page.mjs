// What the tests of the page that needs no server share: the browser, files, drops, results, and the command's record.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {basename, join} from 'node:path';
import {after, before} from 'node:test';

import {chartsReady, kHangs_ms, launch, open} from './browser.mjs';

export const {PAGE, APP, CHROMIUM, DATA, OUT} = process.env;
export const out = (name) => join(OUT, name);
export const kFiles = {
  rtc: ['rtc_france.csv', 'rtc_france.json'].map((name, i) => [name, `${DATA}/rtc_france/curve.${['csv', 'json'][i]}`]),
  shaded: ['csv', 'json'].map((end) => [`shaded_module.${end}`, `${DATA}/diagnosis/shaded_module.${end}`]),
  cell: ['pair', 'lit_dark', 'suns'].flatMap((name) => ['csv', 'json'].map((end) => [`${name}.${end}`, `${DATA}/cell/${name}.${end}`]))
            .filter(([, path]) => existsSync(path)),
  tracer: [['tracer.csv', `${DATA}/formats/head_tracer.csv`]],
};
// The command works in other vectors of the processor and with another C library, so that its last digits may differ.
// Numbers agree within this part of themselves, but for those whose size says nothing of their error: how far a
// likelihood ratio lies in a tail, which magnifies what its logarithm misses, what is zero but for rounding, and quotients of
// differences, which have the rounding of what they subtract. An estimate agrees within a thousandth of its interval: readings
// moved by 1e-13 of themselves move that of an effect of no size by a ten-thousandth.
const kSameDigits = 1e-6;
const kTails = {p_value: 1e-4, corrected_p: 1e-4, log_evidence: 1e-3, probability: 1e-2, probability_material: 1e-4,
                held_out_rmse_A: 1e-5};  // in parts of themselves
const kOfInterval = 1e-3;
const kZeros = {misfit: 1e-5, mean_A: 1e-12, projected_gradient: 1e-8, sensitivity: 1e-9, contribution: 1e-9, share: 1e-9};  // in their own units

export let browser;
before(async () => {
  mkdirSync(OUT, {recursive: true});
  browser = await launch(CHROMIUM);
});
after(() => browser?.close());

export async function begin(look) {
  const opened = await open(browser, PAGE, look);
  await opened.page.waitForSelector('html[data-engine=ready]', {state: 'attached'});
  return opened;
}

// Drops files as a person would: by what a browser hands over.
export async function drop(page, files) {
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

export const dropText = (page, name, text) => {
  writeFileSync(out(`drop_${name}`), text);
  return drop(page, [[name, out(`drop_${name}`)]]);
};

// What is below may move while files are read and pictures are drawn, so that a click could miss it: a key does not.
export const openOptions = (page, of = 'the fit') => page.press(`text=Options of ${of}`, 'Enter');

export async function work(page, verb) {
  await page.waitForFunction(() => lyrefitPage.looking() === 0);
  const before = await page.evaluate(() => lyrefitPage.finished());
  await page.press(`[data-verb=${verb}]`, 'Enter');
  await page.waitForFunction((count) => lyrefitPage.finished() > count, before);
}

export const report = async (page) => {
  const frame = await (await page.waitForSelector('#report iframe')).contentFrame();
  await chartsReady(frame);
  return frame;
};

export async function saved(page, what) {
  const waiting = page.waitForEvent('download');
  await page.click(`[data-save=${what}]`);
  const download = await waiting;
  return {name: download.suggestedFilename(), text: readFileSync(await download.path(), 'utf8')};
}

// The JSON that the command writes of the same files with the same words. `named`: the files among them that it is given.
export function commanded(files, verb, flags = [], named = files.slice(0, 1).map(([name]) => name)) {
  const folder = out(`command_${verb}_${basename(files[0]?.[0] ?? 'none', '.csv')}`);
  rmSync(folder, {recursive: true, force: true});
  mkdirSync(folder, {recursive: true});
  for (const [name, path] of files) writeFileSync(join(folder, name), readFileSync(path));
  execFileSync(APP, [verb, ...named, ...flags, '--quiet', '--force', '--json', 'command.out'],
               {cwd: folder, timeout: kHangs_ms});
  return JSON.parse(readFileSync(join(folder, 'command.out'), 'utf8'));
}

const pick = (from, keys) => Object.fromEntries(keys.map((key) => [key, from[key]]));

// Two records of one measurement: everything that is no number has to be the same, and numbers within what is said
// above. The largest difference of those that have no limit of their own, in parts of the larger.
export function compare(one, other, path = '', key = '') {
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
  const ends = ['value', 'low_95', 'high_95'];
  if (ends.every((end) => typeof one[end] === 'number' && typeof other[end] === 'number')) {
    const width = one.high_95 - one.low_95;
    const near = (end) => Math.abs(one[end] - other[end]) <= kOfInterval * width;
    if (width > 0 && ends.every(near)) one = {...one, ...pick(other, ends)};
  }
  return Object.keys(one).map((each) => compare(one[each], other[each], `${path}.${each}`, each))
      .reduce((worst, each) => (each.part > worst.part ? each : worst), nothing);
}
