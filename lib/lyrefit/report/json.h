// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/fit_report.h"

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

}  // namespace lyrefit
