// Drawing helpers of all sections.

const svgSpace = "http://www.w3.org/2000/svg";

function addTo(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

const make = (tag, attributes, ...children) => addTo(document.createElement(tag), attributes, children);
const makeSvg = (tag, attributes, ...children) =>
  addTo(document.createElementNS(svgSpace, tag), attributes, children);
const byId = (id) => document.getElementById(id);

// Colours of Okabe and Ito, each with a symbol.
const palette = ["#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7", "#F0E442", "#888888"];
const signs = ["●", "▲", "■", "✕", "◆", "+", "▼", "○"];
const zones = [
  { name: "pass", sign: "✓", point: "●", colour: "#0072B2" },
  { name: "pass within uncertainty", sign: "~", point: "■", colour: "#56B4E9" },
  { name: "fail within uncertainty", sign: "?", point: "▲", colour: "#E69F00" },
  { name: "fail", sign: "✕", point: "✕", colour: "#D55E00" },
  { name: "doubtful", sign: "!", point: "+", colour: "#CC79A7" },
];
const zoneOf = (name) => zones.find((zone) => zone.name === name);
const noCause = (cause) => !cause || ["none", "clean", "reference"].includes(cause);

const counted = (count) => count.toLocaleString("en");

// Columns with few different words, by which a picture can be coloured.
const wordColumns = () => ["zone", has("cause_title") ? "cause_title" : "cause", "status"].filter(has);

function shortNumber(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) return value.toExponential(3);
  return String(Number(value.toPrecision(5)));
}

// Formats numbers in a column, with as many decimals as the largest number needs.
function writerOf(values) {
  const sizes = Array.from(values, Math.abs).filter((size) => Number.isFinite(size) && size > 0);
  const largest = Math.max(...sizes, 0);
  if (largest === 0 || largest < 1e-3 || largest >= 1e7 || Math.min(...sizes) < largest * 1e-4) return shortNumber;
  if (sizes.every(Number.isInteger)) return (value) => (Number.isNaN(value) ? "" : String(value));
  const decimals = Math.max(0, 4 - Math.floor(Math.log10(largest)));
  return (value) => (Number.isNaN(value) ? "" : value.toFixed(decimals));
}

function shownText(name, value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  if (columnOf(name).type === "truth") return value ? "yes" : "no";
  return typeof value === "number" ? shortNumber(value) : String(value);
}

// A name that may be broken after its underscores.
const breakable = (name) => name.split(/(?<=_)/).flatMap((part) => [part, make("wbr")]);

function select(label, options, value, onchange) {
  const box = make("select", { onchange: () => onchange(box.value) },
    options.map((option) => make("option", { value: option, selected: option === value }, option)));
  return make("label", { class: "control" }, make("span", {}, label), box);
}

// A table of texts; the first cell of a row is its header.
function plainTable(caption, head, rows) {
  const numeric = head.map((_, c) => rows.length > 0 && rows.every((row) => typeof row[c] === "string" && !Number.isNaN(Number(row[c]))));
  return make("div", { class: "box", role: "region", tabindex: 0, "aria-label": caption },
    make("table", {}, make("caption", {}, caption),
      make("thead", {}, make("tr", {}, head.map((text, c) =>
        make("th", { scope: "col", class: numeric[c] ? "number" : null }, text)))),
      make("tbody", {}, rows.map((row) => make("tr", {}, row.map((text, c) =>
        c === 0 ? make("th", { scope: "row", class: numeric[c] ? "number" : null }, text)
                : make("td", { class: numeric[c] ? "number" : null }, text)))))));
}

const folded = (title, ...inner) => make("details", {}, make("summary", {}, title), inner);

// The known values at these rows, in ascending order.
function sortedKnown(values, rows) {
  const known = new Float64Array(rows.length);
  let n = 0;
  for (const row of rows) if (Number.isFinite(values[row])) known[n++] = values[row];
  return known.subarray(0, n).sort();
}

function quantile(sorted, share) {
  if (sorted.length === 0) return NaN;
  const place = share * (sorted.length - 1);
  const low = Math.floor(place);
  return sorted[low] + (place - low) * (sorted[Math.min(low + 1, sorted.length - 1)] - sorted[low]);
}

// True if two numbers, the smaller first, differ by more than rounding. Axis labels have at most 12 digits, and steps
// must be finite numbers.
const areApart = (low, high) => high - low > Math.max(1e-9 * Math.abs(low), 1e-9 * Math.abs(high), 1e-300);

// Ends and steps of an axis in round numbers: 1, 2 or 5 times a power of ten.
function axisOf(low, high, steps) {
  if (!areApart(low, high)) {
    const room = Math.abs(low) * 0.1 || 1;
    low -= room;
    high += room;
  }
  const raw = (high - low) / steps;
  const ten = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((factor) => factor * ten >= raw) * ten;
  const first = Math.floor(low / step + 1e-9) * step;
  const ticks = [];
  for (let i = 0; first + (i - 1) * step < high - step * 1e-9; i++) ticks.push(Number((first + i * step).toPrecision(12)));
  return { low: ticks[0], high: ticks[ticks.length - 1], ticks, step };
}

// An axis for all values, except distant outliers that would compress all others.
function axisOfKnown(sorted, steps) {
  const low = quantile(sorted, 0.01);
  const high = quantile(sorted, 0.99);
  const room = high - low;
  return axisOf(Math.max(sorted[0], low - room), Math.min(sorted[sorted.length - 1], high + room), steps);
}

// A field of CSV, written as by CsvField in report/csv.cc. A spreadsheet runs a text that begins with a formula
// character, so such a text gets an apostrophe in front. Numbers are written unchanged.
function csvField(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  let text = String(value);
  const bare = text.replace(/^'+/, "");
  const inner = bare.replace(/^[ \t\r\n]+|[ \t\r\n]+$/g, "");
  const number = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/.test(inner);
  const formula = /^[=+\-@\uff1d\uff0b\uff0d\uff20]./su.test(inner) && !number;
  if (typeof value === "string" && (formula || /^[\t\r\n]/.test(bare))) text = `'${text}`;
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function roundNumber(value) {
  return Number.isNaN(value) ? "" : shortNumber(Number(value.toPrecision(4)));
}

// A canvas with the resolution of the screen. `draw` gets its context and its width in CSS pixels.
function canvasOf(label, width, height) {
  const sharp = Math.min(window.devicePixelRatio || 1, 2);
  const canvas = make("canvas", { role: "img", "aria-label": label, width: Math.round(width * sharp),
    height: Math.round(height * sharp), style: `width:${width}px;height:${height}px` });
  const context = canvas.getContext("2d");
  context.scale(sharp, sharp);
  context.font = "12px system-ui, sans-serif";
  return { canvas, context };
}

const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const isDark = () => getComputedStyle(document.documentElement).colorScheme === "dark";

// A colour that differs from the paper in lightness, so that it is readable without hue. `kind` "bad" is vermilion, any
// other kind blue.
function shade(share, kind) {
  const bad = kind === "bad";
  const near = isDark() ? (bad ? [48, 42, 40] : [34, 44, 54]) : bad ? [253, 240, 230] : [232, 242, 250];
  const far = isDark() ? (bad ? [255, 148, 84] : [130, 200, 255]) : bad ? [150, 52, 0] : [0, 66, 118];
  const t = Math.min(Math.max(share, 0), 1);
  return `rgb(${near.map((from, i) => Math.round(from + t * (far[i] - from))).join(",")})`;
}

// The 24 bytes of a sparkline.
const sparklineOf = (text) => (text ? bytesOfBase64(text) : null);

function linePath(bytes, width, height) {
  return Array.from(bytes, (byte, i) =>
    `${i ? "L" : "M"}${((i / (bytes.length - 1)) * width).toFixed(1)},${(height * (1 - byte / 255) + 3).toFixed(1)}`).join("");
}

// A sparkline in front of the median of its group.
function sparklinePicture(sparkline, median, width, height) {
  return makeSvg("svg", { viewBox: `-2 0 ${width + 4} ${height + 6}`, "aria-hidden": "true", class: "sparkline" },
    makeSvg("path", { d: `M0,${height + 3}H${width}`, class: "axis" }),
    median ? makeSvg("path", { d: linePath(median, width, height), class: "median" }) : null,
    makeSvg("path", { d: linePath(sparkline, width, height), class: "curve" }));
}

function medianSparkline(sparklines) {
  if (sparklines.length === 0) return null;
  return Uint8Array.from(sparklines[0], (_, i) => {
    const at = sparklines.map((sparkline) => sparkline[i] ?? 0).sort((a, b) => a - b);
    return (at[(at.length - 1) >> 1] + at[at.length >> 1]) / 2;
  });
}
