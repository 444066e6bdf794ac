// Forms from the engine's description of its option tables. Defines formFields(rows, values, changed): one element for
// every row, which updates `values` on input.
function formFields(rows, values, changed) {
  const say = (tag, text, className) => {
    const element = document.createElement(tag);
    element.textContent = text;
    if (className) element.className = className;
    return element;
  };

  function control(row) {
    if (row.kind === 'switch') {
      const box = document.createElement('input');
      box.type = 'checkbox';
      box.checked = values[row.name] === 'yes';
      return box;
    }
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
    const words = row.label ?? row.name;
    if (row.kind === 'switch') label.append(input, say('span', words));
    else label.textContent = words;
    field.append(label);
    if (row.kind !== 'switch') field.append(input);
    const range = row.lower !== undefined && row.upper !== undefined ? ` [${row.lower}, ${row.upper}]` : '';
    const doc = row.kind === 'list' ? `${row.doc}; a line each, ${row.unit}` : row.doc + range;
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
