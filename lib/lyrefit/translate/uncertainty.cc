#include "lyrefit/translate/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/try.h"
#include "lyrefit/translate/agreement.h"
#include "lyrefit/translate/draws.h"
#include "lyrefit/translate/linear_budget.h"

namespace lyrefit {
namespace {

constexpr double kRounding = 1e-10;

Expected<void> CheckSources(const UncertaintySources& sources, std::size_t outputs) {
  for (const UncertainInput& input : sources.inputs) {
    if (!std::isfinite(input.value) || !(input.standard_uncertainty >= 0) ||
        std::isinf(input.standard_uncertainty)) {
      return Fail(input.name + ": expected a finite value and an uncertainty of 0 or more, found " +
                  NumberText(input.value) + " and " + NumberText(input.standard_uncertainty));
    }
  }
  const auto fits = [&](const std::vector<double>& each) { return each.size() == outputs; };
  for (const OutputTerm& term : sources.terms) {
    if (!std::all_of(term.factors.begin(), term.factors.end(), fits)) {
      return Fail(term.name + ": expected factors of " + std::to_string(outputs) + " results");
    }
  }
  for (const OutputChoice& choice : sources.choices) {
    if (!std::all_of(choice.answers.begin(), choice.answers.end(), fits)) {
      return Fail(choice.name + ": expected answers of " + std::to_string(outputs) + " results");
    }
  }
  return {};
}

}  // namespace

Expected<UncertaintyBudget> Propagate(const UncertainModel& model,
                                      const UncertaintySources& sources,
                                      const UncertaintyOptions& options, const Observer& observer) {
  TRY(ValidateOptions(options, kUncertaintyOptionTable));
  TRY(CheckSources(sources, model.outputs.size()));
  UncertaintyBudget budget;
  budget.coverage_factor = options.coverage_factor;
  budget.coverage_probability = 1 - 2 * NormalTail(options.coverage_factor);
  budget.draws = options.draws;
  budget.seed = options.seed;
  AddLinearBudget(model, sources, &budget);
  if (std::none_of(budget.outputs.begin(), budget.outputs.end(),
                   [](const UncertainOutput& each) { return std::isfinite(each.value); })) {
    return Fail("none of the results has a value at the inputs as they are");
  }
  if (options.draws > 0) AddDraws(model, sources, options.threads, observer, &budget);
  JudgeAgreement(model, sources, options.significant_digits, &budget);
  return budget;
}

double UncertainOutput::low() const {
  return agreement == Agreement::kDisagree ? drawn.low : value - expanded_uncertainty;
}

double UncertainOutput::high() const {
  return agreement == Agreement::kDisagree ? drawn.high : value + expanded_uncertainty;
}

double UncertainOutput::ProbabilityBelow(double x) const {
  if (!samples.empty()) {
    const auto below = std::lower_bound(samples.begin(), samples.end(), x) - samples.begin();
    return static_cast<double>(below) / static_cast<double>(samples.size());
  }
  if (!(standard_uncertainty > 0)) return value < x ? 1 : 0;
  return NormalTail((value - x) / standard_uncertainty);
}

std::vector<std::vector<double>> FactorsOf(std::vector<std::vector<double>> covariance) {
  const std::size_t n = covariance.size();
  std::vector<double> whole(n);
  for (std::size_t k = 0; k < n; ++k) whole[k] = covariance[k][k];
  std::vector<std::vector<double>> factors;
  for (std::size_t k = 0; k < n; ++k) {
    // A variable that is determined by the previous ones has only rounding left.
    if (!(covariance[k][k] > kRounding * whole[k])) continue;
    const double root = std::sqrt(covariance[k][k]);
    std::vector<double> factor(n, 0);
    for (std::size_t i = k; i < n; ++i) factor[i] = covariance[i][k] / root;
    for (std::size_t i = k; i < n; ++i) {
      for (std::size_t j = k; j < n; ++j) covariance[i][j] -= factor[i] * factor[j];
    }
    factors.push_back(std::move(factor));
  }
  return factors;
}

}  // namespace lyrefit
