// Display of a file's content. Defines readView: elements for its forms and its columns.
const readView = (() => {
  const kOwnGroups = ['Conditions', 'Reading'];  // groups of options that are set for each file
  const kMainFields = {
    cells: {label: 'Cells in series'},
    'temperature-C': {label: 'Cell temperature (°C)'},
    'irradiance-Wm2': {},
  };
  const kKnown = {cells: 'cells', 'temperature-C': 'temperature_C', 'irradiance-Wm2': 'irradiance_Wm2'};

  function conditionFields(file, form, changed) {
    const rows = form.filter((row) => kMainFields[row.name]).map((row) => {
      const values = (file.look?.curves ?? []).map((curve) => curve[kKnown[row.name]]);
      const one = values.length > 0 && values.every((value) => value === values[0]) ? values[0] : null;
      const among = values.length > 1 && one === null && !values.includes(null);
      const placeholder = one === null ? among ? 'as in the file' : 'not in the file' : String(Number(one.toPrecision(6)));
      return {...row, ...kMainFields[row.name], placeholder, brief: true, unknown: one === null && !among};
    });
    const fields = formFields(rows, file.values, changed);
    const known = (file.look?.curves ?? []).length > 0;
    fields.forEach((field, i) => field.classList.toggle('unknown', rows[i].unknown && known));
    return fields;
  }

  function columnTable(columns) {
    const table = document.createElement('table');
    const head = table.createTHead().insertRow();
    for (const words of ['Column', 'Name', 'Read as']) {
      const cell = document.createElement('th');
      cell.scope = 'col';
      cell.textContent = words;
      head.append(cell);
    }
    const body = table.createTBody();
    for (const {place, name, use} of columns) {
      const row = body.insertRow();
      for (const text of [place, name, use]) row.insertCell().textContent = text;
    }
    const box = document.createElement('div');
    box.className = 'box';
    box.tabIndex = 0;
    box.setAttribute('role', 'group');
    box.setAttribute('aria-label', 'Columns of the table');
    box.append(table);
    return box;
  }

  // Fields for reading; columns are chosen from those of the file.
  function readingFields(file, form, changed) {
    const columns = file.look?.columns ?? [];
    const rows = form.filter((row) => kOwnGroups.includes(row.group) && !kMainFields[row.name]).map((row) => {
      const takesColumn = ['voltage-column', 'current-column'].includes(row.name) && columns.length > 0;
      return !takesColumn ? row : {...row, choices: columns.map(({place}) => String(place)),
                                   labels: columns.map(({place, name}) => `${place} ${name}`)};
    });
    return formFields(rows, file.values, changed);
  }

  // Replaces a form's fields and restores the keyboard focus and the selected text.
  function fill(holder, fields) {
    const old = holder.contains(document.activeElement) ? document.activeElement : null;
    const selected = old?.type === 'text' ? [old.selectionStart, old.selectionEnd] : null;
    holder.replaceChildren(...fields);
    if (!old) return;
    const name = old.closest('.field').dataset.name;
    const input = holder.querySelector(`[data-name="${name}"] :is(input, select, textarea)`);
    input?.focus();
    if (selected && input?.type === 'text') input.setSelectionRange(...selected);
  }

  return {isOwn: (row) => kOwnGroups.includes(row.group), conditionFields, readingFields, columnTable, fill};
})();
