// The table of all rows of a results file, shown by Tabulator: search, filters, sorting, a choice of columns, all
// cells of one row, and links to the pages of strings.
(() => {
  const host = document.getElementById('rows-table');
  const kMostWords = 40;  // different words of a column that its filter suggests

  function make(tag, attributes, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
      if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
      else if (value !== null && value !== false) element.setAttribute(name, value === true ? '' : value);
    }
    element.append(...children);
    return element;
  }

  // The columns of the file with what is known of them, and its rows as objects of their fields. A field is a number of
  // a column, since names of columns may be anything.
  function read(csv, known) {
    const [head, ...lines] = window.Papa.parse(csv, {skipEmptyLines: true}).data;
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

  // Whether a cell passes a filter: ">0.9", "<5", "1..2", "=exactly", "!without", else a part of the text.
  function passes(wanted, value) {
    const text = String(value ?? '').toLowerCase();
    const want = wanted.trim().toLowerCase();
    const range = want.split('..').map(Number);
    if (typeof value === 'number' && range.length === 2 && !range.some(Number.isNaN)) return value >= range[0] && value <= range[1];
    const [, sign, rest] = /^(<=|>=|<|>|=|!)?(.*)$/s.exec(want);
    if (sign === '=') return text === rest.trim() || (typeof value === 'number' && value === Number(rest));
    if (sign === '!') return !text.includes(rest.trim());
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
    return make('datalist', {id: `words-${field}`}, ...[...words].sort().map((word) => make('option', {value: `=${word}`})));
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
    const state = make('p', {role: 'status'});
    const search = make('input', {type: 'search', oninput: () => table.setFilter(
      (row, {words}) => columns.some(({field}) => String(row[field] ?? '').toLowerCase().includes(words)), {words: search.value.trim().toLowerCase()})});
    const choice = make('details', {}, make('summary', {}, 'Columns'), make('div', {class: 'choice'},
      ...columns.map(({name, field, shown}) => make('label', {}, make('input', {type: 'checkbox', checked: shown, onchange: (event) => {
        if (event.target.checked) table.showColumn(field);
        else table.hideColumn(field);
      }}), name))));
    const tools = make('div', {class: 'rows-tools'}, make('label', {}, 'Search ', search),
      make('button', {type: 'button', onclick: () => { search.value = ''; table.clearFilter(true); table.clearSort(); }}, 'Reset'),
      make('button', {type: 'button', onclick: () => table.download('csv', lyrefit.fileName('csv'))}, 'Save these rows as CSV'), state);
    const place = make('div', {});
    const pager = make('div', {class: 'pager'});  // outside of the grid, which may hold rows only
    const hint = make('p', {class: 'hint'}, 'A column is filtered by a part of its text, by =text or !text, and numbers by >1, <2 or 1..2.');
    host.replaceChildren(tools, choice, hint, place, pager, ...columns.map(({words}) => words).filter(Boolean));
    const table = new Tabulator(place, {
      data: rows, columns: columns.map((column) => tabulatorColumn(column, cell)), nestedFieldSeparator: false, layout: 'fitData',
      pagination: true, paginationElement: pager, paginationSize: 25, paginationSizeSelector: [25, 50, 100], placeholder: 'No row passes the filters.',
    });
    const count = (shown) => {
      state.textContent = `${shown === rows.length ? 'All' : `${shown.toLocaleString('en')} of`} ${rows.length.toLocaleString('en')} rows`;
    };
    table.on('dataFiltered', (filters, shown) => count(shown.length));
    table.on('tableBuilt', () => {
      count(rows.length);
      place.querySelector('.tabulator-tableholder').removeAttribute('tabindex');  // its rows hold buttons
      document.documentElement.dataset.rows = 'ready';
    });
  }

  // The rows are unpacked when their place comes near.
  new IntersectionObserver(([{isIntersecting}], observer) => {
    if (!isIntersecting) return;
    observer.disconnect();
    fill();
  }, {rootMargin: '1000px'}).observe(host);
})();
