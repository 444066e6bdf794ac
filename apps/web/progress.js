// Called by the engine during its work; the worker defines lyrefitProgress, which sends the text to the page.
mergeInto(LibraryManager.library, {
  lyrefit_progress: function (text) {
    if (globalThis.lyrefitProgress) globalThis.lyrefitProgress(UTF8ToString(text));
  },
});
