// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/estimate/cell/cell_report.h"
#include "lyrefit/estimate/family/data_sheet.h"
#include "lyrefit/estimate/family/family_report.h"
#include "lyrefit/estimate/family/pvlib_parameters.h"
#include "lyrefit/estimate/family/two_junction_report.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/translate/translation_report.h"

// Records as the text of a JSON file. Keys have a fixed order, numbers have enough digits to read
// back to the same bits, and unknown or infinite values are null. Every wall-clock time has a key
// named `seconds`; apart from those the text depends on the seed only. The schemas in data/schema
// define the place of each member.
//
// A parameter is one kind of object everywhere: `symbol`, `name` (pvlib's where it has one), `unit`
// and its values: `searched` and `refined` of a fit, else `value`, `standard_error`, `low_95`,
// `high_95`, ... Its key is its name. A parameter of an effect has the key EFFECT.SYMBOL and a
// member `effect`.
namespace LYREFIT_PUBLIC lyrefit {

struct TrendReport;

// How many readings of the curve a report repeats under `data`.
enum class JsonPoints {
  kAll,
  kThinned,  // every n-th reading and the last, if there are more than kMostJsonPoints; n is
             // data.every; other keys use all readings
};

// Longer curves are thinned under JsonPoints::kThinned.
constexpr int kMostJsonPoints = 2000;

// Without a polish, `refined` and the polished RMSEs are null. The result of the fit is
// `parameters.<name>.refined`, or `.searched` where that is null.
//
// `causes` (ids) and `law` exist only in models with effects, `curves` (a number) only in models of
// several curves.
//
// For the single-diode model, `singlediode` holds the five arguments of pvlib.pvsystem.singlediode
// under pvlib's names; an infinite shunt resistance is null there too.
std::string JsonReport(const FitReport& report, JsonPoints points = JsonPoints::kAll);

// An array of the objects of JsonReport, each with its "file"; {"file", "error"} for a failed fit.
std::string FitsJson(const std::vector<FittedFile>& fits, JsonPoints points = JsonPoints::kAll);

// Every RMSE is a pair with the keys measured_current_A and solved_current_A.
std::string FamilyJson(const FamilyReport& report);

// Parameters and curves of a fit of two junctions. Every RMSE is a pair; its measured current is
// null. The light of a curve that is not stated is null.
std::string TwoJunctionJson(const TwoJunctionReport& report);

// A certificate with the data to verify the floor at its Rs without lyrefit. With
//   v[k] = voltage_V[k] + resistance_series current_A[k],      y = floor.dual_A,
// no component of the model has a positive product with y: sum y <= 0, -sum y v <= 0, and -sum y
// (exp(v / nNsVth) - 1) <= 0 for nNsVth = n module_thermal_voltage_V and every n in the range. Then
// sum current_A y - sum y^2 / 2 <= N RMSE^2 / 2 for every mixture, with equality to rounding for
// the floor.
std::string CertificateJson(const Certificate& certificate);

// A laboratory cell. `main`, `sweep`, `lit`, `dark`, `forward` and `reverse` are indices into
// `sweeps`. Parameters of a fit have the interval to believe, and `covariance` is in their order.
std::string CellJson(const CellReport& report);

// The fitted parameters, and each check: the stated value beside that of the device.
std::string DataSheetJson(const DataSheetFit& fit);

// The parameters of the device `name` in pvlib's form: the function's name and its keywords, for
// the call function(1000, 25, **parameters), and the device's row in SAM's library of modules, or
// the reason why it has none. cells_in_series is a separate member (calcparams_pvsyst takes it as
// well); d2mutau and NsVbi belong to pvlib's bishop88 functions.
std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec);

// A diagnosis, which refers to points by index into `points`. Several diagnoses form an array.
std::string DiagnosisJson(const Diagnosis& diagnosis);
std::string DiagnosisJson(const std::vector<Diagnosis>& diagnoses);

// Only the causes, for scripts that score many diagnoses: {"name": [["cause", "equivalent", ...],
// ...]} with an empty list where no cause was found. `names` has one name for each diagnosis.
std::string AnswersJson(const std::vector<std::string>& names,
                        const std::vector<Diagnosis>& diagnoses);

// The comparison and the diagnosis of its remainder.
std::string ReferenceJson(const ReferenceComparison& comparison, const Diagnosis& diagnosis);
std::string OutlierSweepsJson(const OutlierSweeps& outlier);

// Uncertainties are in the units of their values; expanded ones have k = 2. `points` holds the
// curves.
std::string TranslationJson(const TranslationReport& report);

// Quantities with their days, the loss by part, onsets.
std::string TrendJson(const TrendReport& report);

}  // namespace lyrefit
