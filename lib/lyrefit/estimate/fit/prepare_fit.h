#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/model/variants.h"

namespace lyrefit {

// A curve without duplicate readings. An exact copy of a reading adds no information about the
// device.
struct DistinctReadings {
  IvCurve curve;               // in order of first occurrence
  std::vector<double> copies;  // multiplicity of each reading; empty: all 1
};

// Copies have equal voltage, current, sigma and time. Repeated measurements of one point differ in
// their noise and are all kept.
DistinctReadings FindDistinctReadings(const IvCurve& curve);

// The problem with its effects in one variant and integer parameters fixed at their values in `p`.
RefineProblem InVariant(const RefineProblem& problem, const Variant& variant,
                        const std::vector<double>& p);

// Penalty factor on the RMSE for the free parameters of a variant. The logarithms of the squared
// penalised RMSEs rank variants as BIC does.
double VariantPenalty(const RefineProblem& problem, const Variant& variant);

// First stage of a fit: its readings, its device and the least-squares problem of both. The options
// must outlive it.
struct PreparedFit {
  IvCurve curve;  // WithoutBeyondVoc() of the one that was given
  const FitOptions& options;
  std::vector<std::string> doubts = {};  // about the readings; see JudgeReadings
  Device device = {};
  std::vector<ParameterBounds> bounds = {};  // of the device's parameters
  std::vector<double> fixed = {};            // values of the fixed parameters, NaN for free ones
  int free_parameters = 0;
  double steepest_n = kUnknown;        // see FitReport
  std::vector<Variant> variants = {};  // only with effects
  double variant_penalty = 1;          // of the selected variant; see FitReport
  IvCurve distinct = {};               // the curve without duplicate readings
  RefineProblem problem = {};          // of the distinct readings; with effects of all
  RefineProblem coarse = {};           // Coarsen(problem)

  bool extended() const { return !variants.empty(); }
  int readings() const { return static_cast<int>(distinct.size()); }
  int spare_readings() const { return std::max(readings() - free_parameters, 1); }
  // Readings that are the rows of `problem`.
  const IvCurve& fitted() const { return extended() ? curve : distinct; }
  // Number of parameters of the effects, and of the base, which precede them.
  int effects_size() const { return extended() ? static_cast<int>(variants[0].bounds.size()) : 0; }
  int base_size() const { return device.size() - effects_size(); }
};

// Checks the curve that is given and the options. Errors: those of Fit().
Expected<PreparedFit> PrepareFit(const IvCurve& given, const FitOptions& options);

// Error for the measured current, which is not supported with effects.
Expected<void> CheckObjectiveOfEffects(Objective objective);

// The box of the search. `fit` must outlive it.
SearchSpace SpaceOf(const PreparedFit& fit);

// Penalty factor on the RMSE; see FitReport::variant_penalty.
double VariantPenaltyOf(const PreparedFit& fit, int variant);

// The fit with one variant selected, and integer parameters fixed at their values in `p`.
PreparedFit WithVariant(PreparedFit fit, int variant, const std::vector<double>& p);

RmsePair BothRmse(const Device& device, const std::vector<double>& p, const IvCurve& curve);

// Estimates in reporting units, without intervals, of parameters found by the search and by the
// polish. `refined` is empty if there was no polish.
std::vector<Estimate> EstimatesOf(const PreparedFit& fit, const std::vector<double>& searched,
                                  const std::vector<double>& refined);

}  // namespace lyrefit
