#include "lyrefit/diagnose/wrong_readings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/diagnose/priors.h"

namespace lyrefit {
namespace {

constexpr double kPlausible = 3.5;  // noise deviations

// Distance of the fit from a reading, in noise deviations.
double Off(const WeightedData& weighted, const LawFit& fit, int reading) {
  return (fit.current[reading] - weighted.readings->points[reading].current) /
         weighted.sigma[reading];
}

// Whether a reading is far off while its two neighbours are not.
bool IsAlone(const WeightedData& weighted, const LawFit& fit, int reading) {
  constexpr double kShared = 0.35;
  const std::vector<Reading>& points = weighted.readings->points;
  int neighbours = 0;
  for (const int k : {reading - 1, reading + 1}) {
    const bool there = k >= 0 && k < static_cast<int>(points.size());
    if (!there || points[k].segment != points[reading].segment) continue;
    if (weighted.used[k] == 0) continue;
    if (Off(weighted, fit, k) / Off(weighted, fit, reading) > kShared) return false;
    ++neighbours;
  }
  return neighbours == 2;
}

// Whether in a sweep up and down a neighbour is off alike: the device settles, or its state changes.
bool Settles(const WeightedData& weighted, const LawFit& fit, int reading) {
  constexpr double kShared = 0.35;
  const std::vector<Reading>& points = weighted.readings->points;
  if (weighted.readings->traits.turns.empty()) return false;
  for (const int k : {reading - 1, reading + 1}) {
    const bool there = k >= 0 && k < static_cast<int>(points.size());
    if (!there || points[k].segment != points[reading].segment || weighted.used[k] == 0) continue;
    if (Off(weighted, fit, k) / Off(weighted, fit, reading) > kShared) return true;
  }
  return false;
}

// Whether a reading at an end of its stretch agrees with the law at zero sweep rate. At the start,
// turn or end of a sweep, the rate computed from neighbours is wrong. An effect that depends on the
// rate then misses such a reading, although the reading is correct.
bool StandsStill(const WeightedData& weighted, const LawFit& fit, int reading) {
  const std::vector<Reading>& points = weighted.readings->points;
  const int last = static_cast<int>(points.size()) - 1;
  const auto apart = [&](int k) {
    return k < 0 || k > last || points[k].segment != points[reading].segment;
  };
  if (!apart(reading - 1) && !apart(reading + 1)) return false;
  Readings alone = *weighted.readings;
  alone.points = {points[reading]};
  alone.points[0].rate = 0;
  double current = 0;
  LawWorkspace workspace;
  return EvaluateLaw(fit.law, alone, fit.p.data(), &workspace, &current, nullptr) &&
         std::fabs(current - points[reading].current) < kPlausible * weighted.sigma[reading];
}

// ln of the posterior odds that the furthest reading is wrong, against no cause: its statistic, less
// what it takes to select it among all readings and its size among all sizes.
double LogOdds(const WeightedData& weighted, const LawFit& fit, const Score& furthest) {
  constexpr double kRange = 1;  // of a wrong reading, in scales
  const double degrees = Degrees(weighted, fit.law);
  return 0.5 * degrees * std::log1p(furthest.statistic / degrees) - std::log(weighted.count()) +
         std::log(std::sqrt(2 * M_PI) * weighted.sigma[furthest.outlier] / kRange) +
         std::log(kWrongReadingPrior);
}

}  // namespace

std::optional<LeftOut> FindFurthest(const WeightedData& weighted, const LawFit& fit,
                                    const std::vector<Score>& scores, const Hypotheses& step,
                                    std::size_t wrong) {
  const Score* furthest = FindScore(scores, FoundBy::kSingleReading);
  if (furthest == nullptr || !furthest->testable || furthest->outlier < 0) return std::nullopt;
  const int reading = furthest->outlier;
  const double odds = LogOdds(weighted, fit, *furthest);
  if (!(odds > 0) || Settles(weighted, fit, reading)) return std::nullopt;
  const double most = std::max(1.0, kMostWrong * static_cast<double>(weighted.used.size()));
  if (static_cast<double>(wrong) >= most) return std::nullopt;
  if (!step.candidates.empty()) {
    const FittedCandidate& best = *MostProbable(step.candidates);
    const bool beaten = step.none.LogComplete() + odds < best.LogComplete();
    const bool alone = best.score.effect->momentary && IsAlone(weighted, fit, reading);
    if (beaten && !alone) return std::nullopt;
  } else if (!fit.law.effects.empty() && !IsAlone(weighted, fit, reading)) {
    return std::nullopt;  // the causes may miss it in part
  }
  WeightedData without = weighted;
  without.used[reading] = 0;
  LawFit rest = FitLaw(without, fit.law, fit.p);
  if (!rest.usable || weighted.progress.Stopped()) return std::nullopt;
  const bool at_rest = StandsStill(without, rest, reading);
  return LeftOut{reading, at_rest, std::move(rest)};
}

bool Explains(const WeightedData& weighted, const LawFit& fit, int reading) {
  return std::fabs(Off(weighted, fit, reading)) < kPlausible;
}

}  // namespace lyrefit
