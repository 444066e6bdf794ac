// Interactive functions of a page, which is readable without scripts. Defines `lyrefit` for later
// scripts: data(id), bytes(id), text(id), plotly() and tabulator(), which return promises; make(tag, attributes, ...children);
// takeOver(figure, chart); colour(hex); onTheme(function).
'use strict';
const lyrefit = (() => {
  const root = document.documentElement;
  const darkWanted = matchMedia('(prefers-color-scheme: dark)');
  const dark = [...document.styleSheets[0].cssRules].find((rule) => rule.media?.mediaText.includes('dark')).media;
  const darkUnlessChosen = dark.mediaText;
  const themeFunctions = [];

  function unpacked(text) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Response(stream);
  }

  // The bytes and the text of a packed script element.
  const bytes = (id) => unpacked(document.getElementById(id).textContent).arrayBuffer();
  const text = (id) => unpacked(document.getElementById(id).textContent).text();

  // The data of a script element, packed or not.
  async function data(id) {
    const element = document.getElementById(id);
    return JSON.parse(element.type === 'application/gzip' ? await text(id) : element.textContent);
  }

  // Packed code becomes an element of this tag, which takes effect. False if the page has none.
  async function adopt(id, tag) {
    const packed = document.getElementById(id);
    if (!packed || typeof DecompressionStream === 'undefined') return false;
    const element = make(tag, {}, await text(id));
    packed.remove();
    document.head.prepend(element);
    return true;
  }

  // A part by others, unpacked at the first call; null if the page has none.
  const once = (load) => {
    let promise = null;
    return () => promise ??= load();
  };
  const plotly = once(async () => ((await adopt('plotly', 'script')) ? window.Plotly : null));
  const tabulator = once(async () =>
    ((await adopt('tabulator-style', 'style')) && (await adopt('tabulator', 'script')) ? window.Tabulator : null));

  // A figure's colour in the current theme; `letters`: for text.
  function colour(hex, letters = false) {
    const name = `--${letters ? 't' : 'c'}-${hex.slice(1).toLowerCase()}`;
    return getComputedStyle(root).getPropertyValue(name).trim() || hex;
  }

  const isDark = () => (root.dataset.theme ?? (darkWanted.matches ? 'dark' : 'light')) === 'dark';

  function themeChanged() {
    dark.mediaText = {dark: 'screen', light: 'not all'}[root.dataset.theme] ?? darkUnlessChosen;
    for (const button of document.querySelectorAll('[data-page=theme]')) {
      button.textContent = isDark() ? 'Light' : 'Dark';
    }
    for (const each of themeFunctions) each();
  }

  // An element; functions of attributes "on..." are called at its events.
  function make(tag, attributes, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
      if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
      else if (value !== null && value !== false) element.setAttribute(name, value === true ? '' : value);
    }
    element.append(...children);
    return element;
  }

  const save = (name, url) => make('a', {href: url, download: name}).click();

  // A file name from the page's title.
  function fileName(extension) {
    const words = document.title.replace(/[^\p{L}\p{N}]+/gu, '_').replace(/^_|_$/g, '');
    return `${words.slice(0, 80) || 'lyrefit'}.${extension}`;
  }

  // The record of the page, or the file of its rows.
  async function saveData() {
    const rows = document.getElementById('rows');
    const content = rows ? await text('rows') : JSON.stringify(await data('record'), null, 2);
    const url = URL.createObjectURL(new Blob([content], {type: rows ? 'text/csv' : 'application/json'}));
    save(fileName(rows ? 'csv' : 'json'), url);
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }

  // Charts without a static picture are printed in the light theme.
  function dressForPaper() {
    if (!document.querySelector('.is-live') || document.querySelector('.still')) return;
    const {theme} = root.dataset;
    root.dataset.theme = 'light';
    themeChanged();
    addEventListener('afterprint', () => {
      if (theme === undefined) delete root.dataset.theme;
      else root.dataset.theme = theme;
      themeChanged();
    }, {once: true});
  }

  const pageActions = {
    theme() {
      root.dataset.theme = isDark() ? 'light' : 'dark';
      themeChanged();
    },
    save: saveData,
    print: () => window.print(),
  };

  function start() {
    const tools = document.querySelector('header .tools');
    const record = document.getElementById('record') ?? document.getElementById('rows');
    for (const button of tools.querySelectorAll('button')) {
      button.addEventListener('click', pageActions[button.dataset.page]);
      if (button.dataset.page === 'save') button.hidden = !record;
    }
    tools.hidden = false;
    darkWanted.addEventListener('change', themeChanged);
    addEventListener('beforeprint', dressForPaper);
    themeChanged();
  }

  start();
  return {make, data, bytes, text, plotly, tabulator, colour, fileName, save, onTheme: (each) => themeFunctions.push(each)};
})();

// Charts replace the static pictures, with equal rows, colours, bands and notes.
(() => {
  const {make} = lyrefit;
  const kNarrow = 560;  // pixels; narrower pages have one column of panels
  const kLetter = 6.7;  // pixels, for one letter of a title
  const kMostParts = 500;  // of a chart in a choice
  const wantsStillness = matchMedia('(prefers-reduced-motion: reduce)');

  // A copy with the page's colours; those of `font` members are for text.
  function coloured(value, letters = false) {
    if (Array.isArray(value)) return value.map((each) => coloured(each, letters));
    if (value !== null && typeof value === 'object') {
      return Object.fromEntries(Object.entries(value).map(
          ([key, each]) => [key, coloured(each, letters || key === 'font')]));
    }
    const isColour = typeof value === 'string' && /^#[0-9a-f]{6}$/i.test(value);
    return isColour ? lyrefit.colour(value, letters) : value;
  }

  function wrapped(text, width) {
    const most = Math.max(20, Math.floor(width / kLetter));
    const lines = [''];
    for (const word of text.split(' ')) {
      const last = lines.length - 1;
      if (lines[last] && lines[last].length + word.length >= most) lines.push(word);
      else lines[last] += (lines[last] ? ' ' : '') + word;
    }
    return lines.join('<br>');
  }

  function setPath(object, path, value) {
    const keys = path.split('.');
    const last = keys.pop();
    let at = object;
    for (const key of keys) at = at[key] ??= {};
    at[last] = value;
  }

  // The symbol of a legend entry, as letters: a line, a mark, or both.
  function swatch({mode, line, marker}) {
    const span = make('span', {class: 'swatch', 'aria-hidden': 'true'});
    const stroke = {dash: '╌', dot: '┈', dashdot: '┄', longdashdot: '┄'}[line?.dash] ?? '─';
    const marks = {circle: '●○', square: '■□', 'triangle-up': '▲△', 'triangle-down': '▼▽', diamond: '◆◇', x: '✕✕', cross: '++'};
    const [full, empty] = marks[marker?.symbol.replace(/-(thin|open).*/, '')] ?? '●○';
    const mark = mode.includes('markers') ? (/-open$/.test(marker.symbol) ? empty : full) : '';
    span.textContent = mode.includes('lines') ? stroke + (mark || stroke) + stroke : mark;
    span.style.color = (line ?? marker).color;
    return span;
  }

  // The legend: one button for each entry, which hides and shows the traces of its name.
  function fillLegend(list, entries, hidden, changed) {
    list.replaceChildren(...coloured(entries).map((entry) => {
      const name = make('span', {});
      name.innerHTML = entry.name;  // escaped where it was written
      const press = () => {
        if (!hidden.delete(entry.name)) hidden.add(entry.name);
        button.setAttribute('aria-pressed', String(!hidden.has(entry.name)));
        changed();
      };
      const button = make('button', {type: 'button', 'aria-pressed': String(!hidden.has(entry.name)), onclick: press}, swatch(entry), name);
      return make('li', {}, button);
    }));
  }

  // The layout for a box of this width, in the current theme.
  function layoutFor(chart, width) {
    const narrow = width < kNarrow;
    const layout = coloured(structuredClone(chart.layout));
    const places = narrow ? chart.narrow : chart.wide;
    for (const [path, value] of Object.entries(places)) setPath(layout, path, value);
    const style = getComputedStyle(document.documentElement);
    const say = (name) => style.getPropertyValue(name).trim();
    layout.paper_bgcolor = 'rgba(0,0,0,0)';
    layout.plot_bgcolor = 'rgba(0,0,0,0)';
    layout.font = {color: say('--ink'), size: 13, family: getComputedStyle(document.body).fontFamily};
    layout.hoverlabel = {bgcolor: say('--card'), bordercolor: say('--line'), font: {color: say('--ink')}};
    const columns = narrow ? 1 : chart.columns;
    for (const note of layout.annotations) {
      if (note.name === 'title') note.text = wrapped(note.text, (width - 90) / columns);
    }
    layout.height += layout.margin.t;
    layout.showlegend = false;  // the page has one for all widths
    layout.width = width;
    return layout;
  }

  function zoom(Plotly, live, factor) {
    const change = {};
    for (const [name, axis] of Object.entries(live._fullLayout)) {
      if (!/^[xy]axis\d*$/.test(name) || !axis.range) continue;
      const [low, high] = axis.range;
      const middle = 0.5 * (low + high);
      change[`${name}.range`] = [middle - factor * (middle - low), middle + factor * (high - middle)];
    }
    return Plotly.relayout(live, change);
  }

  async function savePicture(Plotly, chart, live) {
    const layout = layoutFor(chart, 1000);
    layout.paper_bgcolor = layout.plot_bgcolor =
        getComputedStyle(document.documentElement).getPropertyValue('--paper').trim();
    layout.title = {text: chart.title, font: {size: 15}, yref: 'container', y: 1, yanchor: 'top', pad: {t: 10}};
    layout.showlegend = true;
    layout.legend = {orientation: 'h', x: 0.5, xanchor: 'center', yref: 'container', yanchor: 'top',
                     y: 1 - 34 / (layout.height + 70)};
    layout.margin.t += 70;
    layout.height += 70;
    for (const [name, axis] of Object.entries(live._fullLayout)) {
      if (/^[xy]axis\d*$/.test(name) && axis.range) layout[name].range = [...axis.range];
    }
    const url = await Plotly.toImage({data: coloured(chart.data), layout},
                                     {format: 'png', width: 1000, height: layout.height, scale: 2});
    lyrefit.save(lyrefit.fileName('png'), url);
  }

  function addButtons(figure, actions) {
    const tools = figure.querySelector('.tools');
    tools.append(...actions.map(([text, action]) => make('button', {type: 'button', onclick: action}, text)));
    tools.hidden = false;
  }

  // Parts of the chart as a choice, for the keyboard: each filters the table of all rows, as a click on it does.
  function fillParts(select, {data}) {
    const parts = data.flatMap(({meta, customdata}) => (customdata ?? []).map((texts) => [meta, texts]));
    select.hidden = !lyrefit.filterRows || parts.length === 0 || parts.length > kMostParts;
    if (select.hidden) return;
    select.replaceChildren(new Option('Choose a part of the chart', ''), ...parts.map((part) => new Option(
        part[1].map((text, i) => text && `${part[0][i]} ${text}`).filter(Boolean).join(', '), JSON.stringify(part))));
  }

  // Draws a chart in its figure. Returns a function that draws another one in its place.
  async function takeOver(Plotly, figure, chart) {
    const live = figure.querySelector('.live');
    const name = make('p', {class: 'live-title'});
    const plot = make('div', {role: 'img', 'aria-labelledby': `${figure.id}-caption`});
    const legend = make('ul', {class: 'legend'});
    const hidden = new Set();
    const told = make('p', {role: 'status'});
    const pick = async (names, texts) => {
      told.replaceChildren('The table shows ', make('a', {href: '#rows-table'}, await lyrefit.filterRows(names, texts)));
    };
    const select = make('select', {'aria-label': 'Part of the chart whose rows the table shows', onchange: () => select.value && pick(...JSON.parse(select.value))});
    live.append(name, legend, plot, told);
    figure.classList.add('is-live');
    const config = {displayModeBar: false, doubleClick: 'reset', showTips: false};
    let width = 0;
    const draw = () => {
      width = Math.round(live.clientWidth);
      const layout = layoutFor(chart, width);
      if (wantsStillness.matches) layout.transition = {duration: 0};
      const shown = chart.data.filter((trace) => !hidden.has(trace.legendgroup));
      return Plotly.react(plot, coloured(shown), layout, config);
    };
    const redraw = () => {
      name.innerHTML = chart.title;  // escaped where it was written
      fillLegend(legend, chart.data.filter((trace) => trace.showlegend !== false), hidden, draw);
      return draw();
    };
    await redraw();
    fillParts(select, chart);
    plot.on('plotly_click', ({points: [{data, customdata}]}) => {
      if (data.meta && lyrefit.filterRows) pick(data.meta, customdata ?? data.customdata[0]);
    });
    addButtons(figure, [
      ['Zoom in', () => zoom(Plotly, plot, 0.5)],
      ['Zoom out', () => zoom(Plotly, plot, 2)],
      ['Reset', () => { hidden.clear(); return redraw(); }],
      ['PNG', () => savePicture(Plotly, chart, plot)],
    ]);
    figure.querySelector('.tools').prepend(select);
    lyrefit.onTheme(redraw);
    new ResizeObserver(() => {
      if (live.clientWidth > 0 && Math.round(live.clientWidth) !== width) draw();
    }).observe(live);
    return (next) => {
      chart = next;
      hidden.clear();
      fillParts(select, chart);
      return redraw();
    };
  }
  // Without Plotly nothing is drawn, and there is no function.
  lyrefit.takeOver = async (figure, chart) => await lyrefit.plotly() && takeOver(window.Plotly, figure, chart);

  async function takeOverAll() {
    const figures = [...document.querySelectorAll('figure[id]')].filter(
        (figure) => document.getElementById(`${figure.id}-chart`));
    if (figures.length === 0) return;
    const Plotly = await lyrefit.plotly();
    if (Plotly === null) return;
    for (const figure of figures) await takeOver(Plotly, figure, await lyrefit.data(`${figure.id}-chart`));
    document.documentElement.dataset.charts = 'ready';
  }

  addEventListener('load', () => setTimeout(takeOverAll));
})();
