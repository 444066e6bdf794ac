#pragma once

#include <vector>

#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/model/variants.h"

namespace lyrefit {

// The problem with its effects in one variant and integer parameters fixed at their values in `p`.
RefineProblem InVariant(const RefineProblem& problem, const Variant& variant,
                        const std::vector<double>& p);

// Penalty factor on the RMSE for the free parameters of a variant. The logarithms of the squared
// penalised RMSEs rank variants as BIC does.
double VariantPenalty(const RefineProblem& problem, const Variant& variant);

}  // namespace lyrefit
