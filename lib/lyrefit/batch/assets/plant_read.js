// Reads the table inside the page; plant_table.h describes the format. A column is unpacked on first use.
'use strict';

const index = JSON.parse(document.getElementById("table").textContent);
const columns = index.columns;
const columnNames = columns.map((column) => column.name);
const rowCount = index.groups.reduce((sum, group) => sum + group.rows, 0);
const groupElements = document.getElementsByClassName("rows");
const columnCache = new Map();

const has = (name) => columnNames.includes(name);
const columnOf = (name) => columns[columnNames.indexOf(name)];
const isNumber = (name) => has(name) && ["number", "whole"].includes(columnOf(name).type);
const numberColumns = columnNames.filter(isNumber);

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// A reader of codes. The bytes of code r are at r, n + r, 2n + r, ... after `from`.
function codeReader(bytes, from, n, width) {
  if (width === 1) return (r) => bytes[from + r];
  return (r) => {
    let code = 0;
    for (let plane = width - 1; plane >= 0; plane--) code = code * 256 + bytes[from + plane * n + r];
    return code;
  };
}

function readDoubles(bytes, n, put) {
  const eight = new DataView(new ArrayBuffer(8));
  for (let r = 0; r < n; r++) {
    for (let plane = 0; plane < 8; plane++) eight.setUint8(plane, bytes[1 + plane * n + r]);
    put(r, eight.getFloat64(0, true));
  }
}

function readDecimals(bytes, n, put) {
  const scale = Number("1e" + bytes[1]);
  const code = codeReader(bytes, 3, n, bytes[2]);
  for (let r = 0; r < n; r++) {
    const z = code(r) - 1;
    put(r, z < 0 ? NaN : (z % 2 === 0 ? z / 2 : -(z + 1) / 2) / scale);
  }
}

function readWords(bytes, n, put) {
  const length = new DataView(bytes.buffer).getUint32(2, true);
  const words = JSON.parse(new TextDecoder().decode(bytes.subarray(6, 6 + length)));
  const code = codeReader(bytes, 6 + length, n, bytes[1]);
  for (let r = 0; r < n; r++) put(r, words[code(r)]);
}

async function readPart(group, column, put) {
  const { parts, rows } = index.groups[group];
  let from = 0;
  for (let c = 0; c < column; c++) from += parts[c];
  const text = groupElements[group].textContent.substr(from, parts[column]);
  const bytes = await inflated(bytesOfBase64(text));
  if (bytes[0] === 0) return readDoubles(bytes, rows, put);
  if (bytes[0] === 1) return readDecimals(bytes, rows, put);
  if (bytes[0] === 3) return readWords(bytes, rows, put);
  JSON.parse(new TextDecoder().decode(bytes.subarray(1))).forEach((text, r) => put(r, text));
}

// All values of a column: numbers (NaN: unknown) or texts (null: unknown). Truth values are 0 and 1.
function load(name) {
  if (!columnCache.has(name)) columnCache.set(name, loadNow(name));
  return columnCache.get(name);
}

async function loadNow(name) {
  const column = columnNames.indexOf(name);
  const values = columns[column].type === "text" ? new Array(rowCount) : new Float64Array(rowCount);
  let first = 0;
  for (let group = 0; group < index.groups.length; group++) {
    const at = first;
    await readPart(group, column, (r, value) => (values[at + r] = value));
    first += index.groups[group].rows;
  }
  return values;
}

const loadAll = (names) => Promise.all(names.map(load));

// The existing ones of these columns, by name.
async function loadWhere(names) {
  const there = names.filter(has);
  const values = await loadAll(there);
  return Object.fromEntries(there.map((name, i) => [name, values[i]]));
}

// All cells of one row. Only the group of the row is unpacked.
async function loadRow(row) {
  let group = 0;
  let first = 0;
  while (row >= first + index.groups[group].rows) first += index.groups[group++].rows;
  const cells = {};
  for (let column = 0; column < columns.length; column++) {
    await readPart(group, column, (r, value) => {
      if (first + r === row) cells[columnNames[column]] = value;
    });
  }
  return cells;
}
