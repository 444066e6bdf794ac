// The table of all rows of a results file, shown by Tabulator: search, filters, sorting, a choice of columns, all
// cells of one row, and links to the pages of strings.
(() => {
  const {make} = lyrefit;
  const host = document.getElementById('rows-table');
  const kMostWords = 40;    // different words of a column that its filter suggests
  const kMostPoints = 5000;  // of a chart
  const kBars = 30;          // of a chart, about
  const kColours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8c8c8c'];
  const kSymbols = ['circle', 'square', 'triangle-up', 'diamond', 'triangle-down', 'x', 'cross'];

  // The cells of a CSV file. A line that ends within quotes goes on in the next one.
  function cells(csv) {
    const rows = [];
    let line = null;
    for (const next of csv.split('\n')) {
      line = line === null ? next : `${line}\n${next}`;
      const quotes = line.includes('"');
      if (quotes && line.split('"').length % 2 === 0) continue;
      if (quotes) {
        rows.push([...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|\r?$)/g)].map(([, text]) => (
          text.startsWith('"') ? text.slice(1, -1).replaceAll('""', '"') : text)));
      } else if (line) {
        rows.push(line.replace(/\r$/, '').split(','));
      }
      line = null;
    }
    return rows;
  }

  // The columns of the file with what is known of them, and its rows as objects of their fields. A field is a number of
  // a column, since names of columns may be anything.
  function read(csv, known) {
    const [head, ...lines] = cells(csv);
    const columns = (head ?? []).map((name, i) => (
      {name, doc: '', shown: true, number: false, ...known.find((each) => each.name === name), field: `c${i}`}));
    const place = ({name}) => known.findIndex((each) => each.name === name);
    const cell = ({number}, text) => (!text ? null : number && !Number.isNaN(Number(text)) ? Number(text) : text);
    const rows = lines.map((line) => Object.fromEntries(columns.map((column, i) => [column.field, cell(column, line[i])])));
    return {columns: [...columns].sort((a, b) => place(a) - place(b)), rows};
  }

  // The URL of a string's page. Null for a path that leaves the folder of the results, since rows may hold any text.
  function pageOf(links, path) {
    if (typeof path !== 'string' || !path || path.split('/').includes('..')) return null;
    return `./${links}${path.split('/').map(encodeURIComponent).join('/')}`;
  }

  function shortNumber(value) {
    if (typeof value !== 'number') return value ?? '';
    const size = Math.abs(value);
    return size !== 0 && (size < 1e-4 || size >= 1e7) ? value.toExponential(3) : String(Number(value.toPrecision(5)));
  }

  // Whether a cell passes a filter: ">0.9", "<5", "1..2", "1..<2", "=exactly", "^begins with", "!without", else a part of
  // the text.
  function passes(wanted, value) {
    const text = String(value ?? '').toLowerCase().replace(/^'(?=[=+@-])/, '');  // without the mark against formulas
    const want = wanted.trim().toLowerCase();
    const [, low, below, high] = /^(\S+?)\.\.(<?)(\S+)$/.exec(want) ?? [];
    if (typeof value === 'number' && !Number.isNaN(high - low)) return value >= low && (below ? value < high : value <= high);
    const [, sign, rest] = /^(<=|>=|<|>|=|!|\^)?(.*)$/s.exec(want);
    if (sign === '=') return text === rest.trim() || (typeof value === 'number' && value === Number(rest));
    if (sign === '!') return !text.includes(rest.trim());
    if (sign === '^') return text.startsWith(rest.trim());
    if (!sign) return text.includes(rest);
    if (typeof value !== 'number' || !rest.trim() || Number.isNaN(Number(rest))) return false;
    return {'<': value < rest, '>': value > rest, '<=': value <= rest, '>=': value >= rest}[sign];
  }

  // The different words of a column of texts as suggestions; null if there are too many.
  function suggestions({field, number}, rows) {
    if (number) return null;
    const words = new Set();
    for (const row of rows) {
      if (row[field] !== null) words.add(row[field]);
      if (words.size > kMostWords) return null;
    }
    return words.size && make('datalist', {id: `words-${field}`}, ...[...words].sort().map((word) => make('option', {value: `=${word}`})));
  }

  function tabulatorColumn(column, row) {
    const {name, field, number, shown, doc} = column;
    const filter = {'aria-label': `Filter ${name}`};
    if (column.words) filter.list = column.words.id;
    return {
      field, title: name, visible: shown, headerTooltip: doc ? () => document.createTextNode(doc) : false, minWidth: 90, maxInitialWidth: 340,
      hozAlign: number ? 'right' : 'left', sorter: number ? 'number' : 'alphanum', sorterParams: {alignEmptyValues: 'bottom'},
      titleFormatter: () => make('button', {type: 'button', 'data-sort': name}, name),
      headerFilter: 'input', headerFilterParams: {elementAttributes: filter}, headerFilterFunc: passes, headerFilterPlaceholder: number ? '> < a..b' : 'part, =, !',
      formatter: (cell) => row(column, cell.getValue(), cell.getData()),
    };
  }

  // All cells of one row.
  function showRow(columns, row, title, link) {
    const close = make('button', {type: 'button', onclick: () => dialog.remove()}, 'Close');
    const cells = columns.filter(({field}) => row[field] !== null).map(({name, field, doc}) =>
      make('tr', {}, make('th', {scope: 'row', class: 'words'}, name), make('td', {class: 'words'}, String(row[field])), make('td', {class: 'words'}, doc)));
    const dialog = make('dialog', {'aria-labelledby': 'row-title', onclose: () => dialog.remove()},
      make('div', {class: 'tools'}, close), make('h2', {id: 'row-title'}, title),
      link ? make('p', {}, make('a', {href: link}, 'The page of this string')) : '',
      make('table', {}, make('tbody', {}, ...cells)));
    document.body.append(dialog);
    dialog.showModal();
  }

  const isWorded = ({words, name}) => words && name !== 'page';

  // What rows are grouped by: levels of the tree that their ids are, each within the one above, and columns of few words.
  function groupings(columns, rows, {field, name}) {
    const part = (row, level) => String(row[field] ?? '').split('/').slice(0, -1).slice(0, level).join('/');
    const deepest = rows.map((row) => part(row).split('/')).reduce((most, levels) => (levels.length > most.length ? levels : most));
    const levels = deepest.filter(Boolean).map((_, i) => (row) => part(row, i + 1));
    return [['nothing', false],
      ...levels.map((_, i) => [`${name}: ${deepest.slice(0, i + 1).join('/')}`, levels.slice(0, i + 1)]),
      ...columns.filter(isWorded).map((column) => [column.name, column.field])];
  }

  // A round step that makes about kBars bars of the numbers.
  function stepOf(values) {
    const [low, high] = values.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [Infinity, -Infinity]);
    const step = (high - low || Math.abs(low) || 1) / kBars;
    const ten = 10 ** Math.floor(Math.log10(step));
    return ten * [1, 2, 5, 10].find((factor) => factor * ten >= step * (1 - 1e-9));
  }

  const plain = (text) => String(text).replace(/[&<>{]/g, (letter) => `&#${letter.charCodeAt(0)};`);  // texts of Plotly are HTML
  const isKnown = (row, {field, number}) => (number ? typeof row[field] === 'number' : row[field] !== null);

  // How many rows have which x, in steps of numbers; a bar filters its x, and its word.
  function bars(rows, x, step, [names, words]) {
    const counts = new Map();
    for (const row of rows) {
      const bar = step ? Math.floor(row[x.field] / step + 1e-9) : row[x.field];
      counts.set(bar, (counts.get(bar) ?? 0) + 1);
    }
    const all = [...counts].sort((a, b) => (step ? a[0] - b[0] : b[1] - a[1]));
    const end = (bar) => Number((bar * step).toPrecision(12));
    return {
      type: 'bar', x: all.map(([bar]) => (step ? (bar + 0.5) * step : plain(bar))), y: all.map(([, count]) => count), ...(step && {width: 0.92 * step}),
      meta: [x.name, ...names], customdata: all.map(([bar]) => [step ? `${end(bar)}..<${end(bar + 1)}` : `=${bar}`, ...words]),
      hovertext: all.map(([bar]) => (step ? `${end(bar)} to ${end(bar + 1)}` : plain(bar))), hovertemplate: '%{hovertext}: %{y}<extra></extra>',
    };
  }

  // y over x; a point filters its row.
  function points(rows, x, y, {name, field}) {
    const values = (column) => rows.map((row) => (column.number ? row[column.field] : plain(row[column.field])));
    return {
      type: 'scatter', x: values(x), y: values(y), meta: [name], customdata: rows.map((row) => [`=${row[field]}`]),
      hovertext: rows.map((row) => plain(row[field])), hovertemplate: '%{hovertext}<br>%{x}, %{y}<extra></extra>',
    };
  }

  // The chart of rows: bars of x, or y over x; a colour for each word of a column.
  function chartOf(all, x, y, by, named) {
    const known = all.filter((row) => isKnown(row, x) && isKnown(row, y ?? x));
    const every = y ? Math.ceil(known.length / kMostPoints) : 1;
    const step = !y && x.number && known.length ? stepOf(known.map((row) => row[x.field])) : 0;
    const kinds = new Map();
    known.filter((_, i) => i % every === 0).forEach((row) => {
      const word = by ? row[by.field] ?? '' : '';
      if (!kinds.has(word)) kinds.set(word, []);
      kinds.get(word).push(row);
    });
    const data = [...kinds].sort((a, b) => b[1].length - a[1].length).map(([word, rows], i) => {
      const name = plain(word || 'not known');
      const marker = {color: kColours[Math.min(i, 6)], symbol: kSymbols[Math.min(i, 6)], size: 7};
      return {name, legendgroup: name, showlegend: Boolean(by), mode: 'markers', marker,
        ...(y ? points(rows, x, y, named) : bars(rows, x, step, by ? [[by.name], [`=${word}`]] : [[], []]))};
    });
    const axis = ({name, number}) => ({
      title: {text: plain(name), standoff: 8}, type: number ? 'linear' : 'category', automargin: true, showline: true,
      ticks: 'outside', zeroline: false, linecolor: '#000000', tickcolor: '#000000', gridcolor: '#d8d8d8',
    });
    const layout = {annotations: [], hovermode: 'closest', barmode: 'stack', margin: {l: 56, r: 20, t: 8, b: 58},
      xaxis: axis(x), yaxis: axis(y ?? {name: 'rows', number: true})};
    const what = y ? `${y.name} over ${x.name}` : `How many rows have which ${x.name}`;
    const thinned = every > 1 ? `; one in ${every} is drawn` : '';
    return {title: plain(by ? `${what}, by ${by.name}` : what), columns: 1, data, layout, wide: {height: 380}, narrow: {height: 380},
      caption: `${known.length.toLocaleString('en')} of the rows that pass the filters have these values${thinned}.`};
  }

  // Below the table the chart of the columns that are chosen. Returns a function that draws it of these rows.
  function explorer(columns, all, named) {
    const numbers = columns.filter(({number, field}) => number && all.some((row) => typeof row[field] === 'number'));
    const worded = columns.filter(isWorded);
    const some = [...numbers, ...worded];
    if (!some.length) return () => {};
    let rows = [];
    let redraw = null;
    const choice = (label, options) => {
      const select = make('select', {onchange: () => draw(rows)}, ...options.map(([name, i]) => make('option', {value: i}, name)));
      return [select, make('label', {}, `${label} `, select)];
    };
    const asOptions = (list) => list.map((column) => [column.name, columns.indexOf(column)]);
    const [x, xLabel] = choice('Across', asOptions(some));
    const [y, yLabel] = choice('Up', [['count', ''], ...asOptions(some)]);
    const [by, byLabel] = choice('Colour', [['one', ''], ...asOptions(worded)]);
    const caption = make('figcaption', {id: 'rows-chart-caption'});
    const figure = make('figure', {id: 'rows-chart', 'aria-labelledby': 'rows-chart-caption'},
      make('div', {class: 'rows-tools'}, xLabel, yLabel, byLabel),
      make('div', {class: 'tools', role: 'group', 'aria-label': 'Chart'}), make('div', {class: 'live'}), caption);
    const draw = async (shown) => {
      rows = shown;
      const chart = chartOf(rows, columns[x.value], columns[y.value], columns[by.value], named);
      caption.textContent = chart.caption;
      redraw ??= lyrefit.takeOver(figure, chart);
      (await redraw)?.(chart);
    };
    host.after(make('h3', {}, 'A chart of these rows'), figure);
    return draw;
  }

  async function fill() {
    const Tabulator = await lyrefit.tabulator();
    if (!Tabulator) return;
    const {columns: known, links} = await lyrefit.data('rows-columns');
    const {columns, rows} = read(await lyrefit.text('rows'), known);
    const page = columns.find(({name}) => name === 'page');
    const named = columns.find(({name}) => name === 'id') ?? columns[0];
    for (const column of columns) column.words = suggestions(column, rows);
    const cell = (column, value, row) => {
      const link = page && row[page.field] !== null ? pageOf(links, row[page.field]) : null;
      if (column === named) {
        const title = String(value ?? 'row');
        return make('button', {type: 'button', class: 'link', onclick: () => showRow(columns, row, title, link)}, title);
      }
      if (column === page) return link ? make('a', {href: link, 'aria-label': `Page of ${row[named.field]}`}, 'page') : '';
      return document.createTextNode(column.number ? shortNumber(value) : value ?? '');
    };
    const zone = columns.find(({name}) => name === 'zone');
    const counted = (number) => number.toLocaleString('en');
    let toggled = null;
    const headOf = (value, all, data, group) => {
      const fail = data.filter((row) => zone && row[zone.field]?.startsWith('fail')).length;
      const text = `${value || 'not known'}: ${counted(all)} ${all === 1 ? 'row' : 'rows'}${fail ? `, ${counted(fail)} fail` : ''}`;
      return make('span', {role: 'gridcell'},
        make('button', {type: 'button', class: 'link', 'aria-expanded': String(group.isVisible()), onclick: () => { toggled = text; }}, text));
    };
    const state = make('p', {role: 'status'});
    const search = make('input', {type: 'search', oninput: () => table.setFilter(
      (row, {words}) => columns.some(({field}) => String(row[field] ?? '').toLowerCase().includes(words)), {words: search.value.trim().toLowerCase()})});
    const choice = make('details', {}, make('summary', {}, 'Columns'), make('div', {class: 'choice'},
      ...columns.map(({name, field, shown}) => make('label', {}, make('input', {type: 'checkbox', checked: shown, onchange: (event) => {
        if (event.target.checked) table.showColumn(field);
        else table.hideColumn(field);
      }}), name))));
    const groups = groupings(columns, rows, named);
    const grouped = make('select', {onchange: () => table.setGroupBy(groups[grouped.value][1])},
      ...groups.map(([name], i) => make('option', {value: i}, name)));
    const reset = () => { search.value = ''; table.clearFilter(true); };
    const tools = make('div', {class: 'rows-tools'}, make('label', {}, 'Search ', search), make('label', {}, 'Group by ', grouped),
      make('button', {type: 'button', onclick: () => { reset(); table.clearSort(); }}, 'Reset'),
      make('button', {type: 'button', onclick: () => table.download('csv', lyrefit.fileName('csv'))}, 'Save these rows as CSV'), state);
    const place = make('div', {});
    const nothing = make('div', {role: 'row'}, make('span', {role: 'gridcell'}, 'No row passes the filters. ',
      make('button', {type: 'button', onclick: reset}, 'Show all rows')));
    const pager = make('div', {class: 'pager'});  // outside of the grid, which may hold rows only
    const hint = make('p', {class: 'hint'}, 'A column is filtered by a part of its text, by =text, ^beginning or !text, and numbers by >1, <2, 1..2 or 1..<2. ',
      'A click on a part of a chart sets these filters.');
    const draw = explorer(columns, rows, named);
    host.replaceChildren(tools, choice, hint, place, pager, ...columns.map(({words}) => words).filter(Boolean));
    const table = new Tabulator(place, {
      data: rows, columns: columns.map((column) => tabulatorColumn(column, cell)), nestedFieldSeparator: false, layout: 'fitData',
      pagination: true, paginationElement: pager, paginationSize: 25, paginationSizeSelector: [25, 50, 100], placeholder: nothing,
      groupStartOpen: false, groupToggleElement: 'header', groupHeader: headOf,
      autoResize: false,  // columns are as wide as their content; drawn anew, a row would lose a click that has begun
    });
    table.on('renderComplete', () => place.querySelectorAll('.tabulator-group').forEach((head) => {
      head.setAttribute('role', 'row');
      const lost = head.textContent === toggled && document.activeElement === document.body;  // it was drawn anew
      if (lost) head.querySelector('button').focus({preventScroll: true});
    }));
    const count = (shown) => { state.textContent = `${shown === rows.length ? 'All' : `${counted(shown)} of`} ${counted(rows.length)} rows`; };
    const built = new Promise((resolve) => { table.on('tableBuilt', resolve); });
    let waiting = 0;
    table.on('dataFiltered', (filters, shown) => {
      count(shown.length);
      clearTimeout(waiting);
      waiting = setTimeout(() => draw(shown.map((row) => row.getData())), 100);
    });
    const filterBy = async (names, texts) => {
      await built;
      reset();
      names.forEach((name, i) => {
        const column = texts[i] && columns.find((each) => each.name === name);
        if (!column) return;
        table.showColumn(column.field);
        table.setHeaderFilterValue(column.field, texts[i]);
      });
      return state.textContent;
    };
    built.then(() => {
      count(rows.length);
      draw(rows);
      place.querySelector('.tabulator-tableholder').removeAttribute('tabindex');  // its rows hold buttons
      document.documentElement.dataset.rows = 'ready';
    });
    return filterBy;
  }

  // The rows are unpacked when their place comes near, or when a part of a chart is asked for.
  const observer = new IntersectionObserver(([{isIntersecting}]) => isIntersecting && filled(), {rootMargin: '1000px'});
  observer.observe(host);
  let filling = null;
  const filled = () => {
    observer.disconnect();
    return filling ??= fill();
  };
  lyrefit.filterRows = async (names, texts) => (await filled())(names, texts);
})();
