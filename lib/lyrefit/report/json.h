#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/family/data_sheet.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/family/pvlib_parameters.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/translate/translation_report.h"

// Records as the text of a JSON file. Keys stand in a fixed order, numbers have as many digits as
// bring back the same bits, and what is not known or not finite is null. Every wall-clock time
// stands under a key named `seconds`; apart from those the same seed gives the same text. What of a
// record stands where is said by the schemas in data/schema.
//
// A parameter is the same object everywhere: `symbol`, `name` (pvlib's where it has one), `unit`
// and what is known of it: `searched` and `refined` of a fit, else `value`, `standard_error`,
// `low_95`, `high_95`, ... It stands under its name or, one of an effect's, which has `effect` too,
// under EFFECT.SYMBOL.
namespace LYREFIT_PUBLIC lyrefit {

// How much of the curve a report repeats under `data`.
enum class JsonPoints {
  kAll,
  kThinned,  // of a curve of more than kMostJsonPoints every n-th reading, n in data.every, and the
             // last; what every reading says stands in the other keys
};

// Curves of more readings are repeated with every n-th of them, unless all are asked for.
constexpr int kMostJsonPoints = 2000;

// Without a polish `refined` and the polished RMSEs are null. The values the fit answers with stand
// in `parameters.<name>.refined`, or `.searched` where that is null.
//
// `causes` (ids) and `law` stand only in models with effects, `curves` (a number) where they
// describe several.
//
// For the single-diode model `singlediode` holds the five arguments of pvlib.pvsystem.singlediode
// under pvlib's names; a perfect shunt (infinite resistance) is null there too.
std::string JsonReport(const FitReport& report, JsonPoints points = JsonPoints::kAll);

// An array of what JsonReport writes, each with its "file"; {"file", "error"} where there is none.
std::string FitsJson(const std::vector<FittedFile>& fits, JsonPoints points = JsonPoints::kAll);

// Every RMSE is a pair under the labels measured_current_A and solved_current_A.
std::string FamilyJson(const FamilyReport& report);

// With what it takes to check the floor at its Rs without lyrefit. With
//   v[k] = voltage_V[k] + resistance_series current_A[k],      y = floor.dual_A,
// nothing that the model may add points along y: sum y <= 0, -sum y v <= 0, and
// -sum y (exp(v / nNsVth) - 1) <= 0 for nNsVth = n module_thermal_voltage_V and every n in the
// range. Then sum current_A y - sum y^2 / 2 <= N RMSE^2 / 2 for every mixture, and equality to
// rounding for the floor.
std::string CertificateJson(const Certificate& certificate);

// The parameters found, and each check: what was asked for beside what the device gives.
std::string DataSheetJson(const DataSheetFit& fit);

// The parameters of the device `name` as pvlib takes them: which function, its keywords and no
// others, so that function(1000, 25, **parameters) can be called, and the row of SAM's library of
// modules, or why there is none. cells_in_series stands beside them (calcparams_pvsyst takes it as
// well), d2mutau and NsVbi are those of pvlib's bishop88 functions.
std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec);

// Points are named by their position in `points`. Several diagnoses: an array.
std::string DiagnosisJson(const Diagnosis& diagnosis);
std::string DiagnosisJson(const std::vector<Diagnosis>& diagnoses);

// The bare answers, for scripts that score many: {"name": [["cause", "equivalent", ...], ...]}, an
// empty list where no cause was found. One name for each diagnosis.
std::string AnswersJson(const std::vector<std::string>& names,
                        const std::vector<Diagnosis>& diagnoses);

// The comparison and, beside it, the diagnosis of what it leaves.
std::string ReferenceJson(const ReferenceComparison& comparison, const Diagnosis& diagnosis);
std::string OutlierSweepsJson(const OutlierSweeps& outlier);

// Sizes are in the units of what they are of, expanded ones k = 2. Curves stand in `points`.
std::string TranslationJson(const TranslationReport& report);

}  // namespace lyrefit
