// Display and saving of a report. Defines reportView: frameOf(result), pictureOf(html), followTheme(frame), save(result, verb, what).
const reportView = (() => {
  function followHeight(frame) {
    const page = frame.contentDocument;
    const fit = () => { frame.style.height = `${page.body.getBoundingClientRect().height + 40}px`; };
    new ResizeObserver(fit).observe(page.body);
    fit();
  }

  // Gives the report the theme of the page.
  function followTheme(frame) {
    const wanted = document.documentElement.dataset.theme;
    const page = frame.contentDocument;
    const button = page?.querySelector('[data-page=theme]');
    if (!button || wanted === undefined) return;
    const {theme} = page.documentElement.dataset;
    const now = theme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
    if (now !== wanted) button.click();
  }

  // A frame with a page, without some of its elements, as high as its content.
  function frameWith(title, html, without) {
    const frame = document.createElement('iframe');
    frame.title = title;
    frame.srcdoc = html;
    frame.addEventListener('load', () => {
      for (const each of frame.contentDocument.querySelectorAll(without)) each.hidden = true;
      followTheme(frame);
      followHeight(frame);
    });
    return frame;
  }

  // The report; the page has tools of its own.
  const frameOf = (result) => frameWith(`Report of ${result.name}`, result.page_html, 'header .tools');

  // The picture of the readings; screen readers alone get its heading.
  function pictureOf(html) {
    const frame = frameWith('Picture of the readings', html, '.skip, header .tools, footer');
    frame.addEventListener('load', () => frame.contentDocument.querySelector('header').classList.add('skip'));
    return frame;
  }

  const kSaves = {
    page: ['html', 'text/html', (result) => result.page_html],
    json: ['json', 'application/json', (result) => result.report_json],
    csv: ['csv', 'text/csv', (result) => result.csv],
    text: ['txt', 'text/plain', (result) => result.text],
    pvlib: ['pvlib.json', 'application/json', (result) => result.pvlib_json],
  };

  function save(result, verb, what) {
    const [extension, type, make] = kSaves[what];
    const url = URL.createObjectURL(new Blob([make(result)], {type}));
    lyrefit.save(`${result.name.replace(/[^\p{L}\p{N}.-]+/gu, '_')}_${verb}.${extension}`, url);
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }

  // A frame would be cut between the sheets of paper, so the report's elements stand in the page while it is printed.
  addEventListener('beforeprint', () => {
    const frame = document.querySelector('#report iframe');
    if (!frame) return;
    const paper = document.createElement('div');
    paper.id = 'paper';
    frame.contentWindow.dispatchEvent(new Event('beforeprint'));  // charts in the light theme
    paper.append(...frame.contentDocument.body.cloneNode(true).children);
    frame.contentWindow.dispatchEvent(new Event('afterprint'));
    for (const script of paper.querySelectorAll('script')) script.remove();
    document.body.append(paper);
    document.body.classList.add('on-paper');
  });
  addEventListener('afterprint', () => {
    document.getElementById('paper')?.remove();
    document.body.classList.remove('on-paper');
  });

  return {frameOf, pictureOf, followTheme, save};
})();
