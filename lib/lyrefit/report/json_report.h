#pragma once

#include <string>

#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// How much of the curve a report repeats under `data`.
enum class JsonPoints {
  kAll,
  kThinned,  // of a curve of more than kMostJsonPoints every n-th reading, n in data.every, and the
             // last; what every reading says stands in the other keys
};

constexpr int kMostJsonPoints = 2000;

// The report as one JSON object, numbers with as many digits as bring back the same bits. What is
// not known or not finite is null; without a polish so are `refined` and the polished RMSEs. The
// values the fit answers with stand in `parameters.<name>.refined`, or `.searched` where that is
// null. Every wall-clock time stands under a key named `seconds`; apart from those the same seed
// gives the same text.
//
// `causes` (ids) and `curves` (a number) stand only in extended models of a diagnosis.
//
// For the single-diode model `singlediode` holds the five arguments of pvlib.pvsystem.singlediode
// under pvlib's names; a perfect shunt (infinite resistance) is null there too.
std::string JsonReport(const FitReport& report, JsonPoints points = JsonPoints::kAll);

}  // namespace lyrefit
