// What scrolls sideways can be reached by the keyboard.
const reach = () => {
  for (const element of document.querySelectorAll('pre, .wy-table-responsive')) {
    if (element.scrollWidth > element.clientWidth) element.tabIndex = 0;
  }
};
window.addEventListener('load', () => setTimeout(reach));  // after the theme has put tables into their frames
window.addEventListener('resize', reach);
