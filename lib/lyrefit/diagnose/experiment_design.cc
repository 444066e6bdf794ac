#include "lyrefit/diagnose/experiment_design.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/parallel.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostCandidates = 5;
constexpr int kTruths = 8;     // draws from the uncertainty of a candidate's parameters
constexpr int kNoises = 2000;  // draws of the noise of the further readings

// Draws a candidate from its sampling distribution: refits it to its own currents with new noise.
LawFit DrawTruth(const WeightedData& weighted, const ErrorModel& errors,
                 const PlanCandidate& candidate, RandomStream* random) {
  Readings again = *weighted.readings;
  const std::vector<double> drawn = DrawErrors(errors, random);
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    again.points[k].current = candidate.fit.current[k] + drawn[k];
  }
  WeightedData other = weighted;
  other.readings = std::make_shared<const Readings>(std::move(again));
  LawFit truth = candidate.fit;
  bool fitted = false;
  for (const std::vector<double>& start : candidate.starts) {
    LawFit fit = FitLaw(other, candidate.fit.law, start, UpTo(30, 1e-5));
    if (!fit.usable || (fitted && fit.sum >= truth.sum)) continue;
    truth = std::move(fit);
    fitted = true;
  }
  return truth;
}

// Differences between the true candidate and the others on noise-free further readings.
struct Contest {
  std::vector<double> ahead;  // per other candidate: penalised sum minus that of the truth
  Eigen::MatrixXd between;    // column per other: half of its change with unit noise
};

std::optional<Contest> Meet(const Joint& joint, const std::vector<PlanCandidate>& candidates,
                            std::size_t truth) {
  const FurtherEnd own = FitJoint(joint, candidates[truth].fit.law, candidates[truth].starts);
  if (!own.usable) return std::nullopt;
  Contest contest;
  contest.between.resize(own.after.size(), static_cast<int>(candidates.size()) - 1);
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (c == truth) continue;
    const FurtherEnd other = FitJoint(joint, candidates[c].fit.law, candidates[c].starts);
    const int at = static_cast<int>(contest.ahead.size());
    // A candidate that cannot be fitted at all loses for certain.
    const double ahead = other.usable ? other.sum - own.sum : 1e6;
    contest.ahead.push_back(ahead + candidates[c].charge - candidates[truth].charge);
    contest.between.col(at).setZero();
    if (other.usable) contest.between.col(at) = other.after - own.after;
  }
  return contest;
}

// Fraction of noise draws in which the truth has the smallest penalised sum.
double ShareAhead(const Contest& contest, RandomStream* random) {
  const Eigen::MatrixXd basis = RankedBasis(contest.between);
  const Eigen::MatrixXd moves = 2 * TransposedTimes(contest.between, basis);
  Eigen::VectorXd noise(basis.cols());
  int right = 0;
  for (int draw = 0; draw < kNoises; ++draw) {
    for (int k = 0; k < noise.size(); ++k) noise[k] = random->Normal();
    bool ahead = true;
    for (std::size_t c = 0; c < contest.ahead.size(); ++c) {
      ahead = ahead && contest.ahead[c] + moves.row(static_cast<int>(c)).dot(noise) > 0;
    }
    right += ahead ? 1 : 0;
  }
  return static_cast<double>(right) / kNoises;
}

void AddUp(const Contest& contest, const std::vector<PlanCandidate>& candidates, std::size_t truth,
           std::vector<double>* separations) {
  int at = 0;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (c != truth) (*separations)[c] += contest.between.col(at++).norm();
  }
}

PlannedCause ForeseeOne(const WeightedData& weighted, double deviation, const FollowUp& follow_up,
                        const std::vector<PlanCandidate>& candidates, std::size_t truth,
                        RandomStream random) {
  PlannedCause planned;
  planned.id = candidates[truth].effect->id;
  WeightedData scaled = weighted;
  for (double& sigma : scaled.sigma) sigma *= deviation;
  scaled.path *= deviation;
  const ErrorModel errors = ErrorsOf(scaled);
  std::vector<double> separations(candidates.size(), 0.0);
  double probability = 0;
  int drawn = 0;
  for (int draw = 0; draw < kTruths; ++draw) {
    const LawFit law = DrawTruth(weighted, errors, candidates[truth], &random);
    std::vector<double> unknown;
    for (std::size_t k = 0; k < follow_up.unknown.size(); ++k) unknown.push_back(random.Normal());
    const auto joint = TakeFurther(weighted, deviation, follow_up, law, unknown);
    if (!joint) continue;
    const auto contest = Meet(*joint, candidates, truth);
    if (!contest) continue;
    probability += ShareAhead(*contest, &random);
    AddUp(*contest, candidates, truth, &separations);
    ++drawn;
  }
  if (drawn == 0) return planned;
  planned.probability = probability / drawn;
  std::size_t nearest = truth == 0 ? 1 : 0;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (c != truth && separations[c] < separations[nearest]) nearest = c;
  }
  planned.nearest = candidates[nearest].effect->id;
  planned.separation = separations[nearest] / drawn;
  return planned;
}

double Mean(const std::vector<PlannedCause>& causes) {
  double sum = 0;
  for (const PlannedCause& cause : causes) sum += cause.probability;
  return sum / static_cast<double>(causes.size());
}

std::string PlanSentence(const Plan& plan) {
  if (plan.causes.empty())
    return "no cause has others that look like it: nothing is to be told apart";
  if (plan.measurements.empty()) return "no further measurement can be simulated for these data";
  const PlannedMeasurement& best = plan.measurements.front();
  if (!(best.probability >= kTelling)) return "none of these measurements separates them";
  return "take " + best.title;
}

}  // namespace

PlanCandidate MakeCandidate(const Readings& readings, const FittedCandidate& fitted) {
  constexpr std::size_t kFew = 8;
  const LawFit& fit = fitted.fit;
  const Effect& effect = *fitted.score.effect;
  PlanCandidate candidate{&effect, fit, -2 * fitted.log_posterior - fit.sum, {fit.p}};
  const int first = ParametersAt(fit.law, effect);
  std::set<std::vector<double>> settings;
  if (effect.probes == nullptr) return candidate;
  for (const Probe& probe : effect.probes(readings.traits)) {
    std::vector<double> start = fit.p;
    for (int k = 0; k < effect.size(); ++k) {
      if (effect.parameters[k].searched) start[first + k] = probe[k];
    }
    if (start != fit.p) settings.insert(start);
  }
  if (settings.size() <= kFew) {
    candidate.starts.insert(candidate.starts.end(), settings.begin(), settings.end());
  }
  return candidate;
}

std::vector<PlanCandidate> PlanCandidates(const Selection& selection) {
  const ChosenCause* first = nullptr;
  for (const ChosenCause& cause : selection.causes) {
    if (EquivalentsOf(cause).empty() || OwnCandidate(cause) == nullptr) continue;
    if (first == nullptr || cause.probability > first->probability) first = &cause;
  }
  std::vector<PlanCandidate> candidates;
  if (first == nullptr) return candidates;
  const auto add = [&](const FittedCandidate& fitted) {
    candidates.push_back(MakeCandidate(*selection.weighted.readings, fitted));
  };
  add(*OwnCandidate(*first));
  for (const FittedCandidate* fitted : EquivalentsOf(*first)) {
    if (candidates.size() < kMostCandidates) add(*fitted);
  }
  return candidates;
}

double DeviationOf(const Selection& selection) {
  return std::sqrt(NoiseVariance(selection.weighted, selection.extended));
}

std::vector<PlannedCause> Foresee(const WeightedData& weighted, double deviation,
                                  const FollowUp& follow_up,
                                  const std::vector<PlanCandidate>& candidates,
                                  std::uint64_t seed) {
  std::vector<PlannedCause> causes;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    causes.push_back(
        ForeseeOne(weighted, deviation, follow_up, candidates, c, RandomStream(seed, c)));
  }
  return causes;
}

Plan MakePlan(const Selection& selection, std::uint64_t seed, int threads) {
  Plan plan;
  const std::vector<PlanCandidate> candidates = PlanCandidates(selection);
  for (const PlanCandidate& candidate : candidates) plan.causes.push_back(candidate.effect->id);
  if (!candidates.empty()) {
    const std::vector<FollowUp> all = FollowUpMeasurements(*selection.weighted.readings);
    std::vector<std::vector<PlannedCause>> causes(all.size());
    const double deviation = DeviationOf(selection);
    selection.weighted.progress.Begin("plan", static_cast<std::int64_t>(all.size()));
    ParallelFor(static_cast<int>(all.size()), threads, [&](int k) {
      causes[k] = Foresee(selection.weighted, deviation, all[k], candidates, seed);
      selection.weighted.progress.Count();
    });
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double probability = Mean(causes[k]);
      if (!std::isfinite(probability)) continue;
      plan.measurements.push_back({all[k].id, all[k].title, all[k].taken, probability, causes[k]});
    }
    std::stable_sort(plan.measurements.begin(), plan.measurements.end(),
                     [](const auto& a, const auto& b) { return a.probability > b.probability; });
  }
  plan.sentence = PlanSentence(plan);
  return plan;
}

}  // namespace lyrefit
