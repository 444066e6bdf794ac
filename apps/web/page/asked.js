// Fields that a message asks for. The library names an option in its messages ("give the area with --area-cm2"); the
// page names the field instead and leads to it. Defines asked: show(box, error, file, fieldOf),
// clear(holder), goTo(field), within(frame, fieldOf).
const asked = (() => {
  // An option with its dashes, or the one that the message begins with.
  const kOption = /^[A-Za-z][\w-]*(?=:| =| is )|--[A-Za-z][\w-]*/g;
  const kFlag = /--[A-Za-z][\w-]*/g;

  const labelled = (field) => field.querySelector('label').textContent;
  const inputOf = (field) => field.querySelector('input, select, textarea');

  // Opens what a field lies in, and goes there.
  function goTo(field) {
    for (let at = field.closest('details'); at; at = at.parentElement.closest('details')) at.open = true;
    field.closest('section').hidden = false;
    inputOf(field).focus();
  }

  // The text as nodes of a document, in which every option that has a field is a button that leads to it.
  function linked(text, fieldOf, pattern = kOption, into = document) {
    const nodes = [];
    let end = 0;
    for (const match of text.matchAll(pattern)) {
      const field = fieldOf(match[0].replace(/^--/, ''));
      if (!field) continue;
      const button = into.createElement('button');
      button.type = 'button';
      button.className = 'link';
      button.textContent = labelled(field);
      button.addEventListener('click', () => goTo(field));
      nodes.push(text.slice(end, match.index), button);
      end = match.index + match[0].length;
    }
    return [...nodes, text.slice(end)];
  }

  // The line of the file that an error refers to.
  function excerpt(line, file) {
    const text = line > 0 && file && new TextDecoder('utf-8').decode(file.bytes).split('\n')[line - 1];
    if (!text) return [];
    const at = document.createElement('mark');
    at.textContent = text.slice(0, 300).replace(/\r$/, '');
    const shown = document.createElement('p');
    shown.className = 'excerpt';
    shown.append(`Line ${line}: `, at);
    return [shown];
  }

  // Takes a message away from its field.
  function clear(holder) {
    for (const message of holder.querySelectorAll('.field > .asked')) {
      const input = inputOf(message.parentElement);
      input.removeAttribute('aria-invalid');
      input.setAttribute('aria-describedby', (input.getAttribute('aria-describedby') ?? '').replace(message.id, '').trim());
      if (!input.getAttribute('aria-describedby')) input.removeAttribute('aria-describedby');
      message.remove();
    }
  }

  // Shows an error once: at the first field that it names, or else in `box`. Returns that field. `fieldOf` gives the field
  // of an option's name; null: none.
  function show(box, error, file, fieldOf) {
    box.hidden = true;
    box.replaceChildren();
    if (!error) return null;
    const {error: whole, message = whole, line} = error;
    const before = whole.endsWith(message) ? whole.slice(0, whole.length - message.length) : '';
    const words = before ? message : whole;
    const sentence = document.createElement('strong');
    sentence.append(before, ...linked(words, fieldOf));
    const names = [...words.matchAll(kOption)].map(([name]) => name.replace(/^--/, ''));
    const field = names.map(fieldOf).find(Boolean) ?? null;
    let holder = box;
    if (field) {
      clear(field);
      holder = document.createElement('div');
      holder.className = 'asked';
      holder.setAttribute('role', 'alert');
      const input = inputOf(field);
      holder.id = `${input.id}-asked`;
      input.setAttribute('aria-invalid', 'true');
      input.setAttribute('aria-describedby', `${input.getAttribute('aria-describedby') ?? ''} ${holder.id}`.trim());
      field.append(holder);
    }
    holder.append(sentence, ...excerpt(line, file));
    holder.hidden = false;
    return field;
  }

  // The report in a frame asks for fields of the page too.
  function within(frame, fieldOf) {
    const page = frame.contentDocument;
    const walker = page.createTreeWalker(page.body, NodeFilter.SHOW_TEXT);
    const found = [];
    while (walker.nextNode()) {
      const {currentNode: node} = walker;
      if (node.data.includes('--') && !node.parentElement.closest('script, style, svg, pre, code, footer')) found.push(node);
    }
    for (const node of found) node.replaceWith(...linked(node.data, fieldOf, kFlag, page));
  }

  return {show, clear, goTo, within};
})();
