#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/report/figure.h"

// Figures as elements of an HTML page.
namespace lyrefit {

// A figure and its place in a page.
struct PagePicture {
  const Figure* figure = nullptr;
  std::string id;           // unique within the page
  std::string description;  // alternative text of the picture
};

// Each figure as an <svg> element, all drawn by one run of gnuplot. Colours are CSS variables of
// the page, light or dark: --c-RRGGBB for lines and marks, --t-RRGGBB for letters, with the
// original colour as fallback. Errors: those of RunGnuplot().
Expected<std::vector<std::string>> InlineSvgs(const std::vector<PagePicture>& pictures);

// The figure for Plotly, as JSON. "data" and "layout" are for panels in `columns` columns; "narrow"
// holds the members of the layout that differ when all panels are in one column. "title" is the
// figure's title, which the page shows. The rows are those of the SVG picture.
std::string PlotlyJson(const Figure& figure);

}  // namespace lyrefit
