// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"

// A report as one HTML file with pictures, tables and data that accesses no network.
namespace LYREFIT_PUBLIC lyrefit {

// Optional content of a page.
struct PageOptions {
  bool interactive = true;  // charts with hover and zoom, if this build has Plotly
  // Pictures drawn by gnuplot besides the charts; false where no program can be run.
  bool stills = true;
};

// Draws the document's verdict first, then its warnings and pictures, then the rest in order. One
// run of gnuplot draws all pictures, for paper and for browsers without scripts; without gnuplot
// the page states that they are missing. `json` is the record, which the page embeds and can save.
// A block::LongTable is drawn without its rows, which batch/plant_page.h adds.
std::string DrawPage(const Document& document, const std::string& json,
                     const PageOptions& options = {});

// The page with `lines` at the head of its verdict, in place of such lines of an earlier call; below
// `own` stand the lines of the page itself. A page without a verdict stays as it is.
std::string WithVerdictAhead(const std::string& page, const std::vector<std::string>& lines,
                             const std::string& own);

}  // namespace lyrefit
