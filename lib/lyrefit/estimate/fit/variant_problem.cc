#include "lyrefit/estimate/fit/variant_problem.h"

#include <cmath>

namespace lyrefit {

RefineProblem InVariant(const RefineProblem& problem, const Variant& variant,
                        const std::vector<double>& p) {
  RefineProblem own = problem;
  const std::size_t first = p.size() - variant.bounds.size();
  for (std::size_t k = 0; k < variant.bounds.size(); ++k) {
    const ParameterBounds& bounds = variant.bounds[k];
    const bool whole = bounds.whole > 0;
    own.lower[first + k] = whole ? p[first + k] : bounds.lower;
    own.upper[first + k] = whole ? p[first + k] : bounds.upper;
  }
  return own;
}

double VariantPenalty(const RefineProblem& problem, const Variant& variant) {
  const double points = static_cast<double>(problem.voltage_V.size());
  return std::exp(0.5 * variant.free * std::log(points) / points);
}

}  // namespace lyrefit
