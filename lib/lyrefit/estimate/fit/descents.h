#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/estimate/refine/multistart.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/model/variants.h"

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

// Starts for descents among the local optima of a device with effects.

// Starts from the shape of the curve, in every variant, on a typical device. Their origins are
// "shape 1", ...
constexpr char kShapeOrigin[] = "shape ";
std::vector<PolishStart> ShapeStarts(const PreparedFit& fit);

// The best of many random points, none close to another. Every second one has the base parameters
// of `best`, so that only the effects are random.
std::vector<PolishStart> RandomStarts(const PreparedFit& fit, const SearchSpace& space,
                                      const std::vector<double>& best, RandomStream* random);

// Starts near an end: with one integer parameter a step up or down, with one integer up and another
// down, or with the next settings of each enumerated parameter. The end transferred to the other
// variants is added.
std::vector<PolishStart> Neighbours(const PreparedFit& fit, const DescentEnd& at);

// Starts from an end with one parameter moved within its range. Parameters that describe how an
// effect acts are moved, not its strength.
std::vector<PolishStart> Elsewhere(const PreparedFit& fit, const DescentEnd& at);

// Starts with each enumerated parameter at values spread over its settings.
std::vector<PolishStart> SpreadSettings(const PreparedFit& fit, const PolishStart& at);

// Starts at `places` in one variant, with the origins "ORIGIN 1", "ORIGIN 2", ...
std::vector<PolishStart> Named(const std::string& origin, int variant,
                               std::vector<std::vector<double>> places);

// Starts of fits of a device with effects, in one of its variants, in addition to candidates of the
// search.

// Starts at the base device polished without effects, combined with those probes of the effects
// that explain most of its residuals. An effect with few settings of its enumerated parameters gets
// one start per setting. Best first, at most `count` or the number of settings. If an effect has
// cell groups, its probes at a typical base device are added.
std::vector<std::vector<double>> ProbeStarts(const RefineProblem& problem, const Variant& variant,
                                             std::size_t count);

// Probe starts from a fit that includes some of the effects. Probes of the `others` replace their
// fitted values. The result is the `count` probes that explain most of the residuals of the fit
// without those effects.
std::vector<std::vector<double>> ProbesBeside(const RefineProblem& problem, const Variant& variant,
                                              const RefineEnd& fitted,
                                              const std::vector<bool>& others, std::size_t count);

// A typical crystalline device with the largest current and the open-circuit voltage of the
// readings (without effects: the largest forward voltage), and its effects at `place`. Such a start
// is needed if cells are under unlike irradiance, since no base device alone then resembles the one
// behind the curve. All current is in the first diode.
std::vector<double> TypicalDevice(const RefineProblem& problem, const std::vector<double>& place);

}  // namespace lyrefit
