// The page: reads files, shows their content, and runs the verbs.
(() => {
  const kMostBytes = 64 * 2 ** 20;  // limit of the library's reader
  const element = (id) => document.getElementById(id);

  const files = [];                       // {name, bytes, values, look, results, state}
  const common = {results: {}};           // results of no file alone
  const options = Object.fromEntries(verbs.names.map((verb) => [verb, {}]));  // for all files
  let chosen = null;
  let forms = null;
  let looker = null;  // reads files while `runner` fits
  let runner = null;
  let queue = [];
  let running = null;
  let finished = 0;  // number of runs, including failed ones
  let looking = 0;   // number of files that are being read

  function say(id, text) {
    element(id).textContent = text;
    element(id).hidden = !text;
  }

  // Files ---------------------------------------------------------------------------------------

  // NAME.json beside NAME.csv gives its conditions, as for files on disk.
  const stem = (name) => name.replace(/\.[^.]*$/, '');
  const isSidecar = (file) => /\.json$/i.test(file.name) &&
      files.some((other) => other !== file && !/\.json$/i.test(other.name) && stem(other.name) === stem(file.name));

  const isModule = (file) => Boolean(file.look?.module || file.look?.sheet);
  const measurements = () => files.filter((file) => !isSidecar(file) && !isModule(file));
  const holds = (task, file) => Boolean(task?.files.includes(file));

  function stateOf(file) {
    if (isSidecar(file)) return {text: 'says what holds for its table'};
    if (holds(running, file)) return {text: verbs.all[running.verb].runs};
    if (queue.some((task) => holds(task, file))) return {text: 'waits'};
    const result = file.results[file.latest];
    const title = verbs.all[file.latest]?.title;
    if (result?.error) return {text: `${title}: error`, bad: true};
    if (result) return {text: result.usable ? `${title}: done` : `${title}: not usable`, bad: !result.usable};
    if (file.look?.error) return {text: 'cannot be read', bad: true};
    if (!file.look) return {text: 'is read ...'};
    if (isModule(file)) return {text: 'sheet of a module'};
    const readings = file.look.curves.reduce((sum, curve) => sum + curve.readings, 0);
    return {text: file.look.count > 1 ? `${file.look.count} curves` : `${readings} readings`};
  }

  // The fields that choose among files. A sheet of a module is taken at once, and left with its file.
  function offerFiles() {
    const names = (which) => which.map((file) => file.name);
    const sheets = files.filter((file) => file.look?.sheet);
    const modules = files.filter((file) => file.look?.module);
    for (const [verb, fitting] of [['translate', modules], ['datasheet', sheets]]) {
      const {module, 'with-curve': further} = options[verb];
      if (module && !names(files).includes(module)) delete options[verb].module;
      if (further) options[verb]['with-curve'] = further.filter((name) => names(files).includes(name));
      fileChoices(element(`options-of-${verb}`), {module: names(fitting), curves: names(measurements().filter((file) => file !== chosen))});
    }
  }

  function listFiles() {
    fileView.list(element('files'), files, {state: stateOf, chosen, choose, remove: removeFile});
    const several = measurements().length > 1;
    element('for-all').hidden = element('every-file').hidden = !several;
    offerFiles();
  }

  function forget(file) {
    queue = queue.filter((task) => !holds(task, file));
    if (holds(running, file)) runner.stop('was removed');
    files.splice(files.indexOf(file), 1);
  }

  function removeFile(file) {
    forget(file);
    looker.remove(file.name);
    runner.remove(file.name);
    if (chosen === file) choose(files[0] ?? null);
    else listFiles();
    element('choose').focus();
    lookAtAll();
  }

  // Converts a name to one that is allowed in a folder.
  const fileName = (name) => name.replace(/[/\\\0]/g, '_').replace(/^\.+$/, '_') || 'measurement';

  function addFile(name, bytes) {
    const known = files.find((file) => file.name === name);
    if (known) forget(known);
    const file = {name, bytes, values: {...known?.values}, look: null, results: {}, latest: null};
    files.push(file);
    looker.write(name, bytes);
    runner.write(name, bytes);
    return file;
  }

  async function addAll(list) {
    say('trouble', '');
    const added = [];
    for (const each of list) {
      if (each.size > kMostBytes) {
        say('trouble', `${each.name}: the file has ${Math.round(each.size / 2 ** 20)} MB, and 64 MB are the most ` +
                       'that the page takes: leave out what is no curve, or use the command.');
        continue;
      }
      try {
        added.push(addFile(fileName(each.name), new Uint8Array(await each.arrayBuffer())));
      } catch {
        say('trouble', `${each.name}: cannot be read: a folder, or a file that is gone. Drop the files of a folder.`);
      }
    }
    const first = added.find((file) => !isSidecar(file)) ?? added[0];
    if (!first) return;
    lookAtAll();  // the new file may be the sidecar of a table
    choose(first);
  }

  async function examples(name) {
    const all = await lyrefit.data('examples');
    return Object.entries(all).filter(([each]) => stem(each) === stem(name))
        .map(([each, text]) => new File([text], each));
  }

  // Content of files ----------------------------------------------------------------------------

  async function look(file) {
    const said = verbs.ownValues(file);
    file.lookedWith = JSON.stringify(said);
    ++looking;
    const all = files.filter((each) => !isSidecar(each)).map(({name}) => name);
    const answer = await looker.run({verb: 'look', file: file.name, files: all, options: said});
    --looking;
    if (!files.includes(file)) return;
    const first = file.look === null;
    file.look = {curves: [], columns: [], assumptions: [], ...answer};
    const isOver = (of) => (verb) => of[verb]?.error && verb !== 'datasheet' && delete of[verb];
    const over = [file.results, common.results].flatMap((of) => verbs.names.filter(isOver(of)));  // errors of what was said before
    if (!file.results[file.latest]) file.latest = Object.keys(file.results).at(-1) ?? null;
    if (first && isModule(file)) takeModule(file);
    listFiles();
    if (file === chosen) {
      showRead();
      if (over.length > 0) results.show();
    }
  }

  // The sheet of a module serves the translation of a curve and the data sheet's form.
  function takeModule(file) {
    if (file.look.module) options.translate.module ??= file.name;
    if (file.look.sheet) {
      options.datasheet.module ??= file.name;
      openSheet(true);
    }
    if (file === chosen && measurements().length > 0) choose(measurements()[0]);
  }

  // A field that was filled anew while somebody typed does not tell that it has changed.
  function lookIfChanged() {
    if (chosen?.look && JSON.stringify(verbs.ownValues(chosen)) !== chosen.lookedWith) look(chosen);
  }

  function lookAtAll() {
    for (const file of files) if (!isSidecar(file)) look(file);
  }

  // The field of an option, for a message of this verb; null: it has none.
  const fieldOf = (verb) => (name) => {
    const places = verbs.all[verb].files === 'none' ? [] : ['conditions', 'reading'];
    return [...places, `options-of-${verb}`].map(element).map(
        (place) => place.querySelector(`[data-name="${CSS.escape(name)}"]`)).find(Boolean) ?? null;
  };

  const showReadError = () => asked.show(element('read-error'), chosen?.look?.error ? chosen.look : null, chosen, fieldOf('fit'));
  const results = resultView({common, chosen: () => chosen, fieldOf, showReadError});

  function showRead() {
    const file = chosen;
    const here = file !== null && file.look !== null && !isSidecar(file);
    element('read').hidden = !here;
    element('work').hidden = !here || isModule(file);
    if (!here) return;
    const {look: found} = file;
    element('read-title').textContent = `What was read: ${file.name}`;
    found.picture ??= found.picture_html ? reportView.pictureOf(found.picture_html) : null;
    if (element('picture').firstChild !== found.picture) element('picture').replaceChildren(...(found.picture ? [found.picture] : []));
    element('picture').hidden = !found.picture;
    element('of-curves').hidden = isModule(file);
    readView.fill(element('conditions'), readView.conditionFields(file, forms.fit, () => look(file)));
    readView.fill(element('reading'), readView.readingFields(file, forms.fit, () => look(file)));
    element('columns').replaceChildren(...(found.columns.length > 0 ? [readView.columnTable(found.columns)] : []));
    element('assumptions').replaceChildren(...found.assumptions.map((sentence) => {
      const item = document.createElement('li');
      item.textContent = sentence;
      return item;
    }));
    const field = showReadError();
    if (field && !document.activeElement.matches('input, select, textarea')) asked.goTo(field);
  }

  function choose(file) {
    chosen = file;
    listFiles();
    showRead();
    results.show(file?.latest);
  }

  // Options of all files ------------------------------------------------------------------------

  function showOptions() {
    for (const verb of verbs.names) {
      const rows = forms[verb].filter((row) => verbs.all[verb].files === 'none' || !readView.isOwn(row));
      element(`options-of-${verb}`).replaceChildren(...formGroups(rows, options[verb]));
    }
  }

  function openSheet(open) {
    element('sheet').hidden = !open;
    element('open-sheet').setAttribute('aria-expanded', String(open));
  }

  // Work ----------------------------------------------------------------------------------------

  function begin(verb) {
    const every = element('every').checked && !element('every-file').hidden;
    const of = {one: () => (every ? measurements() : [chosen]).map((file) => [file]), all: () => [measurements()], none: () => [[]]};
    queue.push(...of[verbs.all[verb].files]().map((some) => ({verb, files: some})));
    if (!running) next();
  }

  async function answerOf(task) {
    try {
      const names = task.files.map(({name}) => name);
      return await runner.run({verb: task.verb, file: names[0] ?? '', files: names, options: verbs.saidOf(task, forms, options)}, showProgress);
    } catch (error) {
      return {error: error.message};
    }
  }

  async function next() {
    running = queue.shift() ?? null;
    showRunning();
    listFiles();
    if (!running) return;
    const task = running;
    const started = performance.now();
    const clock = setInterval(() => {
      element('seconds').textContent = `${((performance.now() - started) / 1000).toFixed(0)} s`;
    }, 200);
    const answer = await answerOf(task);
    clearInterval(clock);
    if (!answer.stopped && task.files.every((file) => files.includes(file))) {
      answer.seconds = (performance.now() - started) / 1000;
      answer.name ??= stem(verbs.labelOf(task));
      const alone = verbs.all[task.verb].files === 'one' ? task.files[0] : null;
      (alone ?? common).results[task.verb] = answer;
      if (alone) alone.latest = task.verb;
      if (!alone || alone === chosen) results.show(task.verb, true);
    }
    if (!answer.stopped) finished += 1;
    next();
  }

  function showRunning() {
    for (const button of document.querySelectorAll('[data-verb]')) button.disabled = running !== null;
    element('running').hidden = running === null;
    if (!running) return;
    element('stage').textContent = `${verbs.labelOf(running)}: begins`;
    element('seconds').textContent = '';
    element('progress').removeAttribute('value');
  }

  function showProgress({stage, part}) {
    const words = `${verbs.labelOf(running)}: ${stage}`;
    if (element('stage').textContent !== words) element('stage').textContent = words;
    if (part > 0) element('progress').value = Math.min(1, part);
    else element('progress').removeAttribute('value');
  }

  function cancel() {
    queue = [];
    runner.stop('was cancelled');
    (chosen ? element('verbs') : element('sheet')).querySelector('[data-verb]').focus();
  }

  // Start ---------------------------------------------------------------------------------------

  function takePaste(text) {
    if (!text.trim()) {
      say('trouble', 'There is nothing to take: copy rows of voltage and current from a spreadsheet first.');
      return;
    }
    const taken = files.filter((file) => /^pasted/.test(file.name)).length;
    addAll([new File([text], taken === 0 ? 'pasted.txt' : `pasted_${taken + 1}.txt`)]);
  }

  function listen() {
    element('choose').addEventListener('click', () => element('file').click());
    element('file').addEventListener('change', async (event) => {
      await addAll([...event.target.files]);
      event.target.value = '';
    });
    addEventListener('dragover', (event) => {
      event.preventDefault();
      element('drop').classList.add('over');
    });
    for (const name of ['dragleave', 'drop', 'dragend']) {
      addEventListener(name, () => element('drop').classList.remove('over'));
    }
    addEventListener('drop', (event) => {
      event.preventDefault();
      addAll([...event.dataTransfer.files]);
    });
    element('open-paste').addEventListener('click', () => {
      element('paste').hidden = !element('paste').hidden;
      element('open-paste').setAttribute('aria-expanded', String(!element('paste').hidden));
      if (!element('paste').hidden) element('pasted').focus();
    });
    element('take-paste').addEventListener('click', () => {
      takePaste(element('pasted').value);
      element('pasted').value = '';
    });
    addEventListener('paste', (event) => {
      if (event.target.closest?.('input, textarea')) return;
      const pasted = event.clipboardData.files;
      if (pasted.length > 0) addAll([...pasted]);
      else takePaste(event.clipboardData.getData('text/plain'));
    });
    for (const button of document.querySelectorAll('[data-example]')) {
      button.addEventListener('click', async () => addAll((await Promise.all(
          button.dataset.example.split(' ').map(examples))).flat()));
    }
    for (const button of document.querySelectorAll('[data-verb]')) {
      button.addEventListener('click', () => begin(button.dataset.verb));
    }
    for (const button of document.querySelectorAll('[data-save]')) {
      button.addEventListener('click', () => reportView.save(results.here()[results.shown()], results.shown(), button.dataset.save));
    }
    element('open-sheet').addEventListener('click', () => {
      openSheet(element('sheet').hidden);
      if (!element('sheet').hidden) element('sheet').querySelector('input').focus();
    });
    addEventListener('input', ({target}) => asked.clear(target.closest('.field') ?? target));
    for (const id of ['conditions', 'reading']) element(id).addEventListener('focusout', lookIfChanged);
    element('print').addEventListener('click', () => element('report').firstChild.contentWindow.print());
    element('cancel').addEventListener('click', cancel);
    element('for-all').addEventListener('click', () => {
      for (const file of measurements()) file.values = {...chosen.values};
      lookAtAll();
    });
    element('licences').addEventListener('toggle', async () => {
      element('licences').querySelector('pre').textContent = await lyrefit.data('licences');
    }, {once: true});
    lyrefit.onTheme(() => document.querySelectorAll('iframe').forEach(reportView.followTheme));
  }

  // A browser compiles a function at its first call, which takes longer than a whole fit. An example is therefore
  // fitted at page load. All its requests are sent before the page accepts files, so that no user's file comes between.
  function warmUp(all) {
    const names = ['rtc_france.csv', 'rtc_france.json'];
    for (const name of names) runner.write(name, new TextEncoder().encode(all[name]));
    const done = runner.run({verb: 'fit', file: names[0], options: {}});
    for (const name of names) runner.remove(name);
    return done;
  }

  async function start() {
    if (typeof WebAssembly === 'undefined' || typeof DecompressionStream === 'undefined') {
      say('trouble', 'This browser is too old for the page: it needs one of 2023 or later.');
      return;
    }
    let warm;
    try {
      const parts = await engineParts();
      looker = new Engine(parts);
      runner = new Engine(parts);
      ({forms} = await looker.run({verb: 'about'}));
      warm = warmUp(await lyrefit.data('examples'));
    } catch (error) {
      say('trouble', `The page could not begin: ${error.message}`);
      return;
    }
    showOptions();
    listen();
    await warm;
    document.documentElement.dataset.engine = 'ready';
  }

  // Interface for the tests of the page.
  globalThis.lyrefitPage = {files, engines: () => [looker, runner], finished: () => finished, looking: () => looking};
  start();
})();
