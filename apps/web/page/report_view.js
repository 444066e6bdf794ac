// Display and saving of a report. Defines reportView: frameOf(result), followTheme(frame), save(result, verb, what).
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

  // A frame with the report, as high as its content.
  function frameOf(result) {
    const frame = document.createElement('iframe');
    frame.title = `Report of ${result.name}`;
    frame.srcdoc = result.page_html;
    frame.addEventListener('load', () => {
      frame.contentDocument.querySelector('header .tools').hidden = true;  // the page has its own
      followTheme(frame);
      followHeight(frame);
    });
    return frame;
  }

  const kSaves = {
    page: ['html', 'text/html', (result) => result.page_html],
    json: ['json', 'application/json', (result) => result.report_json],
    csv: ['csv', 'text/csv', (result) => result.csv],
    text: ['txt', 'text/plain', (result) => result.text],
  };

  function save(result, verb, what) {
    const [extension, type, make] = kSaves[what];
    const url = URL.createObjectURL(new Blob([make(result)], {type}));
    lyrefit.save(`${result.name}_${verb}.${extension}`, url);
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }

  return {frameOf, followTheme, save};
})();
