// Worst curves, distributions, one quantity against another, trends.

const charts = { worstBy: null, spread: [], x: null, y: null, by: null, trend: null };
const mostPoints = 4000;

const worstChoices = () => ["performance_factor", "group_deviation_percent", "history_p", "FF", "recoverable_power_W", "lack_of_fit_percent", ...numberColumns]
  .filter((name, i, all) => isNumber(name) && all.indexOf(name) === i);

async function groupMedian(id, sparklines) {
  const siblings = siblingsOf(id).filter((row) => sparklines[row]).slice(0, 200);
  return siblings.length > 2 ? medianSparkline(siblings.map((row) => sparklineOf(sparklines[row]))) : null;
}

async function drawWorst() {
  const host = byId("live-worst");
  if (!has("sparkline") || !charts.worstBy) return;
  const { id: ids, sparkline: sparklines, cause_title: causes, cause } = await loadWhere(["id", "sparkline", "cause_title", "cause"]);
  const values = await load(charts.worstBy);
  const sign = worstFirst(charts.worstBy) ? 1 : -1;
  const rows = Array.from(state.rows).filter((row) => sparklines[row] && Number.isFinite(values[row]))
    .sort((a, b) => sign * (values[a] - values[b]) || a - b).slice(0, 24);
  const cards = [];
  for (const row of rows) {
    const name = ids ? ids[row] : `row ${row + 1}`;
    const median = ids ? await groupMedian(name, sparklines) : null;
    const what = (causes || cause || [])[row] || "";
    cards.push(make("li", {}, make("button", { type: "button", class: "card", onclick: () => showRow(row) },
      sparklinePicture(sparklineOf(sparklines[row]), median, 150, 80),
      make("span", { class: "name" }, name), make("span", {}, `${charts.worstBy} ${shortNumber(values[row])}`), make("span", {}, what))));
  }
  host.replaceChildren(
    make("div", { class: "controls" }, select("Worst by", worstChoices(), charts.worstBy, (name) => { charts.worstBy = name; drawWorst(); })),
    rows.length ? make("p", { class: "tip" }, `Current over V / Voc of the ${rows.length} worst, each in parts of its largest; dashed behind it the median of its group.`)
      : make("p", {}, "No string that is shown has a sparkline and this number."),
    make("ul", { class: "cards" }, cards));
}

function histogram(sorted, axis) {
  const bins = Math.min(40, Math.max(8, Math.round(Math.sqrt(sorted.length)) * 2));
  const counts = new Array(bins).fill(0);
  let outside = 0;
  for (const value of sorted) {
    if (value < axis.low || value > axis.high) { outside++; continue; }
    counts[Math.min(bins - 1, Math.floor(((value - axis.low) / (axis.high - axis.low)) * bins))]++;
  }
  return { counts, outside };
}

function spreadCard(name, sorted) {
  const w = 300;
  const h = 90;
  if (sorted.length === 0) return make("li", {}, make("h3", {}, breakable(name)), make("p", {}, "not known of any string that is shown"));
  const axis = axisOfKnown(sorted, 5);
  const { counts, outside } = histogram(sorted, axis);
  const most = Math.max(...counts);
  const at = (value) => 20 + ((value - axis.low) / (axis.high - axis.low)) * (w - 40);
  const step = (w - 40) / counts.length;
  const five = [0.05, 0.25, 0.5, 0.75, 0.95].map((share) => roundNumber(quantile(sorted, share)));
  const sentence = `Half of ${counted(sorted.length)} lie between ${five[1]} and ${five[3]}, the median is ${five[2]}; 5 % lie below ${five[0]}, 5 % above ${five[4]}.` +
    (outside ? ` Not drawn: ${outside} further out, all lying between ${roundNumber(sorted[0])} and ${roundNumber(sorted[sorted.length - 1])}.` : "");
  const inside = sorted.length <= 500 ? Array.from(sorted).filter((value) => value >= axis.low && value <= axis.high) : [];
  const svg = makeSvg("svg", { viewBox: `0 0 ${w} ${h + 30}`, role: "img", "aria-label": `Histogram of ${name}` },
    counts.map((count, i) => count === 0 ? null : makeSvg("rect", { class: "bar", x: 20 + i * step, width: Math.max(step - 0.7, 0.8),
      y: h - Math.max(1, (count / most) * (h - 6)), height: Math.max(1, (count / most) * (h - 6)) })),
    makeSvg("path", { class: "axis", d: `M20,${h}H${w - 20}` }),
    inside.map((value) => makeSvg("path", { class: "rug", d: `M${at(value).toFixed(1)},${h + 2}v5` })),
    makeSvg("path", { class: "marker", d: `M${at(quantile(sorted, 0.5)).toFixed(1)},4V${h}` }),
    axis.ticks.map((tick) => makeSvg("text", { x: at(tick), y: h + 22, "text-anchor": "middle" }, shortNumber(tick))));
  const width = (axis.high - axis.low) / counts.length;
  return make("li", {}, make("h3", {}, breakable(name)), svg, make("p", {}, sentence),
    folded("Table", plainTable(`Strings by ${name}`, ["from", "to", "strings"], counts.map((count, i) =>
      [shortNumber(axis.low + i * width), shortNumber(axis.low + (i + 1) * width), String(count)]))));
}

async function drawSpread() {
  const host = byId("live-spread");
  if (numberColumns.length === 0 || rowCount === 0) return;
  const all = await loadAll(charts.spread);
  const rest = numberColumns.filter((name) => !charts.spread.includes(name));
  host.replaceChildren(
    rest.length ? make("div", { class: "controls" }, select("Show another", ["choose ...", ...rest], "choose ...", (name) => {
      if (name !== "choose ...") { charts.spread.unshift(name); drawSpread(); }
    })) : "",
    make("ul", { class: "spreads" }, charts.spread.map((name, i) => spreadCard(name, sortedKnown(all[i], state.rows)))));
}

function line(context, fromX, fromY, toX, toY) {
  context.lineWidth = 0.7;
  context.beginPath();
  context.moveTo(fromX, fromY);
  context.lineTo(toX, toY);
  context.stroke();
}

function axes(context, x, y, box) {
  context.strokeStyle = themeColour("--line");
  context.fillStyle = themeColour("--ink");
  context.textAlign = "center";
  for (const tick of x.ticks) {
    const at = box.x(tick);
    line(context, at, box.top, at, box.bottom);
    context.fillText(shortNumber(tick), at, box.bottom + 16);
  }
  context.textAlign = "right";
  for (const tick of y.ticks) {
    const at = box.y(tick);
    line(context, box.left, at, box.right, at);
    context.fillText(shortNumber(tick), box.left - 6, at + 4);
  }
}

function boxOf(x, y, width, height) {
  const box = { left: 58, right: width - 22, top: 8, bottom: height - 28 };
  box.x = (value) => box.left + ((value - x.low) / (x.high - x.low)) * (box.right - box.left);
  box.y = (value) => box.bottom - ((value - y.low) / (y.high - y.low)) * (box.bottom - box.top);
  return box;
}

function drawSign(context, sign, x, y, colour) {
  context.fillStyle = colour;
  context.fillText(sign, x, y + parseFloat(context.font) / 3);
}

function drawBinned(context, box, rows, xs, ys) {
  const side = 7;
  const counts = new Map();
  for (const row of rows) {
    const px = box.x(xs[row]);
    const py = box.y(ys[row]);
    if (!(px >= box.left && px <= box.right && py >= box.top && py <= box.bottom)) continue;
    const key = Math.floor(px / side) * 10000 + Math.floor(py / side);
    counts.set(key, (counts.get(key) || 0) + 1);
  }
  const most = Math.log(Math.max(...counts.values(), 2));
  for (const [key, count] of counts) {
    context.fillStyle = shade(0.15 + 0.85 * (Math.log(count) / most), "");
    context.fillRect(Math.floor(key / 10000) * side, (key % 10000) * side, side - 0.5, side - 0.5);
  }
  return Math.round(Math.exp(most));
}

// Spearman's rank correlation.
function rankCorrelation(rows, xs, ys) {
  const ranks = (values) => {
    const order = rows.slice().sort((a, b) => values[a] - values[b]);
    const rank = new Map();
    for (let i = 0; i < order.length;) {
      let j = i;
      while (j < order.length && values[order[j]] === values[order[i]]) j++;
      for (let k = i; k < j; k++) rank.set(order[k], (i + j - 1) / 2);
      i = j;
    }
    return rank;
  };
  const one = ranks(xs);
  const other = ranks(ys);
  const mean = (rows.length - 1) / 2;
  let xy = 0, xx = 0, yy = 0;
  for (const row of rows) {
    const a = one.get(row) - mean;
    const b = other.get(row) - mean;
    xy += a * b; xx += a * a; yy += b * b;
  }
  return xx && yy ? xy / Math.sqrt(xx * yy) : NaN;
}

function cloudTable(rows, xs, ys) {
  const order = rows.slice().sort((a, b) => xs[a] - xs[b]);
  const parts = Math.min(10, Math.max(1, Math.floor(order.length / 5)));
  const lines = [];
  for (let p = 0; p < parts; p++) {
    const part = order.slice(Math.floor((p * order.length) / parts), Math.floor(((p + 1) * order.length) / parts));
    const known = sortedKnown(ys, part);
    lines.push([`${shortNumber(xs[part[0]])} to ${shortNumber(xs[part[part.length - 1]])}`, String(part.length),
      ...[0.25, 0.5, 0.75].map((share) => shortNumber(quantile(known, share)))]);
  }
  return plainTable(`${charts.y} by ${charts.x}`, [charts.x, "strings", "lower quarter", "median", "upper quarter"], lines);
}

async function drawCloud() {
  const host = byId("live-cloud");
  if (numberColumns.length < 2 || rowCount === 0) { byId("cloud").hidden = true; return; }
  const [xs, ys] = await loadAll([charts.x, charts.y]);
  const rows = Array.from(state.rows).filter((row) => Number.isFinite(xs[row]) && Number.isFinite(ys[row]));
  const redraw = (key) => (name) => { charts[key] = name; drawCloud(); };
  const words = ["none", ...wordColumns()];
  const controls = make("div", { class: "controls" }, select("Across", numberColumns, charts.x, redraw("x")),
    select("Up", numberColumns, charts.y, redraw("y")), rows.length <= mostPoints ? select("Signs by", words, charts.by, redraw("by")) : null);
  if (rows.length === 0) return host.replaceChildren(controls, make("p", {}, "No string that is shown has both."));
  const width = Math.max(260, Math.min(host.clientWidth, 900));
  const height = Math.max(240, width * 0.5);
  const x = axisOfKnown(sortedKnown(xs, rows), width < 500 ? 4 : 8);
  const y = axisOfKnown(sortedKnown(ys, rows), 6);
  const box = boxOf(x, y, width, height);
  const { canvas, context } = canvasOf(`${charts.y} over ${charts.x}; the table below says the same`, width, height);
  axes(context, x, y, box);
  context.textAlign = "center";
  let legend = null;
  let note = "";
  if (rows.length > mostPoints) {
    note = ` The darker, the more strings: up to ${drawBinned(context, box, rows, xs, ys)} in a cell.`;
  } else {
    legend = await drawPoints(context, box, rows, xs, ys);
    pickPoint(canvas, box, rows, xs, ys);
  }
  const rho = rows.length <= 200000 ? rankCorrelation(rows, xs, ys) : NaN;
  host.replaceChildren(controls, make("figure", {}, canvas, legend, make("figcaption", {},
    `${charts.y} (up) over ${charts.x} (across) of ${counted(rows.length)} strings.${Number.isNaN(rho) ? "" : ` Rank correlation ${rho.toFixed(2)}.`}${note}`)),
  folded("Table", cloudTable(rows, xs, ys)));
}

function pointOf(word) {
  const zone = zoneOf(word);
  return zone && { colour: zone.colour, sign: zone.point };
}

async function drawPoints(context, box, rows, xs, ys) {
  context.font = `${rows.length > 1000 ? 7 : rows.length > 200 ? 9 : 12}px system-ui, sans-serif`;
  const inside = rows.filter((row) => box.x(xs[row]) >= box.left - 1 && box.x(xs[row]) <= box.right + 1 && box.y(ys[row]) >= box.top - 1 && box.y(ys[row]) <= box.bottom + 1);
  if (charts.by === "none") {
    for (const row of inside) drawSign(context, "●", box.x(xs[row]), box.y(ys[row]), palette[0]);
    return null;
  }
  const values = await load(charts.by);
  const counts = new Map();
  for (const row of inside) counts.set(values[row] || "", (counts.get(values[row] || "") || 0) + 1);
  const order = [...counts.keys()].sort((a, b) => counts.get(b) - counts.get(a));
  const looks = new Map(order.map((word, i) => [word, (charts.by === "zone" && pointOf(word)) || { colour: palette[Math.min(i, 7)], sign: signs[Math.min(i, 7)] }]));
  for (const word of order) {
    for (const row of inside) if ((values[row] || "") === word) drawSign(context, looks.get(word).sign, box.x(xs[row]), box.y(ys[row]), looks.get(word).colour);
  }
  return make("ul", { class: "keys" }, order.map((word) => make("li", {},
    make("span", { class: "swatch", style: `background:#fff;color:${looks.get(word).colour}`, "aria-hidden": "true" }, looks.get(word).sign), ` ${word || "not known"} (${counts.get(word)})`)));
}

function pickPoint(canvas, box, rows, xs, ys) {
  canvas.addEventListener("click", ({ offsetX, offsetY }) => {
    const far = (row) => Math.hypot(box.x(xs[row]) - offsetX, box.y(ys[row]) - offsetY);
    const nearest = rows.reduce((best, row) => (far(row) < far(best) ? row : best), rows[0]);
    if (far(nearest) < 15) showRow(nearest);
  });
}

// Groups by day if there are few days, else by month.
function spans(rows, dates) {
  const by = (length) => {
    const groups = new Map();
    for (const row of rows) {
      const key = (dates[row] || "").slice(0, length);
      if (!/^\d{4}-\d{2}/.test(key)) continue;
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(row);
    }
    return groups;
  };
  const days = by(10);
  return [...(days.size <= 60 ? days : by(7))].sort((a, b) => (a[0] < b[0] ? -1 : 1));
}

async function drawTrend() {
  const host = byId("live-trend");
  if (!has("date") || columnOf("date").type !== "text" || !charts.trend) { byId("trend").hidden = true; return; }
  const [dates, values] = await loadAll(["date", charts.trend]);
  const groups = spans(state.rows, dates).map(([day, rows]) => ({ day, known: sortedKnown(values, rows) })).filter((group) => group.known.length);
  const control = make("div", { class: "controls" }, select("Of", numberColumns, charts.trend, (name) => { charts.trend = name; drawTrend(); }));
  if (groups.length === 0) return host.replaceChildren(control, make("p", {}, "No string that is shown has a date and this number."));
  const at = (group, share) => quantile(group.known, share);
  const y = axisOf(Math.min(...groups.map((group) => at(group, 0.05))), Math.max(...groups.map((group) => at(group, 0.95))), 5);
  const width = Math.max(300, Math.min(host.clientWidth, 900));
  const height = 240;
  const up = (value) => 200 - ((value - y.low) / (y.high - y.low)) * 190;
  const step = (width - 70) / groups.length;
  const every = Math.ceil(groups.length / (width / 90));
  const bar = Math.min(step * 0.6, 30);
  const svg = makeSvg("svg", { viewBox: `0 0 ${width} ${height}`, style: `width:100%;max-width:${width}px`, role: "img", "aria-label": `${charts.trend} by date` },
    y.ticks.map((tick) => [makeSvg("path", { class: "grid", d: `M60,${up(tick)}H${width - 10}` }),
      makeSvg("text", { x: 54, y: up(tick) + 4, "text-anchor": "end" }, shortNumber(tick))]),
    groups.map((group, i) => {
      const x = 60 + step * (i + 0.5);
      return [makeSvg("path", { class: "whisker", d: `M${x},${up(at(group, 0.05))}V${up(at(group, 0.95))}` }),
        makeSvg("rect", { class: "bar", x: x - bar / 2, width: bar, y: up(at(group, 0.75)), height: Math.max(1, up(at(group, 0.25)) - up(at(group, 0.75))) }),
        makeSvg("path", { class: "marker", d: `M${x - bar / 2},${up(at(group, 0.5))}h${bar}` }),
        i % every === 0 ? makeSvg("text", { x, y: 222, "text-anchor": "middle" }, group.day) : null];
    }));
  host.replaceChildren(control, make("figure", {}, svg, make("figcaption", {},
    `${charts.trend} by ${groups[0].day.length === 10 ? "day" : "month"}: the line is the median, the box the middle half, the stroke the middle 90 %.`)),
  folded("Table", plainTable(`${charts.trend} by date`, ["date", "strings", "5 %", "lower quarter", "median", "upper quarter", "95 %"],
    groups.map((group) => [group.day, String(group.known.length), ...[0.05, 0.25, 0.5, 0.75, 0.95].map((share) => shortNumber(at(group, share)))]))));
}
