#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"

// A report as a page that can be sent: one file of HTML with pictures, tables and data, which
// fetches nothing.
namespace LYREFIT_PUBLIC lyrefit {

// What a page shows besides the document.
struct PageOptions {
  bool interactive = true;  // charts to hover over and zoom, where this build has Plotly
  // Pictures that gnuplot draws, beside the charts; false where no program can be run.
  bool stills = true;
};

// The verdict of the document first, then its warnings and pictures, then the rest in the document's
// order. Pictures are drawn by one run of gnuplot, as they are read without scripts and on paper;
// where there is no gnuplot the page says so. `json` is the record, which the page holds and gives
// away with a button.
std::string DrawPage(const Document& document, const std::string& json,
                     const PageOptions& options = {});

}  // namespace lyrefit
