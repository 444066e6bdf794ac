#include "lyrefit/fit/polish_extended.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lyrefit/fit/probe_starts.h"

namespace lyrefit {
namespace {

constexpr double kNear = 0.02;  // relative, of RMSE: what may still become the best
constexpr double kSame = 1e-9;  // relative, of the mean square: has come to where another ended
constexpr std::size_t kProbes = 4;
constexpr std::size_t kElites = 3;

}  // namespace

std::vector<PolishStart> CollectExtendedStarts(const RefineProblem& problem,
                                               const std::vector<std::vector<double>>& elites) {
  std::vector<PolishStart> starts = {{"best bird", elites.at(0)}};
  const std::vector<std::vector<double>> probes = ProbeStarts(problem, kProbes);
  for (std::size_t k = 0; k < probes.size(); ++k) {
    starts.push_back({fmt::format("base and probe {}", k + 1), probes[k]});
  }
  for (std::size_t k = 1; k < std::min(kElites, elites.size()); ++k) {
    starts.push_back({fmt::format("elite {}", k + 1), elites[k]});
  }
  return starts;
}

PolishResult PolishExtended(const RefineProblem& problem, const std::vector<PolishStart>& starts,
                            FitWatch* watch) {
  const auto begin = std::chrono::steady_clock::now();
  watch->Begin("polish", static_cast<std::int64_t>(starts.size()));
  RefineOptions briefly;
  briefly.stop = watch->stop();
  briefly.max_rounds = 2;
  briefly.max_iterations = briefly.first_iterations = 15;
  std::vector<RefineEnd> ends;
  double lowest = HUGE_VAL, settled = HUGE_VAL;
  for (const PolishStart& start : starts) {
    ends.push_back(Refine(problem, start.p, briefly));
    lowest = std::min(lowest, ends.back().mean_square);
    if (watch->Next()) break;
  }
  RefineOptions whole;
  whole.stop = watch->stop();
  for (RefineEnd& end : ends) {
    const bool hopeless = end.mean_square > lowest * (1 + kNear) * (1 + kNear);
    const bool there = end.mean_square <= settled * (1 + kSame) && !(end.mean_square < settled);
    if (hopeless || there) continue;
    RefineEnd further = Refine(problem, end.p, whole);
    if (further.mean_square <= end.mean_square) end = std::move(further);
    settled = std::min(settled, end.mean_square);
  }
  const std::vector<FitPoint> all(ends.begin(), ends.end());
  PolishResult result = ReportEnds(problem, starts, std::move(ends), watch->stopped(), begin);
  result.ends = all;
  return result;
}

}  // namespace lyrefit
