// What scrolls sideways can be reached by the keyboard.
window.addEventListener('load', () => {
  for (const element of document.querySelectorAll('pre, .wy-table-responsive')) {
    if (element.scrollWidth > element.clientWidth) element.tabIndex = 0;
  }
});
