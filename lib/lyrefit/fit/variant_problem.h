#pragma once

#include <vector>

#include "lyrefit/law/variants.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// The problem with its effects in one of their variants, and what is a whole number held at what `p`
// says.
RefineProblem InVariant(const RefineProblem& problem, const Variant& variant, const std::vector<double>& p);

// By what a root mean square error grows for each free parameter when variants are compared: so that
// the logarithms of its square are in the order of the Bayesian information criterion.
double VariantPenalty(const RefineProblem& problem, const Variant& variant);

}  // namespace lyrefit
