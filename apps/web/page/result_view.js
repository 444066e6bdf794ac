// The results of the page. Defines resultView({common, chosen, fieldOf, showReadError}): show(verb, focus), here(), shown().
function resultView({common, chosen, fieldOf, showReadError}) {
  const element = (id) => document.getElementById(id);
  let shown = 'fit';  // of the chosen file, or of no file alone

  const here = () => ({...chosen()?.results, ...common.results});

  function whichButton(verb) {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = verbs.all[verb].title;
    button.setAttribute('aria-pressed', String(verb === shown));
    button.addEventListener('click', () => {
      show(verb);
      element('which').querySelector('[aria-pressed=true]').focus();
    });
    return button;
  }

  // An error stands at the field that it asks for, or above the result; what reading has said already is not repeated.
  // Returns whether it stands elsewhere.
  function showError(result, focus) {
    asked.clear(element('main'));
    const file = chosen();
    const read = showReadError();
    const known = Boolean(result.error) && result.error === file?.look?.error;
    const own = asked.show(element('result-error'), result.error && !known ? result : null, file, fieldOf(shown));
    const field = known ? read : own;
    if (focus && field) asked.goTo(field);
    else if (focus) element(known ? 'read-title' : 'result-title').focus();
    return known || field !== null;
  }

  function show(verb, focus = false) {
    shown = verb ?? shown;
    const results = here();
    const all = verbs.names.filter((each) => results[each]);
    element('result').hidden = all.length === 0;
    if (all.length === 0) {
      element('report').replaceChildren();
      return;
    }
    if (!results[shown]) [shown] = all;
    const result = results[shown];
    const fine = !result.error;
    element('result-title').textContent = `${verbs.all[shown].title} of ${result.name}`;
    element('which').replaceChildren(...(all.length < 2 ? [] : all.map(whichButton)));
    element('downloads').hidden = !fine;
    element('downloads').querySelector('[data-save=pvlib]').hidden = !result.pvlib_json;
    const frame = fine ? reportView.frameOf(result) : null;
    const find = fieldOf(shown);
    frame?.addEventListener('load', () => asked.within(frame, find));
    element('report').replaceChildren(...(frame ? [frame] : []));
    const elsewhere = showError(result, focus);
    element('result').hidden = elsewhere && all.length === 1;
    const seconds = fine && result.seconds.toFixed(result.seconds < 1 ? 2 : 1);
    element('summary').textContent = fine ? `Done in ${seconds} s.` : elsewhere ? 'It asks for a field above.' : '';
  }

  return {show, here, shown: () => shown};
}
