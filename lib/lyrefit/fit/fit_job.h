#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/fit_watch.h"
#include "lyrefit/law/variants.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// What the stages of one fit hand to each other.
struct FitJob {
  const IvCurve& curve;
  const FitOptions& options;
  const Observer& observer;
  std::vector<ParameterBounds> bounds;
  std::vector<double> fixed;
  int free_parameters = 0;
  RefineProblem problem;  // on the distinct readings, or on all of a device with effects
  RefineProblem coarse;      // the same problem or, of many points, what stands for it in the search
  FitWatch watch;
  std::vector<Variant> variants = {};  // of a device with effects
  IvCurve distinct = {};         // the curve with each reading once: what counts as evidence

  int readings() const { return static_cast<int>(distinct.size()); }

  // The rows of `problem`.
  const IvCurve& fitted() const { return variants.empty() ? distinct : curve; }

  // Of its base, which come first.
  int base_size() const { return problem.device.size() - effects(); }
  int effects() const { return variants.empty() ? 0 : static_cast<int>(variants[0].bounds.size()); }
};

// Beside effects the measured current is refused.
Expected<void> CheckObjectiveOfEffects(Objective objective);

// Checks the curve and the options; the device, bounds and the problem to solve.
Expected<void> PrepareFit(FitJob* job, FitReport* report);

// See FitReport::variant_penalty.
double VariantPenaltyOf(const FitJob& job, int variant);

// Settles for one of the variants, what is a whole number at what `p` says: bounds, problem and the
// effects of the device that is reported.
void SelectVariant(int variant, const std::vector<double>& p, FitJob* job, FitReport* report);

RmsePair BothRmse(const Device& device, const std::vector<double>& p, const IvCurve& curve);

// One for each parameter, in the units of reports, as searched and as refined; no intervals.
std::vector<Estimate> EstimatesOf(const FitJob& job, const FitReport& report);

}  // namespace lyrefit
