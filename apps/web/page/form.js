// Forms from the engine's description of its option tables. Defines labelOf(row), and formFields(rows, values, changed):
// one element for every row, which updates `values` on input; formGroups() has them in a fieldset for every group;
// fileChoices(holder, names) fills the fields that choose among files.
const kUnits = {cm2: 'cm²', Wm2: 'W/m²', C: '°C', W: 'W', A: 'A', '%': '%', PERCENT: '%', K: 'K', '%/K': '%/K', 'm/s': 'm/s',
                s: 's', eV: 'eV', '1/K': '1/K', 'ohm/K': 'Ω/K', OHM: 'Ω', 'W/m2': 'W/m²'};

// "area-cm2" is "Area (cm²)", "irradiance-u" with the unit % "Irradiance, uncertainty (%)".
function labelOf({name, unit = '', label}) {
  if (label) return label;
  const parts = name.split('-');
  const own = parts.length > 1 && kUnits[parts.at(-1)];
  if (own) parts.pop();
  const doubt = parts.length > 1 && parts.at(-1) === 'u';
  if (doubt) parts.pop();
  const words = parts.join(' ');
  const shown = own || kUnits[unit];
  const begun = /^.[A-Z]/.test(words) ? words : words[0].toUpperCase() + words.slice(1);  // dEgdT stays
  return begun + (doubt ? ', uncertainty' : '') + (shown ? ` (${shown})` : '');
}

function fileChoices(holder, names) {
  for (const select of holder.querySelectorAll('select[data-files]')) {
    const chosen = [select.keptValue?.() ?? []].flat();
    const choices = names[select.dataset.files].map((name) => new Option(name, name, false, chosen.includes(name)));
    select.replaceChildren(...(select.multiple ? [] : [new Option('none', '')]), ...choices);
    select.closest('.field').hidden = choices.length === 0;
  }
}

function formFields(rows, values, changed) {
  const say = (tag, text, className) => {
    const element = document.createElement(tag);
    element.textContent = text;
    if (className) element.className = className;
    return element;
  };

  // A choice among files, which fileChoices() fills.
  function fileControl(row) {
    const select = document.createElement('select');
    select.dataset.files = row.kind;
    select.multiple = row.kind === 'curves';
    select.keptValue = () => values[row.name];
    return select;
  }

  function control(row) {
    if (row.kind === 'switch') {
      const box = document.createElement('input');
      box.type = 'checkbox';
      box.checked = values[row.name] === 'yes';
      return box;
    }
    if (row.kind === 'module' || row.kind === 'curves') return fileControl(row);
    if (row.choices.length > 0) {
      const select = document.createElement('select');
      if (!row.choices.includes(row.default)) select.append(new Option('by its name', ''));
      row.choices.forEach((choice, i) => {
        const usual = choice === row.default;
        select.append(new Option(usual ? `${choice} (default)` : row.labels?.[i] ?? choice, usual ? '' : choice));
      });
      select.value = values[row.name] ?? '';
      return select;
    }
    const input = document.createElement(row.kind === 'list' ? 'textarea' : 'input');
    if (row.kind === 'list') input.rows = 2;
    else input.type = 'text';
    if (row.kind === 'number') input.inputMode = 'decimal';
    input.spellcheck = false;
    input.autocomplete = 'off';
    // Infinity and the largest integer mean no limit.
    const none = row.kind === 'number' && !(Math.abs(Number(row.default)) < 1e18);
    input.placeholder = row.placeholder ?? (none ? 'none' : row.default ?? '');
    input.value = [values[row.name] ?? []].flat().join('\n');
    return input;
  }

  function read(row, input) {
    if (row.kind === 'switch') return input.checked ? 'yes' : '';
    if (row.kind === 'curves') return [...input.selectedOptions].map((option) => option.value);
    if (row.kind === 'list') return input.value.split('\n').map((line) => line.trim()).filter(Boolean);
    return input.value.trim();
  }

  formFields.made ??= 0;
  return rows.map((row) => {
    const field = document.createElement('div');
    field.className = 'field';
    field.dataset.name = row.name;
    field.dataset.kind = row.kind;
    const input = control(row);
    input.id = `field-${++formFields.made}`;
    const label = say('label', '');
    label.htmlFor = input.id;
    const words = labelOf(row);
    if (row.kind === 'switch') label.append(input, say('span', words));
    else label.textContent = words;
    field.append(label);
    if (row.kind !== 'switch') field.append(input);
    const range = row.lower !== undefined && row.upper !== undefined ? ` [${row.lower}, ${row.upper}]` : '';
    const doc = (row.kind === 'list' ? `${row.doc}; a line each, ${row.unit}` : row.doc + range)
        .replace(/--([a-z][\w-]*)/g, (flag, name) => labelOf({name}));
    if (!row.brief) {
      const hint = say('p', doc, 'hint');
      hint.id = `${input.id}-hint`;
      input.setAttribute('aria-describedby', hint.id);
      field.append(hint);
    }
    const keep = () => {
      const value = read(row, input);
      if (value.length === 0) delete values[row.name];
      else values[row.name] = value;
    };
    input.addEventListener('input', keep);  // at once: a form may be filled anew while somebody types
    input.addEventListener('change', () => {
      keep();
      changed?.(row.name);
    });
    return field;
  });
}

function formGroups(rows, values) {
  const groups = {};
  for (const row of rows) (groups[row.group] ??= []).push(row);
  return Object.entries(groups).map(([title, some]) => {
    const set = document.createElement('fieldset');
    const legend = document.createElement('legend');
    legend.textContent = title;
    const fields = document.createElement('div');
    fields.className = 'fields';
    fields.append(...formFields(some, values));
    set.append(legend, fields);
    return set;
  });
}
