#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/fit/intervals.h"
#include "lyrefit/estimate/fit/refine_fit.h"

namespace lyrefit {

// Bounds that the readings refute.
struct RefutedBounds {
  std::string because;      // the reason as a sentence; empty: none is refuted
  std::string test;         // its first part: which bounds, and how much better more room is
  BoundsSpec::Table wider;  // ranges of more room; key: symbol
};

// Tests whether the readings refute a bound at which an ideality factor is active, or any parameter
// of the diodes at a bound that is not lyrefit's own. The problem is fitted again with a wider range, and the F-test decides at 5 % whether that describes the
// readings better. If their errors are correlated, the likelihood under those errors must agree.
// Every interval of a refuted fit would be conditional on a false assumption.
RefutedBounds FindRefutedBounds(const RefinedFit& refined, const ProgressReporter& progress);

// Last stage of a fit: intervals around the refined end, or the reason why there are none.
struct JudgedFit {
  RefineEnd end;  // lower than the refined one if a profile found a better optimum
  std::vector<Estimate> estimates;
  std::vector<Correlation> correlations;
  double condition = kUnknown;
  std::vector<StartReport> restarts;   // of the polish, from lower optima that a profile found
  std::optional<ErrorReport> errors;   // of a least-squares fit; none: not requested
  std::vector<Estimate> under_errors;  // see FitReport
  FitCovariance covariance;            // see FitReport
  std::string no_intervals_because;    // empty: present, or not requested
  RefutedBounds refuted;               // the reason for it, if bounds are
};

// Finds intervals around the refined end. If a profile finds a lower optimum, the polish restarts
// there and the intervals are found again. `usable`: whether the model describes the readings;
// otherwise no interval is found. `searched`: best candidate of the search.
JudgedFit JudgeFit(const RefinedFit& refined, const std::vector<double>& searched, bool usable,
                   const ProgressReporter& progress);

// Warnings about a report, as sentences, most serious first.
std::vector<std::string> FindWarnings(const FitReport& report);

}  // namespace lyrefit
