#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/study/contenders.h"

namespace lyrefit {

std::vector<Contender> PlainContenders(const std::vector<Algorithm>& algorithms,
                                       const SearchOptions& search) {
  std::vector<Contender> contenders;
  for (const Algorithm algorithm : algorithms) {
    Contender contender;
    contender.name = contender.algorithm = ToText(algorithm);
    contender.search = search;
    contender.search.algorithm = algorithm;
    contenders.push_back(std::move(contender));
  }
  return contenders;
}

std::vector<Contender> SensitivityContenders(const std::vector<double>& memory_rates,
                                             const std::vector<double>& distance_coefficients,
                                             const SearchOptions& search) {
  std::vector<Contender> contenders;
  for (const double memory_rate : memory_rates) {
    for (const double distance_coefficient : distance_coefficients) {
      Contender contender;
      contender.name = fmt::format("Pm={:g} gamma={:g}", memory_rate, distance_coefficient);
      contender.algorithm = ToText(Algorithm::kMlo);
      contender.search = search;
      contender.search.algorithm = Algorithm::kMlo;
      contender.search.memory_rate = memory_rate;
      contender.search.distance_coefficient = distance_coefficient;
      contenders.push_back(std::move(contender));
    }
  }
  return contenders;
}

std::vector<Contender> BudgetContenders(const std::vector<Algorithm>& algorithms,
                                        const std::vector<std::int64_t>& budgets,
                                        const SearchOptions& search) {
  std::vector<Contender> contenders;
  for (const Algorithm algorithm : algorithms) {
    for (const std::int64_t budget : budgets) {
      Contender contender;
      contender.name = fmt::format("{}@{}", ToText(algorithm), budget);
      contender.algorithm = ToText(algorithm);
      contender.search = BudgetSearch(budget, search);
      contender.search.algorithm = algorithm;
      contender.budget = budget;
      contenders.push_back(std::move(contender));
    }
  }
  return contenders;
}

Contender OwnContender(ContenderKind kind) {
  Contender contender;
  contender.name = contender.algorithm = ToText(kind);
  contender.kind = kind;
  if (kind != ContenderKind::kShape) return contender;
  contender.starts = StartsFrom::kShape;
  contender.search.algorithm = Algorithm::kRandom;
  contender.search.population = 4;
  contender.search.max_evaluations = 4;
  return contender;
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
