#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/estimate_report.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/refine/intervals.h"
#include "lyrefit/estimate/refine/multistart.h"
#include "lyrefit/estimate/refine/profile.h"
#include "lyrefit/model/reporting_units.h"
#include "lyrefit/search/search.h"

// From a model and its measurements to an estimate: search, polish, judgement. A new kind of
// measurement is a FitModel and an EstimateProblem.
namespace lyrefit {

// A start of the polish.
struct EstimateStart {
  std::string origin;     // "best candidate", "shape"
  std::vector<double> p;  // natural parameters
};

// Errors of the residuals at the end of a polish.
struct EstimateErrors {
  double variance = 0;  // of a residual of weight 1, A^2
  int degrees = 1;      // of freedom
  Spread spread;
  std::vector<double> stretch = {};  // as in IntervalProblem
};

// A refit of a profile: the parameter stays at `value`.
struct ProfileRefit {
  const RefineEnd& best;  // around which the profile is
  double highest = 0;     // mean square at the ends of the interval
  int parameter = 0;
  double value = 0;
  RefineOptions how;
};

// What is estimated. Members that are functions may be empty: what
// is then done stands beside them.
struct EstimateProblem {
  const FitModel& model;
  // Info, bounds and whether fixed. The model may have further parameters after these.
  std::vector<Estimate> parameters;
  int readings = 0;                         // residuals without priors; 0: no criteria
  std::optional<Objective> objective = {};  // of the residuals; none: they are of several kinds

  // The search, and the parameters at a point of its box. Empty: no search; then `starts` has one.
  Box box = {};
  std::function<std::vector<double>(const double* x)> parameters_at = {};

  // Polish.
  std::vector<EstimateStart> starts = {};  // beside the elites of the search
  MultistartRules polish = {};
  // Makes the weights of the residuals those that the end of a polish shows. False: they have
  // settled. Empty: the weights stay.
  std::function<bool(const RefineEnd&)> settle = {};

  // Judgement.
  std::function<std::string(const RefineEnd&)> why_not_usable = {};  // empty: any end is
  std::function<EstimateErrors(const RefineEnd&)> errors = {};  // empty: of one size, independent
  // Whether other ends of the polish, and those of `more_optima`, may lie inside the intervals. No
  // symmetric interval then holds.
  bool several_optima = false;
  std::function<std::vector<FitPoint>(const RefineEnd&, const StopToken&)> more_optima = {};
  // Of profiles. Empty: RefineModel.
  std::function<RefineEnd(const ProfileRefit&, const FitPoint& start)> refit = {};
  RefineOptions refits = ProfileOptions({});  // of profiles
  IntervalRules intervals = {};
  EffectSpan effects = {};                // among the parameters
  std::vector<std::string> further = {};  // symbols of the further parameters
  int restarts = 0;                       // most polishes from lower optima that profiles find
};

// Readings minus free parameters, at least 1.
int DegreesOfFreedom(const EstimateProblem& problem);

struct EstimateOptions {
  SearchOptions search = {};
  Intervals intervals = Intervals::kProfile;
  int threads = 0;  // 0: all cores; never changes a result
};

// End of a polish.
struct PolishedParameters {
  RefineEnd best;                // without parameters if there is no start
  std::vector<FitPoint> others;  // other ends that may fit as well, the best first
  RefineReport course;
};

struct EstimatedParameters {
  RefineEnd end;
  EstimateReport report;
};

// Takes the starts through the stages of the problem, in turn with its weights.
PolishedParameters PolishParameters(const EstimateProblem& problem,
                                    std::vector<EstimateStart> starts,
                                    const EstimateOptions& options,
                                    const ProgressReporter& progress);

// Intervals around the end, which moves to a lower optimum that a profile finds. `searched`: the
// best candidate of the search; empty: none.
EstimatedParameters JudgeParameters(const EstimateProblem& problem,
                                    const PolishedParameters& polished,
                                    const std::vector<double>& searched,
                                    const EstimateOptions& options,
                                    const ProgressReporter& progress);

// Searches the box, polishes the elites and the starts, and judges the end. A stop of the observer
// leaves what was found so far.
EstimatedParameters EstimateParameters(const EstimateProblem& problem,
                                       const EstimateOptions& options, const Observer& observer);

// An end of a fit, and the intervals around it.
template <class Found>
struct ImprovedEnd {
  RefineEnd end;
  Found found;
};

// Finds intervals around `end`. While they show a lower optimum, `refine` polishes from there and
// they are found again, at most `restarts` times. find(end, final): the intervals; `final`: no
// restart follows. lower(found): the lower optimum that they show; empty: none.
template <class Find, class Lower, class Refine>
auto ImproveByIntervals(RefineEnd end, int restarts, const Find& find, const Lower& lower,
                        const Refine& refine) {
  ImprovedEnd<decltype(find(end, false))> improved{std::move(end), {}};
  for (int round = 0;; ++round) {
    improved.found = find(improved.end, round == restarts);
    if (round == restarts) return improved;
    const std::vector<double> from = lower(improved.found);
    if (from.empty()) return improved;
    RefineEnd there = refine(from);
    if (!(there.mean_square < improved.end.mean_square)) return improved;
    improved.end = std::move(there);
  }
}

}  // namespace lyrefit
