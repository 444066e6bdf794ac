// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/fit_report.h"

// Records as CSV, one row for each item. Numbers read back to the same bits; an unknown value is an
// empty field. Powers and currents are fractions as in the library, not percentages.
namespace LYREFIT_PUBLIC lyrefit {

// One row for each file, in the given order. Columns: file, name, model, objective,
// cells_in_series, temperature_C, irradiance_Wm2, points; the parameters by symbol and unit (Iph_A,
// Is1_A, n1, Rs_ohm, ...), each followed by its standard error (Iph_A_se), for the parameters of
// the largest model; the RMSEs of the search and of the final result by both definitions; usable,
// warnings and error.
std::string FitsCsv(const std::vector<FittedFile>& fits);

// How to write texts that a spreadsheet would run as a formula.
enum class CsvTexts {
  kSafe,  // preceded by an apostrophe
  kRaw,   // unchanged
};

// A field by RFC 4180, in quotes if it contains a comma, a quote or an end of line. Spreadsheets
// run a text that begins with =, +, - or @ (also after blanks or as a full-width character), with a
// tab or with an end of line. Such a text gets an apostrophe before it; so does a text that already
// looks like one with an added apostrophe. Numbers are unchanged. Bytes that are not UTF-8 are
// replaced.
std::string CsvField(const std::string& text, CsvTexts texts = CsvTexts::kSafe);
// The shortest text that reads back to the same number; empty for NaN and infinity.
std::string CsvField(double value);
// One line of fields, with its line end.
std::string CsvLine(const std::vector<std::string>& fields);

}  // namespace lyrefit
