#include "lyrefit/estimate/fit/polish.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "lyrefit/estimate/refine/multistart.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/model/device_effects.h"

namespace lyrefit {
namespace {

bool ConditionsChange(const Device& device) {
  if (device.effects == nullptr) return false;
  const std::vector<const Effect*>& effects = device.effects->law.effects;
  return std::any_of(effects.begin(), effects.end(),
                     [](const Effect* effect) { return static_cast<bool>(effect->conditions); });
}

// Indices of parameters that are exchanged together with those of another set.
using AlikeSet = std::vector<int>;

struct Ordering {
  const std::vector<ParameterBounds>& bounds;
  std::vector<double>* p;
  std::vector<bool>* active;

  // Sorts the sets. `wrong`: whether two neighbours are in the wrong order.
  void Sort(const std::vector<AlikeSet>& sets,
            const std::function<bool(const AlikeSet&, const AlikeSet&)>& wrong) const {
    for (std::size_t pass = 0; pass < sets.size(); ++pass) {
      for (std::size_t k = 0; k + 1 < sets.size(); ++k) {
        if (Same(sets[k], sets[k + 1]) && wrong(sets[k], sets[k + 1])) Swap(sets[k], sets[k + 1]);
      }
    }
  }

  bool Same(const AlikeSet& a, const AlikeSet& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), [this](int i, int j) {
      return bounds[i].lower == bounds[j].lower && bounds[i].upper == bounds[j].upper;
    });
  }

  void Swap(const AlikeSet& a, const AlikeSet& b) const {
    for (std::size_t k = 0; k < a.size(); ++k) {
      std::swap((*p)[a[k]], (*p)[b[k]]);
      if (active == nullptr) continue;
      const bool first = (*active)[a[k]];
      (*active)[a[k]] = (*active)[b[k]];
      (*active)[b[k]] = first;
    }
  }
};

bool IsAbsent(const Effect& effect, const AlikeSet& set, const double* p, int first) {
  return std::any_of(set.begin(), set.end(),
                     [&](int i) { return p[i] == effect.parameters[i - first].absent_at; });
}

}  // namespace

void OrderAlike(const Device& device, const std::vector<ParameterBounds>& bounds,
                std::vector<double>* p, std::vector<bool>* active) {
  const Ordering ordering{bounds, p, active};
  if (!ConditionsChange(device)) {
    std::vector<AlikeSet> diodes;
    diodes.reserve(DiodeCount(device));
    for (int d = 0; d < DiodeCount(device); ++d) {
      diodes.push_back({SaturationCurrentIndex(d), IdealityIndex(d)});
    }
    ordering.Sort(diodes, [p](const AlikeSet& a, const AlikeSet& b) {
      const bool first_gone = (*p)[a[0]] <= 0, second_gone = (*p)[b[0]] <= 0;
      return first_gone != second_gone ? first_gone : (*p)[b[1]] < (*p)[a[1]];
    });
  }
  if (device.effects == nullptr) return;
  int first = device.size();
  for (const Effect* effect : device.effects->law.effects) first -= effect->size();
  for (const Effect* effect : device.effects->law.effects) {
    std::vector<AlikeSet> groups = effect->alike;
    for (AlikeSet& group : groups) {
      for (int& i : group) i += first;
    }
    ordering.Sort(groups, [&](const AlikeSet& a, const AlikeSet& b) {
      const bool gone = IsAbsent(*effect, a, p->data(), first);
      if (gone != IsAbsent(*effect, b, p->data(), first)) return gone;
      return (*p)[b[0]] < (*p)[a[0]];
    });
    first += effect->size();
  }
}

namespace {

constexpr double kSameCurve = 1e-3;  // of the RMSE: two descents reached the same curve
// Relative to the RMSE: ends on coarsened data within this of the best are solved on all points.
constexpr double kMayBeBest = 1e-3;
// Tolerance on all points. It is far below the noise; a solve that starts at the optimum of the
// coarsened data would otherwise only creep.
constexpr double kToleranceOnMany = 1e-12;

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

// Separable descent from one start. `value` is its RMSE.
struct SeparableEnd : MultistartEnd {
  std::vector<double> p;      // the start, then the end
  std::vector<double> curve;  // at the end
  int leader = -1;            // first start whose descent reached the same curve
};

bool SameCurve(const SeparableEnd& a, const SeparableEnd& b) {
  return !(RmsDistance(a.curve, b.curve) > kSameCurve * std::min(a.value, b.value));
}

bool SameLeader(const SeparableEnd& a, const SeparableEnd& b) { return a.leader == b.leader; }

// Descends from the starts in turn until enough have reached the best curve, or to a stop request.
// Returns the ends of these starts.
std::vector<SeparableEnd> DescendInTurn(const RefineProblem& problem,
                                        const std::vector<PolishStart>& starts,
                                        const ProgressReporter& progress) {
  Multistart<SeparableEnd> run;
  const auto refine = [&](const MultistartStage& /*stage*/, SeparableEnd* at) {
    at->p = SeparableDescent(problem, at->p);
    at->curve = ExplicitCurve(problem, at->p);
    at->value = std::sqrt(MeanSquare(problem, at->p));
    const int s = static_cast<int>(at - run.ends.data());
    int k = 0;
    while (k < s && !(run.ends[k].leader == k && SameCurve(*at, run.ends[k]))) ++k;
    at->leader = k;
  };
  MultistartRules rules;
  rules.visits = DiodeCount(problem.device) == 1 ? 2 : 3;  // one diode has few local optima
  rules.progress = progress;
  std::vector<SeparableEnd> from(starts.size());
  for (std::size_t s = 0; s < starts.size(); ++s) from[s].p = starts[s].p;
  RunMultistart(rules, std::move(from), refine, SameLeader, &run);
  while (!run.ends.back().finished) run.ends.pop_back();
  return std::move(run.ends);
}

// Makes start s the leader of its own group. The next member of its old group becomes the leader of
// the others and gets the end of s.
void LeaveGroup(int s, std::vector<int>* leader, std::vector<RefineEnd>* ends) {
  int heir = -1;
  for (int other = s + 1; other < static_cast<int>(leader->size()); ++other) {
    if ((*leader)[s] != s || (*leader)[other] != s) continue;
    if (heir < 0) (*ends)[other] = (*ends)[s];
    if (heir < 0) heir = other;
    (*leader)[other] = heir;
  }
  (*leader)[s] = s;
}

// The best single-diode curve with the other diodes absent, so that a richer model never ends above
// a simpler one.
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
  std::vector<double> p = SeparableDescent(single, starts.at(0).p);
  for (int i = 5; i < problem.device.size(); ++i) {
    const bool saturation = problem.device.parameters[i].kind == ParameterKind::kSaturation;
    p.push_back(saturation ? problem.lower[i] : 0.5 * (problem.lower[i] + problem.upper[i]));
  }
  return p;
}

// A solve near nearly equal diodes may not converge. Restarts from the end, and with each diode
// removed, as long as the solve has not converged.
RefineEnd Restart(const RefineProblem& problem, const RefineOptions& how, RefineEnd end) {
  constexpr int kAttempts = 3;
  for (int attempt = 0; attempt < kAttempts && !end.converged; ++attempt) {
    if (how.stop.Stopped()) break;
    std::vector<RefineEnd> others = {Refine(problem, end.p, how)};
    for (int d = 0; d < DiodeCount(problem.device); ++d) {
      const int is = SaturationCurrentIndex(d);
      if (problem.lower[is] > 0 || end.p[is] <= 0) continue;
      std::vector<double> without = end.p;
      without[is] = 0;
      others.push_back(Refine(problem, SeparableDescent(problem, without), how));
    }
    for (RefineEnd& other : others) {
      const bool level = other.mean_square <= end.mean_square * (1 + kBetter);
      const bool lower = other.mean_square < end.mean_square * (1 - kBetter);
      if (lower || (level && other.converged && !end.converged)) end = std::move(other);
    }
  }
  return end;
}

// Solves those ends on coarsened data that may be the best, and the first one, again on all points.
// The others are only evaluated there.
void FinishOnAll(const RefineProblem& problem, RefineOptions how, const std::vector<int>& leader,
                 std::vector<RefineEnd>* ends) {
  how.function_tolerance = kToleranceOnMany;
  double lowest = HUGE_VAL;
  for (std::size_t s = 0; s < ends->size(); ++s) {
    if (leader[s] != static_cast<int>(s)) continue;
    lowest = std::min(lowest, std::sqrt((*ends)[s].mean_square));
  }
  for (std::size_t s = 0; s < ends->size(); ++s) {
    if (leader[s] != static_cast<int>(s)) continue;
    RefineEnd& end = (*ends)[s];
    if (s == 0 || std::sqrt(end.mean_square) <= lowest * (1 + kMayBeBest)) {
      end = Refine(problem, end.p, how);
    } else {
      end.mean_square = MeanSquare(problem, end.p);
    }
  }
}

}  // namespace

PolishResult ReportEnds(const RefineProblem& problem, const std::vector<PolishStart>& starts,
                        std::vector<RefineEnd> ends, int winner, bool stopped, Instant begin) {
  PolishResult result;
  RefineReport& report = result.report;
  for (std::size_t s = 0; s < ends.size(); ++s) {
    const double end_rmse = std::sqrt(ends[s].mean_square);
    report.starts.push_back(
        {starts[s].origin, std::sqrt(MeanSquare(problem, starts[s].p)), end_rmse, false});
    if (winner >= 0) {
      report.winner = winner;
    } else if (report.winner < 0 ||
               end_rmse < report.starts[report.winner].end_rmse_A * (1 - kBetter)) {
      report.winner = static_cast<int>(s);
    }
  }
  result.first = ends[0];
  result.best = std::move(ends[report.winner]);
  const double best_rmse = report.starts[report.winner].end_rmse_A;
  for (StartReport& start : report.starts) {
    start.agrees = std::fabs(start.end_rmse_A - best_rmse) <= best_rmse * kAgree;
    report.agreeing += start.agrees;
  }
  report.projected_gradient = result.best.projected_gradient;
  const bool converged = result.best.converged;
  report.termination = stopped ? "interrupted" : converged ? "converged" : "no convergence";
  report.message = stopped     ? "not every start was polished"
                   : converged ? "bounds settled and least squares converged"
                               : "least squares stopped before its tolerance was reached";
  report.seconds = SecondsSince(begin);
  return result;
}

std::vector<PolishStart> CollectStarts(const RefineProblem& problem,
                                       const std::vector<PolishStart>& candidates, int grid) {
  std::vector<PolishStart> starts = {candidates.at(0)};
  std::vector<SeparableStart> separable = SeparableStarts(problem, candidates[0].p[kRs], grid);
  const std::size_t rounds = std::max(separable.size(), candidates.size());
  for (std::size_t k = 0; k < rounds; ++k) {
    if (k < separable.size()) {
      starts.push_back({std::move(separable[k].origin), std::move(separable[k].p)});
    }
    if (k == 0 && DiodeCount(problem.device) > 1) {
      starts.push_back({"single diode", SingleDiodeStart(problem)});
    }
    if (k + 1 < candidates.size()) starts.push_back(candidates[k + 1]);
  }
  return starts;
}

PolishResult PolishStarts(const RefineProblem& problem, const RefineProblem& coarse,
                          const std::vector<PolishStart>& starts,
                          const ProgressReporter& progress) {
  const Instant begin = Now();
  progress.BeginSilently("polish", static_cast<std::int64_t>(starts.size()));
  RefineOptions how;
  how.stop = progress.stop();
  const std::vector<SeparableEnd> descended = DescendInTurn(coarse, starts, progress);
  const int count = static_cast<int>(descended.size());
  std::vector<int> leader;
  leader.reserve(count);
  for (const SeparableEnd& end : descended) leader.push_back(end.leader);
  std::vector<RefineEnd> ends(count);
  for (int s = 0; s < count; ++s) {
    if (leader[s] == s) ends[s] = Restart(coarse, how, Refine(coarse, descended[s].p, how));
    // If the descent ended above its start, polish the start itself.
    if (ends[leader[s]].mean_square <= MeanSquare(coarse, starts[s].p) * (1 + kAgree)) continue;
    RefineEnd own = Restart(coarse, how, Refine(coarse, starts[s].p, how));
    if (own.mean_square >= ends[leader[s]].mean_square) continue;
    LeaveGroup(s, &leader, &ends);
    ends[s] = std::move(own);
  }
  if (coarse.points.size < problem.points.size) FinishOnAll(problem, how, leader, &ends);

  std::vector<RefineEnd> end_of;
  end_of.reserve(count);
  for (int s = 0; s < count; ++s) end_of.push_back(ends[leader[s]]);
  return ReportEnds(problem, starts, std::move(end_of), -1, progress.stop().requested(), begin);
}

}  // namespace lyrefit
