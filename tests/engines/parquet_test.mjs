// apps/slurm/parquet.sql on the results in the working folder: the Parquet file has the columns and types of
// the schema, and every value of results.jsonl.
import { DuckDBInstance } from '@duckdb/node-api';
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

const duckdb = await (await DuckDBInstance.create(':memory:')).connect();
const rowsOf = async (query) => (await duckdb.runAndReadAll(query)).getRowObjects();

await duckdb.run(readFileSync(process.argv[2], 'utf8'));

const parquetTypes = { string: 'VARCHAR', number: 'DOUBLE', integer: 'BIGINT', boolean: 'BOOLEAN' };
const { fields } = JSON.parse(readFileSync('results.schema.json', 'utf8'));
const described = await rowsOf("DESCRIBE FROM 'results.parquet'");
assert.deepEqual(
  described.map((column) => [column.column_name, column.column_type]),
  fields.map((field) => [field.name, parquetTypes[field.type]]));
for (const type of ['string', 'number', 'integer']) {
  assert(fields.some((field) => field.type === type), `no column of type ${type} to look at`);
}

const stored = await rowsOf("FROM 'results.parquet'");
const written = readFileSync('results.jsonl', 'utf8').trimEnd().split('\n').map((line) => JSON.parse(line));
assert.equal(stored.length, written.length);
let values = 0;
written.forEach((row, i) => {
  for (const { name, type } of fields) {
    const value = stored[i][name];
    assert.equal(type === 'integer' && value !== null ? Number(value) : value, row[name] === '' ? null : row[name],
      `row ${i + 1}, ${name}`);
    values += value !== null;
  }
});
assert(values > 10 * written.length, 'hardly a value is there');
console.log(`${written.length} rows of ${fields.length} columns, ${values} values: the same in Parquet`);
