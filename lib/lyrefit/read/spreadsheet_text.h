// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Whether a spreadsheet would run the text as a formula, ignoring apostrophes before it: a text
// that begins with =, +, - or @ (also after blanks or as a full-width character) and is no number,
// or that begins with a tab or an end of line.
bool RunsInSpreadsheets(std::string_view text);

// Reverses the apostrophe that CsvField (report/csv.h) puts before such a text.
std::string WithoutApostrophe(std::string text);

}  // namespace lyrefit
