// The list of files. Defines fileView: list(holder, files, {state, chosen, choose, remove}).
const fileView = (() => {
  function button(words, key, pressed) {
    const made = document.createElement('button');
    made.type = 'button';
    made.append(...words);
    made.dataset.key = key;
    made.addEventListener('click', pressed);
    return made;
  }

  function item(file, {state, chosen, choose, remove}) {
    const name = document.createElement('span');
    name.textContent = file.name;
    const {text, bad} = state(file);
    const told = document.createElement('span');
    told.className = bad ? 'state bad' : 'state';
    told.textContent = text;
    const taking = button([name, told], `name ${file.name}`, () => choose(file));
    taking.className = 'name';
    taking.setAttribute('aria-pressed', String(file === chosen));
    const leaving = button(['Remove'], `remove ${file.name}`, () => remove(file));
    leaving.setAttribute('aria-label', `Remove ${file.name}`);
    const made = document.createElement('li');
    made.append(taking, leaving);
    return made;
  }

  // Fills the list anew, and keeps the keyboard where it was.
  function list(holder, files, does) {
    const focused = holder.contains(document.activeElement) ? document.activeElement.dataset.key : null;
    holder.replaceChildren(...files.map((file) => item(file, does)));
    if (focused) holder.querySelector(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  }

  return {list};
})();
