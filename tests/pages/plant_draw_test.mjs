// What the plant's page draws with, without a browser:
//   ASSETS=lib/lyrefit/batch/assets node --test plant_draw_test.mjs
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

const script = readFileSync(join(process.env.ASSETS, 'plant_draw.js'), 'utf8');
const {areApart, axisOf, axisOfKnown, csvField} =
    new Function(`${script}; return {areApart, axisOf, axisOfKnown, csvField};`)();

// `value` and the next numbers above it, in ascending order.
const ulps = (value, count) => {
  const bits = new BigInt64Array(new Float64Array([value]).buffer)[0];
  const all = Array.from({length: count}, (_, i) => new Float64Array(new BigInt64Array([bits + BigInt(i)]).buffer)[0]);
  return Float64Array.from(all).sort();
};

test('values that are equal to rounding have an axis around them', () => {
  for (const value of [0.7741935483870968, 8.4936, -40.1, 1e-12, 300, 2.5e8, 0]) {
    for (const count of [1, 2, 3, 30, 1000]) {
      const values = ulps(value, count);
      const axis = axisOfKnown(values, 5);
      assert.ok(axis.high > axis.low, `${value} ${count}: ${JSON.stringify(axis)}`);
      assert.ok(axis.low < values[0] && axis.high > values[count - 1], `${value} ${count}: ${JSON.stringify(axis)}`);
      assert.ok(axis.ticks.length >= 3 && new Set(axis.ticks).size === axis.ticks.length, JSON.stringify(axis));
      for (const v of values) assert.ok(Number.isFinite((v - axis.low) / (axis.high - axis.low)));
    }
  }
});

test('values that differ by little more than rounding are drawn apart', () => {
  const axis = axisOf(1, 1 + 1e-6, 5);
  assert.ok(axis.high - axis.low < 3e-6 && axis.ticks.length >= 4, JSON.stringify(axis));
  assert.ok(areApart(1, 1 + 1e-6));
  assert.ok(!areApart(1, 1 + 1e-15));
  assert.ok(!areApart(5, 5));
  assert.ok(areApart(0, 1e-290));
  assert.ok(areApart(-1, 0));
});

test('a table holds no formulas, and numbers as they are', () => {
  for (const text of ['=1+1', '+1+1', '-1-1', '@SUM(1)', "=cmd|' /C calc'!A0", '\t=1', ' =1', '\tx', '--1', '-x', "'=1",
                      '-1e', '\uff1d1']) {
    assert.equal(csvField(text), `'${text}`);
  }
  for (const text of ['', 'str 1', '-0.5', '+49', '-1e-5', '-.5', '-5.', '1-1', 'a=b', '-', '+', "it's", "'-0.5"]) {
    assert.equal(csvField(text), text);
  }
  assert.equal(csvField('=a,b'), '"\'=a,b"');
  assert.equal(csvField('a"b'), '"a""b"');
  assert.equal(csvField(-0.5), '-0.5');
  assert.equal(csvField(-1e-7), '-1e-7');
  assert.equal(csvField(NaN), '');
  assert.equal(csvField(null), '');
});
