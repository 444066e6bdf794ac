#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/model/parameter.h"
#include "studies/coverage_options.h"

namespace lyrefit {

// The result for one parameter of one simulated set.
struct CoverageRow {
  double truth = kUnknown;  // value used for the simulation
  Interval interval;
  bool fixed = false;
  bool identifiable = true;
};

// One simulated set and the estimates of its fit.
struct CoverageSet {
  int cells_in_series = 1;
  int curves = 0;     // number of curves in the set
  std::string error;  // reason why there is no usable fit; empty: there is one
  FamilyWeights weights = FamilyWeights::kEqual;  // weights selected by the fit
  // True: the fit found correlated errors, and `rows` has the intervals under correlation.
  bool correlated = false;
  std::vector<CoverageRow> rows;  // in the order of CoverageReport::parameters; empty: no fit
  double seconds = 0;
};

// How often the 95 % intervals of one parameter contain the true value.
struct ParameterCoverage {
  ParameterInfo info;
  bool offset = false;         // true: a sensor offset; false: a shared parameter
  int fitted = 0;              // sets with a usable fit in which the parameter was free
  int not_identifiable = 0;    // of `fitted`; their intervals are meaningless and are not counted
  int counted = 0;             // of `fitted`: identifiable, with an interval
  int covered = 0;             // of `counted`: the interval contains the true value
  double coverage = kUnknown;  // covered / counted
  double low_95 = kUnknown;    // 95 % limits of `coverage`: binomial, Wilson's interval
  double high_95 = kUnknown;
  double median_half_width = kUnknown;  // relative to the true value; of offsets in their own unit
};

// How often the intervals of joint fits contain the true values.
struct CoverageReport {
  std::string version;
  CoverageOptions options;  // options of the study
  // The shared parameters of the law, then the fitted sensor offsets.
  std::vector<ParameterCoverage> parameters;
  std::vector<CoverageSet> sets;
  int failed = 0;      // number of sets without a usable fit
  int relative = 0;    // number of fits with weights relative to Isc
  int correlated = 0;  // number of fits that found correlated errors
  double seconds = 0;
  bool interrupted = false;  // only the finished sets are included
};

// Signature of FitFamily; tests pass a substitute.
using FamilyFitter =
    std::function<Expected<FamilyReport>(const CurveSet&, const FamilyOptions&, const Observer&)>;

// Simulates sets with known parameters (see coverage_sets.h), fits each with `fit` and counts how
// often intervals contain the true value. `fit` is FitFamily except in tests. The observer receives
// stage "coverage" at the beginning, after every set and at intervals. Errors: options outside
// their ranges; a module with missing or unknown parameters or without an open-circuit voltage. A
// failed fit is counted and is not an error.
Expected<CoverageReport> Coverage(const CoverageOptions& options, const FamilyFitter& fit,
                                  const Observer& observer = {});

// Wilson's 95 % interval of a binomial proportion; [0, 1] if `trials` is 0.
struct Share {
  double low_95 = 0;
  double high_95 = 1;
};
Share WilsonInterval(int hits, int trials);

// The report as text for a terminal of 100 columns.
std::string CoverageText(const CoverageReport& report);

}  // namespace lyrefit
