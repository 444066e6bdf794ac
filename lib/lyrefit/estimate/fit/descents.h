#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/refine/multistart.h"
#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {

// Current end of the descent from one start. `value` is its mean square times the squared penalty
// factor of the variant (VariantPenalty); it ranks ends of different variants. `group` is the
// variant.
struct DescentEnd : MultistartEnd {
  PolishStart start;
  RefineEnd end;
};

// Multistart for a device with effects, which has many local optima.
using Descents = Multistart<DescentEnd>;

// Descends from `starts` on the fit's problem.
void Descend(const PreparedFit& fit, std::vector<PolishStart> starts,
             const ProgressReporter& progress, Descents* descents);

// Finished ends in the best optimum. Needs an earlier start, as CountOptima does.
int BestVisits(const Descents& descents);
OptimumCount CountOptima(const Descents& descents);

}  // namespace lyrefit
