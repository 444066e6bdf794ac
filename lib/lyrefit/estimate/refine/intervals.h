#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/refine/estimate.h"
#include "lyrefit/estimate/refine/profile.h"
#include "lyrefit/estimate/refine/spread.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {

// Steps of FindIntervals, each after those before it.
enum class IntervalStep {
  kBounds,     // marks active bounds
  kErrors,     // standard errors and the parameters without one
  kSymmetric,  // symmetric intervals and correlations
  kProfile,    // profiles where a symmetric interval is not valid
};

// Choices by the cost of a refit and by the wording of a report.
struct IntervalRules {
  // True: refits are cheap (one curve). All parameters are profiled if one is at a bound or if a
  // direction is undetermined, which makes all standard errors unknown. Absent diodes are marked
  // together with profiles. False: refits are expensive (many curves). A parameter is profiled only
  // if its own symmetric interval is not valid. One without a standard error and the saturation
  // current of an absent diode are marked instead.
  bool thorough = true;
  // Whether an effect's parameter is marked if its interval ends at a bound other than the value at
  // which the effect is absent. Absence is a valid result.
  bool judge_open_ends = true;
  // Whether a diode that the data allow to be absent, although the fit has it, is marked.
  bool judge_absent_diodes = true;
  const char* no_shunt = "";      // reason: no upper limit of a shunt
  const char* undetermined = "";  // reason: no standard error and no profile
};

// Input of FindIntervals; all values in reporting units.
struct IntervalProblem {
  std::vector<Estimate> estimates;  // info, bounds, fixed, searched and refined
  std::vector<bool> active;         // at a bound or of a dropped diode
  EffectSpan effects;
  IntervalStep last = IntervalStep::kProfile;
  IntervalRules rules;
  int threads = 0;
  // From kErrors on. The model may have further parameters after the estimates.
  Spread spread;
  std::vector<double> t;             // quantile of Student's t, of each estimate
  std::vector<std::string> further;  // symbols of the further parameters
  // From kProfile on.
  double variance = 0;          // of a residual of weight 1
  std::vector<double> stretch;  // factors of t in profiles, contained in the spread; empty: 1
  bool several_optima = false;  // whether `profile` covers other optima that fit as well
  bool end_at_better = false;   // as in ProfileQuery
  // One end of a profile interval by refits; called from several threads.
  std::function<ProfileSide(const ProfileQuery&)> profile;
};

// Estimates of parameters with these bounds, equal ones of a fixed parameter; without values.
std::vector<Estimate> MakeEstimates(const std::vector<ParameterInfo>& infos,
                                    const std::vector<double>& lower,
                                    const std::vector<double>& upper);

// `searched`: values before the fit; empty: none.
std::vector<Estimate> WithValues(std::vector<Estimate> estimates,
                                 const std::vector<double>& searched,
                                 const std::vector<double>& refined);

struct IntervalReport {
  std::vector<Estimate> estimates;
  std::vector<Correlation> correlations;  // strong ones, the strongest first
  double condition = kUnknown;            // of the spread
  // ProfileSide::better of all profiles that found a lower optimum, in their order.
  std::vector<std::vector<double>> better;
};

// Standard errors, 95 % intervals, active bounds and identifiability of all estimates. After a
// request to stop, parameters keep the intervals found so far.
IntervalReport FindIntervals(IntervalProblem problem, const ProgressReporter& progress);

// The symmetric interval of half-width t x `standard_error` on the parameter's scale, clipped to
// the bounds. NaN without a finite standard error.
ParameterRange SymmetricRange(ParameterKind kind, double value, double standard_error, double t,
                              const ParameterBounds& bounds);

}  // namespace lyrefit
