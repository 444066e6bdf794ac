#include "lyrefit/fit/form_problem.h"

#include <cmath>

namespace lyrefit {

RefineProblem InForm(const RefineProblem& problem, const Form& form, const std::vector<double>& p) {
  RefineProblem own = problem;
  const std::size_t first = p.size() - form.bounds.size();
  for (std::size_t k = 0; k < form.bounds.size(); ++k) {
    const ParameterBounds& bounds = form.bounds[k];
    const bool whole = bounds.whole > 0;
    own.lower[first + k] = whole ? p[first + k] : bounds.lower;
    own.upper[first + k] = whole ? p[first + k] : bounds.upper;
  }
  return own;
}

double FormFactor(const RefineProblem& problem, const Form& form) {
  const double points = static_cast<double>(problem.voltage_V.size());
  return std::exp(0.5 * form.free * std::log(points) / points);
}

}  // namespace lyrefit
