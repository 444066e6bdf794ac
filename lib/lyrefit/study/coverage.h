#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/law/parameter.h"
#include "lyrefit/study/coverage_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// What one simulated set says of one parameter.
struct CoverageRow {
  double truth = kUnknown;  // what the set was made with
  Interval interval;
  bool fixed = false;
  bool identifiable = true;
};

// One simulated set and what its fit says of the parameters.
struct CoverageSet {
  int cells_in_series = 1;
  int curves = 0;                                 // in the set
  std::string error;                              // why there is no usable fit; empty: there is one
  FamilyWeights weights = FamilyWeights::kEqual;  // that the fit took
  bool correlated = false;  // the fit found correlated errors, and the rows' intervals are under
                            // these
  std::vector<CoverageRow> rows;  // in the order of CoverageReport::parameters; empty: no fit
  double seconds = 0;
};

// How often the 95 % intervals of one parameter hold the truth.
struct ParameterCoverage {
  ParameterInfo info;
  bool offset = false;         // of a sensor: no shared parameter
  int fitted = 0;              // sets whose fit was usable and did not hold the parameter
  int not_identifiable = 0;    // of those; they have no interval worth the name and are not counted
  int counted = 0;             // of those: identifiable, with an interval
  int covered = 0;             // of those: the interval holds the truth
  double coverage = kUnknown;  // covered / counted
  double low_95 = kUnknown;    // binomial, Wilson's interval
  double high_95 = kUnknown;
  double median_half_width = kUnknown;  // relative to the truth; of offsets in their own unit
};

// How often intervals of joint fits hold the truth.
struct CoverageReport {
  std::string version;
  CoverageOptions options;  // what was asked for
  // The shared parameters of the law, then the sensors' offsets that were fitted.
  std::vector<ParameterCoverage> parameters;
  std::vector<CoverageSet> sets;
  int failed = 0;      // sets without a usable fit
  int relative = 0;    // fits with weights relative to Isc
  int correlated = 0;  // fits that found correlated errors
  double seconds = 0;
  bool interrupted = false;          // only the sets that were done are there
  std::vector<std::string> remarks;  // on the journal, in plain sentences
  bool journal_lacks_sets = false;   // it could not be written; a remark says why
};

// FitFamily, or what stands in its place in a test.
using FamilyFitter =
    std::function<Expected<FamilyReport>(const CurveSet&, const FamilyOptions&, const Observer&)>;

// Simulates sets with known parameters (see coverage_sets.h), fits every one with `fit`, which is
// FitFamily but in tests, and counts. The observer hears of stage "coverage" at the beginning,
// after every set and now and then in between. Errors: options outside their ranges, a module with
// parameters missing, unknown or without an open-circuit voltage, a journal of another study. A fit
// that fails is counted, no error.
Expected<CoverageReport> Coverage(const CoverageOptions& options, const FamilyFitter& fit,
                                  const Observer& observer = {});

// Wilson's 95 % interval of a binomial share; all of [0, 1] for no trial.
struct Share {
  double low_95 = 0;
  double high_95 = 1;
};
Share WilsonInterval(int hits, int trials);

}  // namespace lyrefit
