#pragma once

#include <vector>

#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

// RefineModel of one curve.
RefineEnd Refine(const RefineProblem& problem, std::vector<double> start,
                 const RefineOptions& options = {});

// SeparableDescent, with the tolerance of `options` but at least 1e-11, then Refine. Never ends
// above `start`: if the descent ends higher, Refine runs from `start` itself.
RefineEnd RefineFrom(const RefineProblem& problem, const std::vector<double>& start,
                     const RefineOptions& options = {});

// RefineModelPlainly of one curve.
RefineEnd RefinePlainly(const RefineProblem& problem, std::vector<double> start,
                        const RefineOptions& options = {});

}  // namespace lyrefit
