#include "lyrefit/fit/polish.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/refine/coordinates.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

constexpr double kAgree = 1e-9;      // relative, of RMSE: two ends are the same
constexpr double kBetter = 1e-12;    // relative, of RMSE: one end is better than another
constexpr double kSameCurve = 1e-3;  // of the RMSE: two descents have come to the same curve

std::vector<double> ExplicitCurve(const RefineProblem& problem, const std::vector<double>& p) {
  std::vector<double> current;
  for (std::size_t k = 0; k < problem.voltage_V.size(); ++k) {
    current.push_back(
        ExplicitCurrent(problem.device, p.data(), problem.voltage_V[k], problem.current_A[k]));
  }
  return current;
}

double RmsDistance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// For each descent the index of the first one that gives the same curve.
std::vector<int> GroupByCurve(const RefineProblem& problem,
                              const std::vector<std::vector<double>>& descended) {
  std::vector<std::vector<double>> curves;
  std::vector<int> leader(descended.size());
  for (std::size_t s = 0; s < descended.size(); ++s) {
    curves.push_back(ExplicitCurve(problem, descended[s]));
    const double rmse = std::sqrt(MeanSquare(problem, descended[s]));
    leader[s] = static_cast<int>(s);
    for (std::size_t other = 0; other < s; ++other) {
      if (leader[other] != static_cast<int>(other)) continue;
      if (RmsDistance(curves[other], curves[s]) > kSameCurve * rmse) continue;
      leader[s] = static_cast<int>(other);
      break;
    }
  }
  return leader;
}

// The best single-diode answer with the other diodes absent, so that a richer model never ends above a
// poorer one.
std::vector<double> SingleDiodeStart(const RefineProblem& problem) {
  RefineProblem single = problem;
  single.device.parameters.resize(5);
  auto& terms = single.device.terms;
  terms.erase(std::remove_if(terms.begin(), terms.end(),
                             [](const Term& term) {
                               return term.kind == TermKind::kDiode &&
                                      term.parameter[0] != SaturationCurrentIndex(0);
                             }),
              terms.end());
  single.lower.resize(5);
  single.upper.resize(5);
  const auto starts = SeparableStarts(single, 0, 1);
  std::vector<double> p = Refine(single, SeparableDescent(single, starts.at(0).p)).p;
  for (int i = 5; i < problem.device.size(); ++i) {
    p.push_back(Coordinates::IsSaturation(i) ? problem.lower[i]
                                             : 0.5 * (problem.lower[i] + problem.upper[i]));
  }
  return p;
}

// A valley of nearly equal diodes can outlast the solver's patience: try the end again, and with each
// diode taken out, as long as that helps.
RefineEnd SecondWind(const RefineProblem& problem, RefineEnd end) {
  constexpr int kAttempts = 3;
  for (int attempt = 0; attempt < kAttempts && !end.converged; ++attempt) {
    std::vector<RefineEnd> others = {Refine(problem, end.p)};
    for (int d = 0; d < DiodeCount(problem.device); ++d) {
      const int is = SaturationCurrentIndex(d);
      if (problem.lower[is] > 0 || end.p[is] <= 0) continue;
      std::vector<double> without = end.p;
      without[is] = 0;
      others.push_back(Refine(problem, SeparableDescent(problem, without)));
    }
    for (RefineEnd& other : others) {
      const bool level = other.mean_square <= end.mean_square * (1 + kBetter);
      const bool lower = other.mean_square < end.mean_square * (1 - kBetter);
      if (lower || (level && other.converged && !end.converged)) end = std::move(other);
    }
  }
  return end;
}

}  // namespace

std::vector<PolishStart> CollectStarts(const RefineProblem& problem,
                                       const std::vector<std::vector<double>>& elites, int grid) {
  std::vector<PolishStart> starts;
  for (std::size_t k = 0; k < elites.size(); ++k) {
    starts.push_back({k == 0 ? "best bird" : "elite " + std::to_string(k + 1), elites[k]});
  }
  if (DiodeCount(problem.device) > 1) starts.push_back({"single diode", SingleDiodeStart(problem)});
  const double hint = elites.empty() ? 0 : elites[0][kRs];
  for (SeparableStart& start : SeparableStarts(problem, hint, grid)) {
    starts.push_back({std::move(start.origin), std::move(start.p)});
  }
  return starts;
}

PolishResult PolishStarts(const RefineProblem& problem, const std::vector<PolishStart>& starts,
                          int threads, const std::function<bool()>& stop) {
  const auto begin = std::chrono::steady_clock::now();
  const int all = static_cast<int>(starts.size());
  const int count = stop() ? 1 : all;
  std::vector<std::vector<double>> descended(count);
  ParallelFor(count, threads,
              [&](int s) { descended[s] = SeparableDescent(problem, starts[s].p); });
  const std::vector<int> leader = GroupByCurve(problem, descended);
  std::vector<RefineEnd> ends(count);
  ParallelFor(count, threads, [&](int s) {
    if (leader[s] == s) ends[s] = SecondWind(problem, Refine(problem, descended[s]));
  });

  PolishResult result;
  RefineReport& report = result.report;
  for (int s = 0; s < count; ++s) {
    const RefineEnd& end = ends[leader[s]];
    report.starts.push_back({starts[s].origin, std::sqrt(MeanSquare(problem, starts[s].p)),
                             std::sqrt(end.mean_square), false});
    const bool better = report.winner < 0 || report.starts[s].end_rmse_A <
                                                 report.starts[report.winner].end_rmse_A *
                                                     (1 - kBetter);
    if (better) report.winner = s;
  }
  result.first = ends[leader[0]];
  result.best = ends[leader[report.winner]];
  const double best_rmse = report.starts[report.winner].end_rmse_A;
  for (StartReport& start : report.starts) {
    start.agrees = start.end_rmse_A <= best_rmse * (1 + kAgree);
    report.agreeing += start.agrees;
  }
  report.projected_gradient = result.best.projected_gradient;
  report.termination = count < all ? "interrupted"
                       : result.best.converged ? "converged"
                                               : "no convergence";
  report.message = count < all ? "only the best bird was polished"
                   : result.best.converged
                       ? "bounds settled and least squares converged"
                       : "least squares stopped before its tolerance was reached";
  report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace lyrefit
