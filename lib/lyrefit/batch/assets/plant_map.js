// The plant's tree, from the '/' in the ids, and its heat map.

const tree = { name: "", parent: null, children: null, rows: [], count: 0 };
const map = { node: tree, colour: null, statistic: "mean", cells: [] };
const mostCells = 6000;
const mostLines = 120;
const needsWork = "share that needs work";

function childOf(node, name) {
  node.children = node.children || new Map();
  let child = node.children.get(name);
  if (!child) {
    child = { name, parent: node, children: null, rows: [], count: 0 };
    node.children.set(name, child);
  }
  return child;
}

async function makeTree() {
  if (!has("id")) return;
  const ids = await load("id");
  const places = new Map();  // path -> node
  for (let row = 0; row < rowCount; row++) {
    const id = ids[row] || "";
    const slash = id.lastIndexOf("/");
    const path = slash < 0 ? "" : id.slice(0, slash);
    let node = places.get(path);
    if (!node) {
      node = path === "" ? tree : path.split("/").reduce(childOf, tree);
      places.set(path, node);
    }
    node.rows.push(row);
  }
  const count = (node) => {
    node.count = node.rows.length;
    for (const child of node.children ? node.children.values() : []) node.count += count(child);
    return node.count;
  };
  count(tree);
}

const pathOf = (node) => (node.parent ? (node.parent.parent ? pathOf(node.parent) + "/" : "") + node.name : "the plant");
const childrenOf = (node) => (node.children ? [...node.children.values()] : []);

function rowsOf(node, into = []) {
  for (const row of node.rows) into.push(row);
  for (const child of childrenOf(node)) rowsOf(child, into);
  return into;
}

// The rows with the same parent as this id.
function siblingsOf(id) {
  const names = (id || "").split("/").slice(0, -1);
  const node = names.reduce((at, name) => at?.children?.get(name), tree);
  return node ? node.rows : [];
}

// Lines of the map: the nodes `depth` below this one, or the end of a shorter branch. Strings directly below an
// intermediate node form a separate line.
function nodesAt(node, depth, name = "") {
  if (depth === 0 || !node.children) return [{ name, node, rows: null }];
  const own = node.rows.length ? [{ name, node, rows: node.rows }] : [];
  return own.concat(childrenOf(node).flatMap((child) => nodesAt(child, depth - 1, name ? `${name}/${child.name}` : child.name)));
}

const singles = (rows) => Array.from(rows, (row) => ({ node: null, rows: [row] }));

// Cells of a line: strings, or the nodes `depth` below the line's node.
function cellsOf(line, depth) {
  if (depth === null || line.rows) return singles(line.rows || rowsOf(line.node));
  return nodesAt(line.node, depth).map((cell) => ({ node: cell.node, rows: cell.rows || rowsOf(cell.node) }));
}

function deepest(node) {
  return node.children ? 1 + Math.max(...childrenOf(node).map(deepest)) : 0;
}

// The finest cells and lines whose number is not too large.
function linesOf(node) {
  const depths = Array.from({ length: deepest(node) + 1 }, (_, depth) => depth);
  const few = (depth, most) => depth >= 0 && nodesAt(node, depth).length <= most;
  const strings = node.count <= mostCells;
  const cellDepth = strings ? null : depths.filter((depth) => few(depth, mostCells)).pop();
  if (cellDepth === 0) return { lines: [{ name: "", cells: blocksOf(node) }], what: "a block of strings in their order" };
  const lineDepth = depths.filter((depth) => few(depth, mostLines) && (strings || depth < cellDepth)).pop() ?? 0;
  const lines = nodesAt(node, lineDepth).map((line) => ({ name: line.name,
    cells: cellsOf(line, strings ? null : cellDepth - lineDepth) }));
  return { lines, what: strings ? "a string" : "a part of the plant" };
}

function blocksOf(node) {
  const rows = rowsOf(node);
  const each = Math.ceil(rows.length / mostCells);
  const cells = [];
  for (let i = 0; i < rows.length; i += each) cells.push({ node: null, rows: rows.slice(i, i + each) });
  return cells;
}

// Columns in which low values are bad, and columns in which high values are bad.
const worstFirst = (name) => /performance_factor|deviation|Pmax|FF|history_p/.test(name);
const worstLast = (name) => name === needsWork || /departure|recoverable|wrong_decision/.test(name);

// 1 if a string needs work, by the rule of the summary; unknown if it could not be determined.
async function loadNeedsWork() {
  const { zone, cause, cause_about: about, status } = await loadWhere(["zone", "cause", "cause_about", "status"]);
  return Float64Array.from({ length: rowCount }, (_, row) => {
    if (status && status[row] && status[row] !== "fine") return NaN;
    if (zone) return zone[row] && !zone[row].startsWith("pass") ? 1 : 0;
    if (about && /^(sweep|instrument|conditions)$/.test(about[row])) return 0;
    return cause && !noCause(cause[row]) ? 1 : 0;
  });
}

const valuesOf = (name) => (name === needsWork ? loadNeedsWork() : load(name));

function colourChoices() {
  const words = wordColumns();
  const wanted = ["performance_factor", "group_deviation_percent", "Pmax_stc_W", "lack_of_fit_percent", "FF", "Pmax_W"].filter(isNumber);
  return [...wanted, ...(has("zone") || has("cause") ? [needsWork] : []), ...words, ...numberColumns.filter((name) => !wanted.includes(name))];
}

// Value of a cell: a number, or the count of each word in it.
function valueOf(cell, values, shown) {
  const rows = cell.rows.filter((row) => shown[row]);
  cell.shown = rows.length;
  if (values instanceof Float64Array) {
    const known = sortedKnown(values, rows);
    if (known.length === 0) return NaN;
    if (map.statistic === "lowest") return known[0];
    if (map.statistic === "highest") return known[known.length - 1];
    return known.reduce((sum, value) => sum + value, 0) / known.length;
  }
  const counts = new Map();
  for (const row of rows) counts.set(values[row] || "", (counts.get(values[row] || "") || 0) + 1);
  return counts;
}

function wordLooks(words) {
  const looks = new Map();
  let next = 1;
  for (const word of words) {
    const zone = map.colour === "zone" && zoneOf(word);
    if (zone) looks.set(word, zone);
    else if (word === "" || word === "fine" || noCause(word)) looks.set(word, { colour: word === "" && !map.colour.startsWith("cause") ? "#dddddd" : "#9CC9E8", sign: "" });
    else {
      looks.set(word, { colour: palette[next % palette.length], sign: signs[next % signs.length] });
      next++;
    }
  }
  return looks;
}

const inkOn = (colour) => {
  const [r, g, b] = colour.startsWith("#") ? [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16)) : colour.match(/\d+/g).map(Number);
  return 0.299 * r + 0.587 * g + 0.114 * b > 140 ? "#000" : "#fff";
};

function drawCell(context, cell, look) {
  const { x, y, w, h, value } = cell;
  if (cell.shown === 0) {
    context.strokeStyle = themeColour("--line");
    context.strokeRect(x + 0.5, y + 0.5, w - 1, h - 1);
    return;
  }
  if (value instanceof Map) {
    let top = y;
    for (const [word, count] of [...value].sort((a, b) => look.rank(a[0]) - look.rank(b[0]))) {
      context.fillStyle = look.of(word).colour;
      const part = (h * count) / cell.shown;
      context.fillRect(x, top, w, part);
      const sign = look.of(word).sign;
      if (sign && w >= 8 && part >= 9) {
        context.fillStyle = inkOn(look.of(word).colour);
        context.font = `${w < 12 ? 9 : 12}px system-ui, sans-serif`;
        context.fillText(sign, x + w / 2, top + part / 2 + 4);
      }
      top += part;
    }
    return;
  }
  const colour = look.of(value);
  context.fillStyle = colour || themeColour("--line");
  context.fillRect(x, y, w, h);
  const text = colour ? look.text(value) : "?";
  if (w < context.measureText(text).width + 4) return;
  context.fillStyle = colour ? inkOn(colour) : themeColour("--ink");
  context.fillText(text, x + w / 2, y + h / 2 + 4);
}

// Colour scale of numbers, from the middle 96 % of the drawn values. If low values are bad, it extends to the lowest,
// except outliers.
function numberLook(cells) {
  const known = Float64Array.from(cells.map((cell) => cell.value).filter(Number.isFinite)).sort();
  const high = quantile(known, 0.98);
  const bad = worstFirst(map.colour);
  const usual = quantile(known, 0.75) - quantile(known, 0.25);
  const low = bad && usual > 0 ? Math.max(known[0], quantile(known, 0.5) - 20 * usual) : quantile(known, 0.02);
  const share = (value) => (areApart(low, high) ? (value - low) / (high - low) : 0.3);
  return { low, high, bad,
    of: (value) => (Number.isNaN(value) ? null : shade(bad ? 1 - share(value) : share(value), bad || worstLast(map.colour) ? "bad" : "")),
    text: (value) => value.toFixed(Math.max(0, Math.min(4, 2 - Math.floor(Math.log10(high - low || 1))))) };
}

// Places cells in wrapped lines, and short lines side by side. Returns the height and the space for names.
function placeCells(lines, width) {
  const named = lines.length <= mostLines && lines.some((line) => line.name);
  const letters = Math.max(...lines.map((line) => line.name.length));
  const left = named ? Math.min(7 * letters + 14, 190, width * 0.3) : 0;
  const longest = Math.max(...lines.map((line) => line.cells.length), 1);
  const w = Math.max(9, Math.min(48, (width - left) / longest));
  const h = Math.max(14, Math.min(22, w));
  const across = Math.max(1, Math.floor((width - left) / w));
  const block = left + longest * w + 24;
  const columns = named && longest <= across ? Math.max(1, Math.min(Math.floor((width + 24) / block), Math.ceil(lines.length / 6))) : 1;
  const deep = Math.ceil(lines.length / columns);
  let height = 0;
  let y = 2;
  let x = 0;
  lines.forEach((line, i) => {
    if (named) x = 0;
    if (i % deep === 0) y = 2;
    line.x = Math.floor(i / deep) * block;
    line.y = y;
    for (const cell of line.cells) {
      if (x >= across) { x = 0; y += h + 1; }
      Object.assign(cell, { x: line.x + left + x * w, y, w: w - 1, h });
      x++;
    }
    height = Math.max(height, y + h + 4);
    if (named) y += h + 5;
  });
  return { height, left, named };
}

function legendOf(look, words) {
  const box = (colour, sign, text) => make("li", {}, make("span", { class: "swatch", style: `background:${colour};color:${inkOn(colour)}`, "aria-hidden": "true" }, sign), " ", text);
  if (words) return make("ul", { class: "keys" }, words.map((word) => box(look.of(word).colour, look.of(word).sign, word || "not known")));
  if (Number.isNaN(look.low)) return make("p", {}, `Nothing is known of ${map.colour} here.`);
  const steps = [0, 0.25, 0.5, 0.75, 1].map((share) => look.low + share * (look.high - look.low));
  return make("ul", { class: "keys" }, steps.map((value) => box(look.of(value), "", look.text(value))),
    map.cells.some((cell) => Number.isNaN(cell.value) && cell.shown > 0) ? make("li", {}, "?  not known") : null);
}

function childRows(values, shown) {
  const numeric = values instanceof Float64Array;
  const children = childrenOf(map.node).slice(0, 500);
  const rows = children.map((child) => {
    const own = rowsOf(child).filter((row) => shown[row]);
    const button = make("button", { type: "button", class: "link", onclick: () => zoomTo(child) }, child.name || "(no name)");
    if (!numeric) {
      const counts = [...valueOf({ rows: own }, values, shown)].sort((a, b) => b[1] - a[1]).slice(0, 4);
      return [button, String(own.length), counts.map(([word, count]) => `${count} ${word || "not known"}`).join(", ")];
    }
    const known = sortedKnown(values, own);
    const mean = known.reduce((sum, value) => sum + value, 0) / known.length;
    return [button, String(own.length), shortNumber(known[0]), shortNumber(mean), shortNumber(known[known.length - 1])];
  });
  const head = numeric ? ["Part", "Strings", "Lowest", "Mean", "Highest"] : ["Part", "Strings", map.colour];
  return plainTable(`${map.colour} below ${pathOf(map.node)}${map.node.children?.size > 500 ? ": the first 500 parts" : ""}`, head, rows);
}

function zoomTo(node) {
  map.node = node;
  return drawMap().then(() => byId("map-here")?.focus());
}

function crumbs() {
  const path = [];
  for (let node = map.node; node; node = node.parent) path.unshift(node);
  return make("nav", { "aria-label": "Where in the plant" }, make("ol", { class: "crumbs" }, path.map((node) =>
    make("li", {}, node === map.node
      ? make("strong", { id: "map-here", tabindex: -1, "aria-current": "true" }, `${node.parent ? node.name : "The plant"} (${counted(node.count)})`)
      : make("button", { type: "button", class: "link", onclick: () => zoomTo(node) }, node.parent ? node.name : "The plant")))));
}

const cellAt = (x, y) => map.cells.find((cell) => x >= cell.x && x <= cell.x + cell.w && y >= cell.y && y <= cell.y + cell.h);

async function cellText(cell) {
  const ids = await load("id");
  const name = cell.node ? pathOf(cell.node) : cell.rows.length === 1 ? ids[cell.rows[0]] : `${ids[cell.rows[0]]} and ${cell.rows.length - 1} more`;
  const value = cell.shown === 0 ? "not shown by the filters" : cell.value instanceof Map
    ? [...cell.value].map(([word, count]) => (cell.rows.length === 1 ? word || "not known" : `${count} ${word || "not known"}`)).join(", ")
    : `${map.colour} ${shortNumber(cell.value) || "not known"}`;
  return `${name}: ${value}`;
}

function follow(canvas, tip) {
  const at = (event) => cellAt(event.offsetX, event.offsetY);
  canvas.addEventListener("pointermove", async (event) => {
    const cell = at(event);
    canvas.style.cursor = cell ? "pointer" : "";
    tip.textContent = cell ? await cellText(cell) : " ";
  });
  canvas.addEventListener("click", (event) => {
    const cell = at(event);
    if (!cell) return;
    if (cell.rows.length === 1) showRow(cell.rows[0]);
    else if (cell.node && cell.node !== map.node) zoomTo(cell.node);
  });
}

// 1 at the rows that pass the filters.
function shownRows() {
  const shown = new Uint8Array(rowCount);
  for (const row of state.rows) shown[row] = 1;
  return shown;
}

async function drawMap() {
  const host = byId("live-map");
  byId("map").hidden = !has("id") || rowCount === 0;
  if (byId("map").hidden) return;
  const values = await valuesOf(map.colour);
  const shown = shownRows();
  const { lines, what } = linesOf(map.node);
  map.cells = lines.flatMap((line) => line.cells);
  for (const cell of map.cells) cell.value = valueOf(cell, values, shown);
  const words = values instanceof Float64Array ? null : [...new Set(map.cells.flatMap((cell) => [...cell.value.keys()]))].sort(
    (a, b) => (zones.findIndex((z) => z.name === a) + 9) % 9 - (zones.findIndex((z) => z.name === b) + 9) % 9 || (a < b ? -1 : 1));
  const looks = words && wordLooks(words);
  const look = words ? { of: (word) => looks.get(word), rank: (word) => words.indexOf(word) } : numberLook(map.cells);
  const width = Math.max(260, host.clientWidth);
  const place = placeCells(lines, width);
  const { canvas, context } = canvasOf(`Heat map of ${map.colour} below ${pathOf(map.node)}; the table below says the same`, width, place.height);
  context.textAlign = "left";
  context.fillStyle = themeColour("--ink");
  if (place.named) for (const line of lines) context.fillText(line.name, line.x, line.y + 13, place.left - 8);
  context.textAlign = "center";
  for (const cell of map.cells) drawCell(context, cell, look);
  const tip = make("p", { class: "tip", "aria-hidden": "true" }, " ");
  follow(canvas, tip);
  const only = map.node.parent ? make("button", { type: "button", onclick: () => { state.node = map.node; applyFilters(); } }, "Show only these strings in all sections") : null;
  host.replaceChildren(
    make("div", { class: "controls" }, select("Coloured by", colourChoices(), map.colour, (name) => { map.colour = name; map.statistic = worstFirst(name) ? "lowest" : "mean"; drawMap(); }),
      words || map.colour === needsWork ? null : select("of several strings the", ["lowest", "mean", "highest"], map.statistic, (name) => { map.statistic = name; drawMap(); })),
    crumbs(), make("div", { class: "controls" }, only),
    make("figure", {}, canvas, tip, make("figcaption", {}, `A cell is ${what}. A click opens it.`), legendOf(look, words)),
    map.node.children ? folded("The same as a table, to go deeper by keyboard", childRows(values, shown)) : null);
}
