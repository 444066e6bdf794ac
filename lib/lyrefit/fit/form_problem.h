#pragma once

#include <vector>

#include "lyrefit/law/forms.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// The problem with its effects in one of their forms, and what is a whole number held at what `p`
// says.
RefineProblem InForm(const RefineProblem& problem, const Form& form, const std::vector<double>& p);

// By what a root mean square error grows for each free parameter when forms are compared: so that
// the logarithms of its square are in the order of the Bayesian information criterion.
double FormFactor(const RefineProblem& problem, const Form& form);

}  // namespace lyrefit
