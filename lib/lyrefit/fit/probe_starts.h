#pragma once

#include <vector>

#include "lyrefit/law/variants.h"
#include "lyrefit/refine/active_set.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// Where fits of a device with effects begin besides the candidates of a search, in one of its variants.

// The base device polished by itself, with the effects' probes that tell most of what it leaves. Of
// an effect with few settings of what does not descend, one start each. Best first, `count` at most
// or as many as there are settings. Of effects that divide the cells also their probes at a typical
// base.
std::vector<std::vector<double>> ProbeStarts(const RefineProblem& problem, const Variant& variant,
                                             std::size_t count);

// The same beside a fit that has some of the effects already: probes of the others in the place of
// what the fit has of them, the `count` that tell most of what the fit would leave without them.
std::vector<std::vector<double>> ProbesBeside(const RefineProblem& problem, const Variant& variant,
                                              const RefineEnd& fitted,
                                              const std::vector<bool>& others, std::size_t count);

// A crystalline device with the largest current and the open-circuit voltage of the readings (of
// plain devices: the largest forward voltage), and
// its effects at `place`: where cells stand under unlike light, no base device by itself is like
// the one behind the curve. `idealities`: of each diode, which then have equal shares of the
// current; empty: a usual one, and the first diode has all.
std::vector<double> TypicalDevice(const RefineProblem& problem, const std::vector<double>& place,
                                  const std::vector<double>& idealities = {});

}  // namespace lyrefit
