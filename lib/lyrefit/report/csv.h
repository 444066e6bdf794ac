#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/fit/fit_report.h"

// Records as CSV: a row for each thing found. Numbers read back to the same bits, what is not known
// is empty. Powers and currents are in parts as in the library, not in percent.
namespace LYREFIT_PUBLIC lyrefit {

struct Certificate;
struct DataSheetFit;
struct FamilyReport;
struct OutlierSweeps;
struct TranslationReport;

// A row a file, in their order: file, name, model, objective, cells_in_series, temperature_C,
// irradiance_Wm2, points; the parameters under their symbols and units (Iph_A, Is1_A, n1, Rs_ohm,
// ...), each followed by its standard error (Iph_A_se), as many as the largest model has; the RMSEs
// of the search and of the answer by both definitions; usable, warnings and error.
std::string FitsCsv(const std::vector<FittedFile>& fits);

// A row a curve, in the columns of the parameter sets of github.com/cwhanse/ivcurves: Index,
// photocurrent, saturation_current, resistance_series, resistance_shunt, n, cells_in_series, and
// saturation_current_2 and n_2 for two diodes. The parameters of the curve's own fit, or, where
// that was not done, what the shared ones come to; a curve without any keeps its row, empty.
std::string IndividualFitsCsv(const FamilyReport& report);

// A row a cause, those below the floor after those that are named; of a measurement without any one
// row with nothing but its name and the verdict.
std::string CausesCsv(const std::vector<std::string>& names,
                      const std::vector<Diagnosis>& diagnoses);

// A row a sweep, the oddest first.
std::string OutlierSweepsCsv(const OutlierSweeps& outlier);

// The floor and each model.
std::string CertificateCsv(const Certificate& certificate);

// A row a parameter.
std::string DataSheetCsv(const DataSheetFit& fit);

// A row a procedure: curve, procedure, recommended, the six key points each followed by its expanded
// uncertainty (..._U), why_not.
std::string TranslationCsv(const TranslationReport& report);

// How texts are written that a spreadsheet would take for a formula.
enum class CsvTexts {
  kSafe,  // with an apostrophe before them
  kRaw,   // as they are
};

// What tables are made of. A field as RFC 4180 wants it, in quotes where it holds a comma, a quote
// or an end of line. A spreadsheet runs a text that begins with =, +, - or @ (or one of these behind
// blanks or as a full-width character), or with a tab or an end of line: an apostrophe stands before
// it, and before a text that looks like one that got it. What is a number stays. Bytes that are no
// UTF-8 are replaced.
std::string CsvField(const std::string& text, CsvTexts texts = CsvTexts::kSafe);
// A text as it was before CsvField put an apostrophe before it.
std::string WithoutApostrophe(std::string text);
// The shortest text that reads back to the same number, empty for NaN and infinity.
std::string CsvField(double value);
// A line of fields.
std::string CsvLine(const std::vector<std::string>& fields);

}  // namespace lyrefit
