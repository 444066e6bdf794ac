// Sphinx's search asks for a page that it found, to show the words around what was looked for.
window.fetch = (address) => Promise.resolve({text: () => Promise.resolve(pageTexts[address.replace(/^\.\//, '')])});
Search.htmlToText = (text) => text;

// The title of a page leads to its beginning, as its text does: the page is listed once.
const setIndex = Search.setIndex;
Search.setIndex = (index) => {
  for (const [title, places] of Object.entries(index.alltitles)) {
    index.alltitles[title] = places.map(([page, anchor]) => [page, index.titles[page] === title ? null : anchor]);
  }
  setIndex(index);
};

// The page of a verb comes first for its name.
const asked = new URLSearchParams(window.location.search).get('q')?.trim().toLowerCase();
Scorer.score = ([page, , anchor, , score]) => score + (page === `verbs/${asked}` && !anchor ? 200 : 0);
