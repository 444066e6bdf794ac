#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/law/variants.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// Data shared by the stages of one fit.
struct FitJob {
  const IvCurve& curve;
  const FitOptions& options;
  const Observer& observer;
  std::vector<ParameterBounds> bounds;
  std::vector<double> fixed;
  int free_parameters = 0;
  RefineProblem problem;  // of the distinct readings; with effects of all
  RefineProblem coarse;   // Coarsen(problem)
  ProgressReporter progress;
  std::vector<Variant> variants = {};  // only with effects
  IvCurve distinct = {};               // the curve without duplicate readings

  int readings() const { return static_cast<int>(distinct.size()); }

  // Readings that are the rows of `problem`.
  const IvCurve& fitted() const { return variants.empty() ? distinct : curve; }

  // Number of base parameters, which precede those of the effects.
  int base_size() const { return problem.device.size() - effects(); }
  int effects() const { return variants.empty() ? 0 : static_cast<int>(variants[0].bounds.size()); }
};

// Error for the measured current, which is not supported with effects.
Expected<void> CheckObjectiveOfEffects(Objective objective);

// Checks the curve and the options. Sets the device, the bounds and the problem. Errors: those of
// Fit().
Expected<void> PrepareFit(FitJob* job, FitReport* report);

// Penalty factor on the RMSE; see FitReport::variant_penalty.
double VariantPenaltyOf(const FitJob& job, int variant);

// Selects one variant, with integer parameters fixed at their values in `p`. Sets bounds, problem
// and the effects of the reported device.
void SelectVariant(int variant, const std::vector<double>& p, FitJob* job, FitReport* report);

RmsePair BothRmse(const Device& device, const std::vector<double>& p, const IvCurve& curve);

// Searched and refined value of each parameter, in reporting units, without intervals.
std::vector<Estimate> EstimatesOf(const FitJob& job, const FitReport& report);

}  // namespace lyrefit
