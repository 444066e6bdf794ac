#include "lyrefit/estimate/fit/check_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr double kRounding = 1e-9;  // of a side: candidates outside by less are clamped

Expected<void> CheckCandidate(const std::string& name, const Box& box, Candidate* candidate) {
  if (candidate->x.size() != box.lower.size()) {
    return Fail(
        fmt::format("the searcher's {} has {} coordinates, expected {}: one for each side "
                    "of the box",
                    name, candidate->x.size(), box.lower.size()));
  }
  for (std::size_t j = 0; j < box.lower.size(); ++j) {
    const double slack = kRounding * (box.upper[j] - box.lower[j]);
    double& x = candidate->x[j];
    if (!(x >= box.lower[j] - slack && x <= box.upper[j] + slack)) {
      return Fail(
          fmt::format("the searcher's {} is {:g} in coordinate {}, expected a number in "
                      "[{:g}, {:g}]",
                      name, x, j + 1, box.lower[j], box.upper[j]));
    }
    x = std::clamp(x, box.lower[j], box.upper[j]);
  }
  return {};
}

}  // namespace

Expected<void> CheckCandidates(const ObjectiveFunction& objective, const Box& box,
                               SearchSummary* summary) {
  if (summary->best.x.empty() && summary->elites.empty()) {
    return Fail(
        "the searcher came back without a best candidate: set `best` to the best point it met");
  }
  if (summary->best.x.empty()) summary->best = summary->elites.front();
  if (summary->elites.empty()) summary->elites = {summary->best};
  TRY(CheckCandidate("best candidate", box, &summary->best));
  for (std::size_t e = 0; e < summary->elites.size(); ++e) {
    const std::string name = fmt::format("elite {}", e + 1);
    TRY(CheckCandidate(name, box, &summary->elites[e]));
    summary->elites[e].objective = objective(summary->elites[e].x.data());
  }
  summary->best.objective = objective(summary->best.x.data());
  return {};
}

}  // namespace lyrefit
