// The panel of one string, and the start of the page.

// A link to a path below the results' folder. Empty for any other path, since rows come from files and may hold any
// text.
const results = JSON.parse(document.getElementById("results").textContent);
function pageOf(path) {
  if (typeof path !== "string" || !path || path.split("/").some((part) => part === "..")) return null;
  return `./${results}` + path.split("/").map(encodeURIComponent).join("/");
}

async function showRow(row) {
  const cells = await loadRow(row);
  const title = cells.id || `row ${row + 1}`;
  const link = has("page") ? pageOf(cells.page) : null;
  const sparklines = has("sparkline") && cells.sparkline ? await load("sparkline") : null;
  const median = sparklines && cells.id ? await groupMedian(cells.id, sparklines) : null;
  const lines = columnNames.filter((name) => name !== "sparkline").map((name) => {
    const value = cells[name];
    const known = value !== null && value !== undefined && !Number.isNaN(value);
    return [name, known ? (columnOf(name).type === "truth" ? (value ? "yes" : "no") : String(value)) : "not known", columnOf(name).doc || ""];
  });
  const dialog = byId("detail");
  dialog.replaceChildren(
    make("div", { class: "dialog-head" }, make("h2", { id: "detail-h" }, title),
      make("button", { type: "button", onclick: () => dialog.close() }, "Close")),
    ...[cells.cause_sentence, cells.reason].filter(Boolean).map((text) => make("p", {}, text)),
    link ? make("p", {}, make("a", { href: link }, "The page of this string")) : "",
    sparklines ? make("figure", {}, sparklinePicture(sparklineOf(cells.sparkline), median, 320, 170), make("figcaption", {},
      "Current over V / Voc, in parts of its largest" + (median ? "; dashed the median of its group." : "."))) : "",
    plainTable("All that is known of it", ["Column", "Value", "What it is"], lines));
  dialog.showModal();
  dialog.scrollTop = 0;
}

// Turns the row names of the static tables into buttons that filter.
function makeTableButtons() {
  for (const line of document.querySelectorAll("tr[data-column]")) {
    const { column, value } = line.dataset;
    if (!has(column)) continue;
    const cell = line.querySelector("th");
    const text = cell.lastChild;
    text.replaceWith(make("button", { type: "button", class: "link", onclick: () => pick(column, value) }, text.textContent.trim()));
  }
}

// The first of these columns that holds texts, or numbers known for at least half of the strings.
async function firstKnown(names) {
  for (const name of names) {
    const values = await valuesOf(name);
    if (!(values instanceof Float64Array)) return name;
    if (2 * values.reduce((known, value) => known + (Number.isNaN(value) ? 0 : 1), 0) >= rowCount) return name;
  }
  return names[0] || columnNames[0];
}

async function chooseDefaults() {
  const first = (names) => names.filter(isNumber)[0] || numberColumns[0] || null;
  const colours = colourChoices();
  // With many strings a cell almost always holds a bad one, so the map shows the need of work.
  map.colour = rowCount > 20000 && colours.includes(needsWork) ? needsWork : await firstKnown(colours);
  map.statistic = worstFirst(map.colour) ? "lowest" : "mean";
  charts.worstBy = worstChoices()[0] || null;
  charts.spread = ["performance_factor", "Pmax_stc_W", "FF", "Rs_ohm", "irradiance_Wm2", "temperature_C", "Pmax_W", "Voc_V", "Isc_A", ...numberColumns]
    .filter((name, i, all) => isNumber(name) && all.indexOf(name) === i).slice(0, 6);
  charts.x = first(["irradiance_Wm2", "Voc_V"]);
  charts.y = first(["Pmax_stc_W", "Pmax_W", "performance_factor"]);
  if (charts.x === charts.y) charts.y = numberColumns[1] || charts.x;
  charts.by = wordColumns()[0] || "none";
  charts.trend = first(["performance_factor", "Pmax_stc_W", "FF", "Pmax_W"]);
}

// Folds the table of the worst strings, since the script draws them. On paper the table is complete.
function foldWorst() {
  const still = byId("still-worst");
  if (!has("sparkline") || !still.firstElementChild) return;
  still.before(folded("The same as a table", still.firstElementChild.cloneNode(true)));
  still.classList.add("drawn");
}

let drawing = 0;

// Draws one section after the other, so that the page stays responsive. A changed filter restarts the drawing.
async function drawAll() {
  const turn = ++drawing;
  for (const draw of [drawMap, drawWorst, drawSpread, drawCloud, drawTrend]) {
    await new Promise((resolve) => setTimeout(resolve));
    if (turn !== drawing) return;
    await draw();
  }
}

async function start() {
  document.documentElement.classList.add("scripted");
  document.body.append(make("dialog", { id: "detail", "aria-labelledby": "detail-h" }));
  await chooseDefaults();
  await makeFilters();
  makeTable();
  makeTableButtons();
  foldWorst();
  await makeTree();
  listeners.push(drawAll);
  await applyFilters();
  let waiting = 0;
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth === width) return;
    width = window.innerWidth;
    clearTimeout(waiting);
    waiting = setTimeout(drawAll, 200);
  });
  lyrefit.onTheme(drawAll);
  document.documentElement.dataset.ready = "yes";
}

start();
