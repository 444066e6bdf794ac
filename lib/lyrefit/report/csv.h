// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/estimate/fit/fit_report.h"

// Records as CSV, one row for each item. Numbers read back to the same bits; an unknown value is an
// empty field. Powers and currents are fractions as in the library, not percentages.
namespace LYREFIT_PUBLIC lyrefit {

struct CecModule;
struct CellReport;
struct Certificate;
struct DataSheetFit;
struct FamilyReport;
struct OutlierSweeps;
struct TranslationReport;
struct TrendReport;

// One row for each file, in the given order. Columns: file, name, model, objective,
// cells_in_series, temperature_C, irradiance_Wm2, points; the parameters by symbol and unit (Iph_A,
// Is1_A, n1, Rs_ohm, ...), each followed by its standard error (Iph_A_se), for the parameters of
// the largest model; the RMSEs of the search and of the final result by both definitions; usable,
// warnings and error.
std::string FitsCsv(const std::vector<FittedFile>& fits);

// One row for each curve, in the columns of the parameter sets of github.com/cwhanse/ivcurves:
// Index, photocurrent, saturation_current, resistance_series, resistance_shunt, n, cells_in_series,
// and saturation_current_2 and n_2 for two diodes. The parameters are those of the curve's
// individual fit, else those of the shared law at its conditions. The fields of a curve without
// parameters are empty.
std::string IndividualFitsCsv(const FamilyReport& report);

// One row for each cause, with those below the floor after the named ones. A measurement without a
// cause has one row with its name and the verdict only.
std::string CausesCsv(const std::vector<std::string>& names,
                      const std::vector<Diagnosis>& diagnoses);

// One row for each sweep, the strongest outlier first.
std::string OutlierSweepsCsv(const OutlierSweeps& outlier);

// The floor, then one row for each model.
std::string CertificateCsv(const Certificate& certificate);

// One row for each sweep of a cell, with its figures; n, Rs_ohm and Rsh_ohm are those of the fit and
// empty where they are void.
std::string CellCsv(const CellReport& report);

// One row for each parameter.
std::string DataSheetCsv(const DataSheetFit& fit);

// A library of one module in the layout of SAM's CEC modules: a line of names, one of units, one of
// SAM's identifiers, and the row. What a fit does not know (maker, area, NOCT, PTC) is empty.
std::string CecLibraryCsv(const CecModule& module);

// One row for each procedure: curve, procedure, recommended, the six key points, each followed by
// its expanded uncertainty (..._U), why_not.
std::string TranslationCsv(const TranslationReport& report);

// One row for each day of a trend: its quantities at standard conditions, then the parts of the loss
// in percent of the expected energy.
std::string TrendCsv(const TrendReport& report);

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
