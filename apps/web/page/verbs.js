// What the page can be asked for. Defines verbs: their titles and files, and saidOf(task, forms, options), labelOf(task).
const verbs = (() => {
  // `files`: of which files a run is: one, all as one, or none.
  const all = {
    fit: {title: 'Fit', runs: 'is fitted ...', files: 'one'},
    diagnose: {title: 'Diagnosis', runs: 'is diagnosed ...', files: 'one'},
    translate: {title: 'Translation', runs: 'is translated ...', files: 'one'},
    cell: {title: 'Cell', runs: 'is described ...', files: 'all'},
    datasheet: {title: 'Data sheet', runs: '', files: 'none'},
  };

  // Texts of a file's own fields.
  const ownValues = (file) => Object.fromEntries(Object.entries(file.values).filter(([, value]) => value.length > 0));

  // Options of a run, without those that the verb does not have. Files of one cell must not contradict each other.
  function saidOf({verb, files}, forms, options) {
    const names = new Set(forms[verb].map((row) => row.name));
    const own = {};
    for (const file of files) {
      for (const [name, value] of Object.entries(ownValues(file))) {
        if (!names.has(name)) continue;
        if (name in own && String(own[name]) !== String(value)) {
          throw new Error(`${name}: ${own[name]} and ${value} are said of two files of one cell: say one of all`);
        }
        own[name] = value;
      }
    }
    const further = options[verb]['with-curve']?.filter((name) => name !== files[0].name);
    return {...options[verb], ...(further ? {'with-curve': further} : {}), ...own};
  }

  const labelOf = ({verb, files}) => files.map(({name}) => name).join(' + ') || all[verb].title;

  return {all, names: Object.keys(all), ownValues, saidOf, labelOf};
})();
