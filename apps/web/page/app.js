// The page: reads files, shows their content, and runs fits and diagnoses.
(() => {
  const kMostBytes = 64 * 2 ** 20;  // limit of the library's reader
  const kTitles = {fit: 'Fit', diagnose: 'Diagnosis'};
  const element = (id) => document.getElementById(id);

  const files = [];                       // {name, bytes, values, look, results, state}
  const options = {fit: {}, diagnose: {}};  // options for all files
  let chosen = null;
  let shown = 'fit';  // displayed result of the chosen file
  let forms = null;
  let looker = null;  // reads files while `runner` fits
  let runner = null;
  let queue = [];
  let running = null;
  let finished = 0;  // number of fits and diagnoses, including failed ones
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

  function stateOf(file) {
    if (isSidecar(file)) return {text: 'says what holds for its table'};
    if (running?.file === file) return {text: running.verb === 'fit' ? 'is fitted ...' : 'is diagnosed ...'};
    if (queue.some((task) => task.file === file)) return {text: 'waits'};
    const result = file.results[file.latest];
    if (result?.error) return {text: `${kTitles[file.latest]}: error`, bad: true};
    if (result) return {text: result.usable ? `${kTitles[file.latest]}: done` : `${kTitles[file.latest]}: not usable`, bad: !result.usable};
    if (file.look?.error) return {text: 'cannot be read', bad: true};
    if (!file.look) return {text: 'is read ...'};
    const readings = file.look.curves.reduce((sum, curve) => sum + curve.readings, 0);
    return {text: file.look.count > 1 ? `${file.look.count} curves` : `${readings} readings`};
  }

  function listFiles() {
    const focused = document.activeElement?.closest('#files')?.contains(document.activeElement)
        ? document.activeElement.dataset.key : null;
    element('files').replaceChildren(...files.map((file) => {
      const item = document.createElement('li');
      const button = document.createElement('button');
      button.type = 'button';
      button.className = 'name';
      button.dataset.key = `name ${file.name}`;
      button.setAttribute('aria-pressed', String(file === chosen));
      const name = document.createElement('span');
      name.textContent = file.name;
      const {text, bad} = stateOf(file);
      const state = document.createElement('span');
      state.className = bad ? 'state bad' : 'state';
      state.textContent = text;
      button.append(name, state);
      button.addEventListener('click', () => choose(file));
      const remove = document.createElement('button');
      remove.type = 'button';
      remove.textContent = 'Remove';
      remove.dataset.key = `remove ${file.name}`;
      remove.setAttribute('aria-label', `Remove ${file.name}`);
      remove.addEventListener('click', () => removeFile(file));
      item.append(button, remove);
      return item;
    }));
    if (focused) element('files').querySelector(`[data-key="${CSS.escape(focused)}"]`)?.focus();
    const measurements = files.filter((file) => !isSidecar(file));
    element('for-all').hidden = measurements.length < 2;
    element('every-file').hidden = measurements.length < 2;
  }

  function forget(file) {
    queue = queue.filter((task) => task.file !== file);
    if (running?.file === file) runner.stop('was removed');
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

  function ownValues(file) {
    return Object.fromEntries(Object.entries(file.values).filter(([, value]) => value.length > 0));
  }

  async function look(file) {
    const said = ownValues(file);
    file.lookedWith = JSON.stringify(said);
    ++looking;
    const answer = await looker.run({verb: 'look', file: file.name, options: said});
    --looking;
    if (!files.includes(file)) return;
    file.look = {curves: [], columns: [], assumptions: [], ...answer};
    listFiles();
    if (file === chosen) showRead();
  }

  // A field that was filled anew while somebody typed does not tell that it has changed.
  function lookIfChanged() {
    if (chosen?.look && JSON.stringify(ownValues(chosen)) !== chosen.lookedWith) look(chosen);
  }

  function lookAtAll() {
    for (const file of files) if (!isSidecar(file)) look(file);
  }

  function showRead() {
    const file = chosen;
    const here = file !== null && file.look !== null && !isSidecar(file);
    element('read').hidden = element('work').hidden = !here;
    if (!here) return;
    const {look: found} = file;
    element('read-title').textContent = `What was read: ${file.name}`;
    readView.showError(element('read-error'), found.error ? {text: found.error, line: found.line} : null, file);
    found.picture ??= found.picture_html ? reportView.pictureOf(found.picture_html) : null;
    if (element('picture').firstChild !== found.picture) element('picture').replaceChildren(...(found.picture ? [found.picture] : []));
    element('picture').hidden = !found.picture;
    readView.fill(element('conditions'), readView.conditionFields(file, forms.fit, () => look(file)));
    readView.fill(element('reading'), readView.readingFields(file, forms.fit, () => look(file)));
    element('columns').replaceChildren(...(found.columns.length > 0 ? [readView.columnTable(found.columns)] : []));
    element('assumptions').replaceChildren(...found.assumptions.map((sentence) => {
      const item = document.createElement('li');
      item.textContent = sentence;
      return item;
    }));
    for (const button of element('verbs').querySelectorAll('button')) button.disabled = running !== null;
  }

  function choose(file) {
    chosen = file;
    if (file?.latest) shown = file.latest;
    listFiles();
    showRead();
    showResult();
  }

  // Options of all files ------------------------------------------------------------------------

  function showOptions() {
    const names = {};
    for (const verb of ['fit', 'diagnose']) {
      for (const row of forms[verb]) {
        if (readView.isOwn(row)) continue;
        const title = verb === 'fit' ? `Fit: ${row.group.toLowerCase()}` : 'Diagnosis';
        (names[title] ??= {verb, rows: []}).rows.push(row);
      }
    }
    element('options').replaceChildren(...Object.entries(names).map(([title, {verb, rows}]) => {
      const set = document.createElement('fieldset');
      const legend = document.createElement('legend');
      legend.textContent = title;
      const fields = document.createElement('div');
      fields.className = 'fields';
      fields.append(...formFields(rows, options[verb]));
      set.append(legend, fields);
      return set;
    }));
  }

  // Work ----------------------------------------------------------------------------------------

  function begin(verb) {
    const every = element('every').checked && !element('every-file').hidden;
    const which = every ? files.filter((file) => !isSidecar(file)) : [chosen];
    queue.push(...which.map((file) => ({verb, file})));
    if (!running) next();
  }

  // Options of a verb for a file, without those that the verb does not have.
  function saidOf(file, verb) {
    const names = new Set(forms[verb].map((row) => row.name));
    const own = Object.entries(ownValues(file)).filter(([name]) => names.has(name));
    return {...options[verb], ...Object.fromEntries(own)};
  }

  async function next() {
    running = queue.shift() ?? null;
    showRunning();
    listFiles();
    showRead();
    if (!running) return;
    const task = running;
    const started = performance.now();
    const clock = setInterval(() => {
      element('seconds').textContent = `${((performance.now() - started) / 1000).toFixed(0)} s`;
    }, 200);
    const answer = await runner.run(
        {verb: task.verb, file: task.file.name, options: saidOf(task.file, task.verb)}, showProgress);
    clearInterval(clock);
    if (!answer.stopped && files.includes(task.file)) {
      answer.seconds = (performance.now() - started) / 1000;
      answer.name = stem(task.file.name);
      task.file.results[task.verb] = answer;
      task.file.latest = task.verb;
      if (task.file === chosen) {
        shown = task.verb;
        showResult();
        element('result-title').focus();
      }
    }
    if (!answer.stopped) finished += 1;
    next();
  }

  function showRunning() {
    element('running').hidden = running === null;
    if (!running) return;
    element('stage').textContent = `${running.file.name}: ${running.verb === 'fit' ? 'the fit' : 'the diagnosis'} begins`;
    element('seconds').textContent = '';
    element('progress').removeAttribute('value');
  }

  function showProgress({stage, part}) {
    const words = `${running.file.name}: ${stage}`;
    if (element('stage').textContent !== words) element('stage').textContent = words;
    if (part > 0) element('progress').value = Math.min(1, part);
    else element('progress').removeAttribute('value');
  }

  function cancel() {
    queue = [];
    runner.stop('was cancelled');
    element('verbs').querySelector('button').focus();
  }

  // Results -------------------------------------------------------------------------------------

  function showResult() {
    const results = chosen?.results ?? {};
    const verbs = Object.keys(kTitles).filter((verb) => results[verb]);
    element('result').hidden = verbs.length === 0;
    if (verbs.length === 0) {
      element('report').replaceChildren();
      return;
    }
    if (!results[shown]) shown = verbs[0];
    const result = results[shown];
    element('result-title').textContent = `${kTitles[shown]} of ${result.name}`;
    element('which').replaceChildren(...(verbs.length < 2 ? [] : verbs.map((verb) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = kTitles[verb];
      button.setAttribute('aria-pressed', String(verb === shown));
      button.addEventListener('click', () => {
        shown = verb;
        showResult();
        element('which').querySelector('[aria-pressed=true]').focus();
      });
      return button;
    })));
    readView.showError(element('result-error'), result.error ? {text: result.error, line: result.line} : null, chosen);
    const fine = !result.error;
    element('downloads').hidden = !fine;
    say('summary', fine ? `Done in ${result.seconds < 1 ? result.seconds.toFixed(2) : result.seconds.toFixed(1)} s.` : '');
    element('report').replaceChildren(...(fine ? [reportView.frameOf(result)] : []));
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
      button.addEventListener('click', async () => addAll(await examples(button.dataset.example)));
    }
    for (const button of document.querySelectorAll('[data-verb]')) {
      button.addEventListener('click', () => begin(button.dataset.verb));
    }
    for (const button of document.querySelectorAll('[data-save]')) {
      button.addEventListener('click', () => reportView.save(chosen.results[shown], shown, button.dataset.save));
    }
    for (const id of ['conditions', 'reading']) element(id).addEventListener('focusout', lookIfChanged);
    element('print').addEventListener('click', () => element('report').firstChild.contentWindow.print());
    element('cancel').addEventListener('click', cancel);
    element('for-all').addEventListener('click', () => {
      for (const file of files) {
        if (file !== chosen && !isSidecar(file)) file.values = {...chosen.values};
      }
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
