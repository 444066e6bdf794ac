#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/study/algorithms.h"

namespace lyrefit {

std::vector<ComparedAlgorithm> PlainAlgorithms(const std::vector<Algorithm>& algorithms,
                                               const SearchOptions& search) {
  std::vector<ComparedAlgorithm> result;
  for (const Algorithm algorithm : algorithms) {
    ComparedAlgorithm compared;
    compared.name = compared.algorithm = ToText(algorithm);
    compared.search = search;
    compared.search.algorithm = algorithm;
    result.push_back(std::move(compared));
  }
  return result;
}

std::vector<ComparedAlgorithm> BudgetAlgorithms(const std::vector<Algorithm>& algorithms,
                                                const std::vector<std::int64_t>& budgets,
                                                const SearchOptions& search) {
  std::vector<ComparedAlgorithm> result;
  for (const Algorithm algorithm : algorithms) {
    for (const std::int64_t budget : budgets) {
      ComparedAlgorithm compared;
      compared.name = fmt::format("{}@{}", ToText(algorithm), budget);
      compared.algorithm = ToText(algorithm);
      compared.search = BudgetSearch(budget, search);
      compared.search.algorithm = algorithm;
      compared.budget = budget;
      result.push_back(std::move(compared));
    }
  }
  return result;
}

ComparedAlgorithm OwnAlgorithm(AlgorithmKind kind) {
  ComparedAlgorithm compared;
  compared.name = compared.algorithm = ToText(kind);
  compared.kind = kind;
  if (kind != AlgorithmKind::kShape) return compared;
  compared.starts = StartsFrom::kShape;
  compared.search.algorithm = Algorithm::kRandom;
  compared.search.population = 4;
  compared.search.max_evaluations = 4;
  return compared;
}

SearchOptions BudgetSearch(std::int64_t budget, SearchOptions search) {
  const double root = std::sqrt(static_cast<double>(budget));
  search.population = static_cast<int>(std::clamp(std::round(root), 4.0, 100.0));
  const std::int64_t rounds = (budget + search.population - 1) / search.population;
  search.iterations = static_cast<int>(std::clamp<std::int64_t>(rounds - 1, 1, 100000000));
  search.max_evaluations = budget;
  return search;
}

}  // namespace lyrefit
