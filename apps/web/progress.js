// What the engine calls while it works; the worker that holds it hands the text on.
mergeInto(LibraryManager.library, {
  lyrefit_progress: function (text) {
    if (globalThis.lyrefitProgress) globalThis.lyrefitProgress(UTF8ToString(text));
  },
});
