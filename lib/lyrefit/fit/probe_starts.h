#pragma once

#include <vector>

#include "lyrefit/refine/problem.h"

namespace lyrefit {

// Where fits of a device with effects begin besides the birds of a search: the base device polished
// by itself, with the effects' probes that tell most of what it leaves. Of an effect with few
// settings of what does not descend, one start each. Best first, `count` at most or as many as
// there are settings.
std::vector<std::vector<double>> ProbeStarts(const RefineProblem& problem, std::size_t count);

}  // namespace lyrefit
