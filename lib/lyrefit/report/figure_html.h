#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/report/figure.h"

// Figures as parts of a page.
namespace lyrefit {

// A figure as it stands within a page.
struct PagePicture {
  const Figure* figure = nullptr;
  std::string id;           // no two of a page have the same
  std::string description;  // what is to be seen, for who does not see it
};

// Each as an <svg> element, drawn by one run of gnuplot. Colours are those of the page, light or
// dark: --c-RRGGBB for lines and marks, --t-RRGGBB for letters, where the page has them. Fails as
// RunGnuplot() does.
Expected<std::vector<std::string>> InlineSvgs(const std::vector<PagePicture>& pictures);

// The figure as Plotly takes it, as JSON: "data" and "layout" for a page of `columns` panels side by
// side, and "narrow", the parts of the layout that are different where all panels stand below each
// other. "title" is the figure's, which the page writes. The same rows as in the SVG picture.
std::string PlotlyJson(const Figure& figure);

}  // namespace lyrefit
