#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {

// Conversion of a document to HTML elements, for functions that draw pages.

// Escapes characters with a meaning in HTML; characters that are illegal in a page become U+FFFD.
std::string HtmlEscaped(const std::string& text);

// Escapes lines as HtmlEscaped does and keeps line ends and blanks.
std::string HtmlLines(const std::string& lines);

// "<tag>text</tag>" with the text escaped.
std::string HtmlElement(const std::string& tag, const std::string& text);

struct HtmlLooks {
  bool boxes = false;  // tables in scrolling boxes that the keyboard can focus
  // The element of a picture; without it the picture's file, or the caption alone.
  std::function<std::string(const block::Figure&)> figure = {};
  // The element of a table of many rows; without it nothing.
  std::function<std::string(const block::LongTable&)> long_table = {};
};

std::string HtmlTable(const block::Table& table, const HtmlLooks& looks);

// The content of a section, below its heading.
std::string HtmlBlocks(const std::vector<block::Any>& blocks, const HtmlLooks& looks);

// A section with its heading. `id` is its target for links; it may be empty.
std::string HtmlSection(const Section& section, const HtmlLooks& looks, const std::string& id);

// Figures as elements of an HTML page.

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
