// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"

// A fit of many curves as a document, as text, JSON, CSV and a picture; its parameters in the form
// of pvlib and of SAM. The conventions are those of report/documents.h, json.h, csv.h and plots.h.
namespace LYREFIT_PUBLIC lyrefit {

// A family fit. A report without shared parameters is one of curves fitted individually.
Document FamilyDocument(const FamilyReport& report);
// With the picture of FamilyFigure(), which shows the readings of `set`.
Document FamilyDocument(const FamilyReport& report, const CurveSet& set);
std::string FamilyText(const FamilyReport& report, Length length = Length::kWhole);
std::string BriefFamily(const FamilyReport& report);

// Every RMSE is a pair with the keys measured_current_A and solved_current_A.
std::string FamilyJson(const FamilyReport& report);

// The parameters of the device `name` in pvlib's form: the function's name and its keywords, for
// the call function(1000, 25, **parameters), and the device's row in SAM's library of modules, or
// the reason why it has none. cells_in_series is a separate member (calcparams_pvsyst takes it as
// well); d2mutau and NsVbi belong to pvlib's bishop88 functions.
std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec);

// One row for each curve, in the columns of the parameter sets of github.com/cwhanse/ivcurves:
// Index, photocurrent, saturation_current, resistance_series, resistance_shunt, n, cells_in_series,
// and saturation_current_2 and n_2 for two diodes. The parameters are those of the curve's
// individual fit, else those of the shared law at its conditions. The fields of a curve without
// parameters are empty.
std::string IndividualFitsCsv(const FamilyReport& report);

// A library of one module in the layout of SAM's CEC modules: a line of names, one of units, one of
// SAM's identifiers, and the row. What a fit does not know (maker, area, NOCT, PTC) is empty.
std::string CecLibraryCsv(const CecModule& module);

// A family fit of `set`, coloured by cell temperature. Measured points and model of up to twelve
// curves spread over the irradiances; RMSE and mean residual of each curve over irradiance.
Figure FamilyFigure(const FamilyReport& report, const CurveSet& set);
Expected<void> PlotFamily(const FamilyReport& report, const CurveSet& set, const std::string& path,
                          PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
