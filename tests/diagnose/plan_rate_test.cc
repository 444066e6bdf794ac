#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/parallel.h"
#include "lyrefit/diagnose/choose_base.h"
#include "lyrefit/diagnose/experiment_design.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

constexpr double kNoise = 5e-4;  // relative to the current scale

// Repeats of each pair from LYREFIT_PLAN_REPEATS, or 0 if it is not set. 40 repeats measure the
// accuracy for all pairs in a quarter of an hour. Without it, only the first pairs are tried.
int RepeatsAsked() {
  const char* const asked = std::getenv("LYREFIT_PLAN_REPEATS");
  return asked != nullptr ? std::max(std::atoi(asked), 1) : 0;
}
constexpr int kFewPairs = 2, kFewRepeats = 8;

// A true cause, another cause that looks alike, and the measurement.
struct Pair {
  const char* truth;
  std::vector<double> p;
  const char* other;
  Recipe recipe;
  bool dark_too = false;
  double path = 0;
};

Recipe Cell(bool and_back = false) {
  Recipe recipe;
  recipe.noise_A = 0;
  recipe.and_back = and_back;
  return recipe;
}

Recipe Module(bool and_back = false) {
  Recipe recipe = Cell(and_back);
  recipe.cells = 60;
  return recipe;
}

std::vector<Pair> Pairs() {
  return {
      {"nonohmic_shunt", {0.4, 2}, "collection", Cell()},
      {"collection", {0.04}, "nonohmic_shunt", Cell()},
      {"shading", {0.02, 1.0 / 3, 0.5, 1}, "irr_step", Module()},
      {"mismatch", {0.1, 0.3}, "weak_cell", Module(), false, 5e-4},
      {"drift", {0.006}, "irr_step", Cell(true)},
      {"capacitance", {0, 0.004, 0}, "timing_skew", Cell(true)},
      {"photoshunt", {0.03, 0}, "collection", Cell(), true},
      {"second_diode", {0.5}, "transient", Cell()},
      {"mismatch", {0.1, 0.3}, "shading", Module(), false, 5e-4},
      {"transient", {0.01, 0.2, 0.08, 0, 2}, "shading", Module(), false, 1e-3},
      {"weak_cell", {0.06, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1}, "leaky_cell", Module(), false, 5e-4},
  };
}

struct Outcome {
  std::map<std::string, double> foreseen;  // probability by measurement
  std::map<std::string, bool> right;
};

// The simulated measurement of a pair.
struct Synthetic {
  LawFit truth;
  WeightedData weighted;
};

Synthetic Make(const Pair& pair, RandomStream* random) {
  std::vector<IvCurve> curves = {SyntheticCurve(pair.recipe)};
  if (pair.dark_too) {
    Recipe dark = pair.recipe;
    dark.irradiance_W_m2 = 0;
    curves.push_back(SyntheticCurve(dark));
  }
  Synthetic made;
  Readings readings = MakeMeasurement(SetOf(curves))->readings;
  made.weighted.readings = std::make_shared<const Readings>(readings);
  made.weighted.sigma.assign(readings.points.size(), kNoise);
  made.weighted.used.assign(readings.points.size(), 1);
  made.weighted.path = pair.path;
  made.truth = FitBase(made.weighted, StartingLaw(readings, Model::kSingleDiode));
  made.truth.law.effects.push_back(FindEffect(pair.truth));
  made.truth.p.insert(made.truth.p.end(), pair.p.begin(), pair.p.end());
  LawWorkspace workspace;
  EXPECT_TRUE(EvaluateLaw(made.truth.law, readings, made.truth.p.data(), &workspace,
                          made.truth.current.data(), nullptr));
  const std::vector<double> errors = DrawErrors(ErrorsOf(made.weighted), random);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    readings.points[k].current = made.truth.current[k] + errors[k];
  }
  made.weighted.readings = std::make_shared<const Readings>(std::move(readings));
  return made;
}

// Fits the true cause and the one that looks alike. Empty if the data already distinguish them or
// support neither.
std::vector<PlanCandidate> FitPair(const Pair& pair, const Synthetic& made) {
  constexpr double kApart = 6, kFound = 12;
  const LawFit base =
      FitBase(made.weighted, StartingLaw(*made.weighted.readings, Model::kSingleDiode));
  std::vector<PlanCandidate> candidates;
  Signatures signatures;
  Hypotheses pairs;
  pairs.none.fit = base;
  for (const Score& score : ScoreEffects(
           made.weighted, base, {FindEffect(pair.truth), FindEffect(pair.other)}, &signatures)) {
    if (!score.testable) return {};
    LawFit fit = FitEffect(made.weighted, base, score);
    if (!fit.usable) return {};
    pairs.candidates.push_back({score, std::move(fit)});
  }
  JudgeOptions alike;
  alike.priors.alike = true;
  Judge(made.weighted, base, alike, &pairs);
  for (const FittedCandidate& candidate : pairs.candidates) {
    candidates.push_back(MakeCandidate(*made.weighted.readings, candidate));
  }
  if (candidates.front().effect != FindEffect(pair.truth)) std::swap(candidates[0], candidates[1]);
  const double apart =
      candidates[0].fit.sum + candidates[0].charge - candidates[1].fit.sum - candidates[1].charge;
  const double least = std::min(candidates[0].fit.sum, candidates[1].fit.sum);
  if (std::fabs(apart) > kApart || base.sum - least < kFound) return {};
  return candidates;
}

// Numbers of the simulated measurements, out of `tries`, that leave both causes possible.
std::vector<int> OpenOnes(const Pair& pair, int tries) {
  std::vector<char> open(tries);
  ParallelFor(tries, 0, [&](int k) {
    RandomStream random(17, k);
    const Synthetic made = Make(pair, &random);
    open[k] = FitPair(pair, made).empty() ? 0 : 1;
  });
  std::vector<int> numbers;
  for (int k = 0; k < tries; ++k) {
    if (open[k] != 0) numbers.push_back(k);
  }
  return numbers;
}

// The pair with the strength of its cause reduced to the value at which most measurements leave
// both causes possible.
Pair Settled(Pair pair) {
  constexpr int kSteps = 8, kTries = 12;
  double& strength = *std::find_if(pair.p.begin(), pair.p.end(), [](double p) { return p != 0; });
  const double given = strength;
  double best = given;
  int most = -1;
  for (int step = 0; step <= kSteps; ++step) {
    strength = given * std::pow(0.5, 0.5 * step);
    const int count = static_cast<int>(OpenOnes(pair, kTries).size());
    if (count <= most) continue;
    most = count;
    best = strength;
  }
  strength = best;
  return pair;
}

// The probabilities predicted by a plan, and the results once the further readings are simulated.
Outcome Try(const Pair& pair, int number) {
  RandomStream random(17, number);
  const Synthetic made = Make(pair, &random);
  const std::vector<PlanCandidate> candidates = FitPair(pair, made);
  Outcome outcome;
  for (const FollowUp& follow_up : FollowUpMeasurements(*made.weighted.readings)) {
    outcome.foreseen[follow_up.id] =
        Foresee(made.weighted, 1, follow_up, candidates, number).front().probability;
    std::vector<double> unknown;
    for (std::size_t k = 0; k < follow_up.unknown.size(); ++k) unknown.push_back(random.Normal());
    auto joint = TakeFurther(made.weighted, 1, follow_up, made.truth, unknown);
    if (!joint) continue;
    Disturb(&random, &*joint);
    const FurtherEnd own = FitJoint(*joint, candidates[0].fit.law, candidates[0].starts);
    const FurtherEnd other = FitJoint(*joint, candidates[1].fit.law, candidates[1].starts);
    outcome.right[follow_up.id] =
        own.usable &&
        (!other.usable || own.sum + candidates[0].charge < other.sum + candidates[1].charge);
  }
  return outcome;
}

// Mean predicted probability against the fraction of correctly named causes, over measurements with
// independent noise.
TEST(PlanRateTest, ForeseesHowOftenTheRightNameComesOut) {
  int rows = 0, within = 0;
  double off = 0;
  std::printf("%-15s %-15s %-14s %4s %9s %9s %6s\n", "true", "or else", "measurement", "n",
              "foreseen%", "right%", "error");
  const int asked = RepeatsAsked(), repeats = asked > 0 ? asked : kFewRepeats;
  std::vector<Pair> pairs = Pairs();
  if (asked == 0) pairs.resize(kFewPairs);
  for (const Pair& given : pairs) {
    const Pair pair = asked > 0 ? Settled(given) : given;
    const std::vector<int> open = OpenOnes(pair, 5 * repeats / 2);
    std::vector<Outcome> outcomes(std::min<std::size_t>(open.size(), repeats));
    ParallelFor(static_cast<int>(outcomes.size()), 0,
                [&](int k) { outcomes[k] = Try(pair, open[k]); });
    std::map<std::string, std::vector<double>> foreseen;
    std::map<std::string, int> right;
    for (const Outcome& outcome : outcomes) {
      for (const auto& [id, is_right] : outcome.right) {
        foreseen[id].push_back(outcome.foreseen.at(id));
        right[id] += is_right ? 1 : 0;
      }
    }
    std::fflush(stdout);
    for (const auto& [id, all] : foreseen) {
      const double n = static_cast<double>(all.size());
      double mean = 0, variance = 0;
      for (const double p : all) {
        mean += p / n;
        variance += p * (1 - p) / (n * n);
      }
      const double share = right[id] / n;
      const double error = std::sqrt(variance + 0.25 / (n * n));
      std::printf("%-15s %-15s %-14s %4.0f %9.1f %9.1f %6.1f%s\n", pair.truth, pair.other,
                  id.c_str(), n, 100 * mean, 100 * share, 100 * error,
                  std::fabs(mean - share) > 2 * error ? " *" : "");
      ++rows;
      within += std::fabs(mean - share) <= 2 * error ? 1 : 0;
      off += std::fabs(mean - share);
    }
  }
  std::printf("%d of %d within 2 standard errors; mean difference %.1f %%\n", within, rows,
              100 * off / rows);
  EXPECT_GE(rows, asked > 0 ? 50 : 5);
  EXPECT_GE(within, 0.85 * rows);
  EXPECT_LT(off / rows, asked > 0 ? 0.06 : 0.2);
}

}  // namespace
}  // namespace lyrefit
