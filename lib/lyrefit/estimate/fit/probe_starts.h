#pragma once

#include <vector>

#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/model/variants.h"

namespace lyrefit {

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
