// Selection of the shown rows by filters, and the table of these rows.

const state = {
  text: "",
  node: null,          // of the tree; only its strings are shown
  picks: new Map(),    // column -> the only value shown
  ranges: [],          // { name, low, high }
  rows: null,          // the shown rows, in the order of the input
  sort: { name: null, down: false },
  page: 0,
  pageRows: 25,
  visible: [],
};
const listeners = [];  // called when the shown rows change

function defaultColumns() {
  const wanted = ["id", "page", "status", "zone", "cause_title", "performance_factor", "Pmax_stc_W", "Pmax_stc_U_W",
    "group_deviation_percent", "recoverable_power_W", "group_outlier", "date"];
  if (!has("cause_title")) wanted.splice(4, 0, "cause");
  const there = wanted.filter(has);
  const others = ["Pmax_W", "FF", "Isc_A", "Voc_V", "Rs_ohm", "n1", "irradiance_Wm2", "temperature_C", "reason"].filter(has);
  for (const name of [...others, ...columnNames]) {
    if (there.length >= 11) break;
    if (!there.includes(name) && name !== "sparkline") there.push(name);
  }
  return there;
}

async function applyFilters() {
  const names = [...state.picks.keys(), ...state.ranges.map((range) => range.name)];
  const values = await loadWhere([...names, ...(state.text && has("id") ? ["id"] : [])]);
  const text = state.text.toLowerCase();
  const tests = [];
  if (text && values.id) tests.push((r) => (values.id[r] || "").toLowerCase().includes(text));
  for (const [name, wanted] of state.picks) tests.push((r) => (values[name][r] ?? "") === wanted);
  for (const { name, low, high } of state.ranges) {
    tests.push((r) => values[name][r] >= (low ?? -Infinity) && values[name][r] <= (high ?? Infinity));
  }
  const among = state.node ? Uint32Array.from(rowsOf(state.node)).sort() : Uint32Array.from({ length: rowCount }, (_, r) => r);
  state.rows = tests.length ? among.filter((r) => tests.every((test) => test(r))) : among;
  state.page = 0;
  byId("live-state").textContent = state.rows.length === rowCount
    ? `All ${counted(rowCount)} strings are shown.` : `${counted(state.rows.length)} of ${counted(rowCount)} strings are shown.`;
  drawChips();
  for (const listener of listeners) await listener();
}

function pick(name, value) {
  if (value === null) state.picks.delete(name);
  else state.picks.set(name, value);
  return applyFilters();
}

function chip(text, remove) {
  return make("li", {}, make("button", { type: "button", "aria-label": `Remove the filter ${text}`,
    onclick: () => { remove(); byId("search")?.focus(); applyFilters(); } }, text, " ×"));
}

function drawChips() {
  const chips = [];
  if (state.text) chips.push(chip(`id holds “${state.text}”`, () => { state.text = byId("search").value = ""; }));
  if (state.node) chips.push(chip(`below ${pathOf(state.node)}`, () => { state.node = null; }));
  for (const [name, value] of state.picks) {
    chips.push(chip(`${name} is ${value || "not known"}`, () => state.picks.delete(name)));
  }
  state.ranges.forEach((range, i) => chips.push(chip(
    `${range.low ?? ""} ≤ ${range.name} ≤ ${range.high ?? ""}`, () => state.ranges.splice(i, 1))));
  byId("chips").replaceChildren(...chips);
  for (const box of document.querySelectorAll("select[data-pick]")) {
    box.value = state.picks.has(box.dataset.pick) ? JSON.stringify(state.picks.get(box.dataset.pick)) : "";
  }
}

// The different values of a column with their counts, by decreasing count.
async function wordsOf(name, most) {
  const counts = new Map();
  for (const value of await load(name)) counts.set(value ?? "", (counts.get(value ?? "") || 0) + 1);
  return [...counts].sort((a, b) => b[1] - a[1]).slice(0, most);
}

async function pickBox(name) {
  const words = await wordsOf(name, 100);
  const box = make("select", { "data-pick": name,
    onchange: () => pick(name, box.value === "" ? null : JSON.parse(box.value)) },
    make("option", { value: "" }, "any"),
    words.map(([word, count]) => make("option", { value: JSON.stringify(word) }, `${word || "not known"} (${counted(count)})`)));
  return make("label", { class: "control" }, make("span", {}, name), box);
}

function rangeForm() {
  let name = numberColumns[0];
  const low = make("input", { type: "number", step: "any", id: "range-low" });
  const high = make("input", { type: "number", step: "any", id: "range-high" });
  return make("form", { class: "controls", onsubmit: (event) => {
    event.preventDefault();
    if (low.value === "" && high.value === "") return;
    state.ranges.push({ name, low: low.value === "" ? null : Number(low.value), high: high.value === "" ? null : Number(high.value) });
    low.value = high.value = "";
    applyFilters();
  } },
  select("Number", numberColumns, name, (chosen) => { name = chosen; }),
  make("label", { class: "control" }, make("span", {}, "from"), low),
  make("label", { class: "control" }, make("span", {}, "to"), high),
  make("button", { type: "submit" }, "Add filter"));
}

async function makeFilters() {
  let waiting = 0;
  const search = make("input", { type: "search", id: "search", oninput: () => {
    clearTimeout(waiting);
    waiting = setTimeout(() => { state.text = search.value.trim(); applyFilters(); }, 150);
  } });
  const boxes = await Promise.all(wordColumns().map(pickBox));
  byId("live-filter").replaceChildren(make("div", { class: "toolbox", role: "search", "aria-label": "Which strings are shown" },
    make("div", { class: "controls" },
      has("id") ? make("label", { class: "control" }, make("span", {}, "id holds"), search) : null,
      boxes),
    numberColumns.length ? folded("Filter by a number", rangeForm()) : null,
    make("ul", { id: "chips", "aria-label": "Filters" })));
}

// Unknown values come last in both directions.
async function sortedRows() {
  const { name, down } = state.sort;
  if (!name) return state.rows;
  const values = await load(name);
  const sign = down ? -1 : 1;
  const unknown = (value) => value === null || Number.isNaN(value);
  const order = new Intl.Collator(undefined, { numeric: true }).compare;
  const text = columnOf(name).type === "text";
  const less = text && rowCount <= 50000 ? order : (a, b) => (a < b ? -1 : a > b ? 1 : 0);
  return state.rows.slice().sort((a, b) => {
    const one = values[a];
    const other = values[b];
    if (unknown(one) || unknown(other)) return (unknown(one) ? 1 : 0) - (unknown(other) ? 1 : 0) || a - b;
    return sign * less(one, other) || a - b;
  });
}

function sortBy(name) {
  const { sort } = state;
  state.sort = { name, down: sort.name === name ? !sort.down : false };
  state.page = 0;
  return drawTable(name);
}

function headCell(name) {
  const { sort } = state;
  const direction = sort.name !== name ? "none" : sort.down ? "descending" : "ascending";
  const sign = { none: "↕", descending: "↓", ascending: "↑" }[direction];
  const { doc, unit } = columnOf(name);
  return make("th", { scope: "col", "aria-sort": direction, class: isNumber(name) ? "number" : null },
    make("button", { type: "button", class: "sort", "data-sort": name, title: [doc, unit].filter(Boolean).join(", ") || null,
      onclick: () => sortBy(name) }, breakable(name), make("span", { "aria-hidden": "true" }, ` ${sign}`)));
}

function bodyCell(name, value, row, first, write) {
  const text = write ? write(value) : shownText(name, value);
  const zone = name === "zone" && zoneOf(value);
  const mark = zone ? make("span", { class: `mark z${zones.indexOf(zone)}`, "aria-hidden": "true" }, zone.sign) : null;
  const full = typeof value === "number" && !Number.isNaN(value) ? String(value) : null;
  if (first) {
    return make("th", { scope: "row" }, make("button", { type: "button", class: "link", onclick: () => showRow(row) }, text || `row ${row + 1}`));
  }
  const link = name === "page" && pageOf(value);
  if (link) return make("td", {}, make("a", { href: link }, "page"));
  return make("td", { class: isNumber(name) ? "number" : null, title: full }, mark, text);
}

async function drawTable(focus) {
  const rows = await sortedRows();
  const pages = Math.max(1, Math.ceil(rows.length / state.pageRows));
  state.page = Math.min(Math.max(state.page, 0), pages - 1);
  const from = state.page * state.pageRows;
  const some = rows.subarray(from, from + state.pageRows);
  const values = await loadAll(state.visible);
  const writers = state.visible.map((name, c) => (isNumber(name) ? writerOf(Array.from(some, (row) => values[c][row])) : null));
  const body = Array.from(some, (row) => make("tr", {}, state.visible.map((name, c) => bodyCell(name, values[c][row], row, c === 0, writers[c]))));
  byId("table-head").replaceChildren(make("tr", {}, state.visible.map(headCell)));
  byId("table-body").replaceChildren(...body);
  byId("table-place").textContent = rows.length
    ? `${counted(from + 1)} to ${counted(from + some.length)} of ${counted(rows.length)}` : "no string fits the filters";
  byId("page-back").disabled = state.page === 0;
  byId("page-on").disabled = state.page === pages - 1;
  if (focus) document.querySelector(`[data-sort="${CSS.escape(focus)}"]`)?.focus();
}

async function csvOfShown() {
  const rows = await sortedRows();
  const values = await loadAll(columnNames);
  const lines = [columnNames.map(csvField).join(",")];
  for (const row of rows) lines.push(values.map((column) => csvField(column[row])).join(","));
  const url = URL.createObjectURL(new Blob([lines.join("\n") + "\n"], { type: "text/csv" }));
  lyrefit.save(lyrefit.fileName("csv"), url);
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

function columnChoice() {
  const box = (name) => {
    const input = make("input", { type: "checkbox", checked: state.visible.includes(name), onchange: () => {
      state.visible = columnNames.filter((other) => other === name ? input.checked : state.visible.includes(other));
      if (state.visible.length === 0) state.visible = [name];
      drawTable();
    } });
    return make("label", { class: "tick" }, input, " ", breakable(name));
  };
  return folded("Columns", make("div", { class: "ticks", role: "group", "aria-label": "Columns of the table" }, columnNames.map(box)));
}

function makeTable() {
  state.visible = defaultColumns();
  const turn = (by) => { state.page += by; drawTable(); };
  byId("live-table").replaceChildren(
    columnChoice(),
    make("div", { class: "box", role: "region", tabindex: 0, "aria-label": "Table of all strings" },
      make("table", { id: "all" },
        make("caption", {}, "A row a string; a head sorts, a name opens all that is known of it."),
        make("thead", { id: "table-head" }), make("tbody", { id: "table-body" }))),
    make("div", { class: "controls pager" },
      make("button", { type: "button", id: "page-back", onclick: () => turn(-1) }, "Previous"),
      make("span", { id: "table-place", role: "status" }),
      make("button", { type: "button", id: "page-on", onclick: () => turn(1) }, "Next"),
      select("Rows a page", ["25", "50", "100"], "25", (rows) => { state.pageRows = Number(rows); state.page = 0; drawTable(); }),
      make("button", { type: "button", onclick: csvOfShown }, "Save these rows as CSV")));
  listeners.push(() => drawTable());
}
