#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/priors.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/selection_state.h"

namespace lyrefit {
namespace {

// Puts the best hypothesis in the place of cause number `c`. False if the cause itself is the best.
bool SwapOne(int c, SelectionState* now) {
  const LawFit present = now->fit;
  const std::vector<ChosenCause> chosen = now->causes;
  const auto keep = [&] {
    now->fit = present;
    now->causes = chosen;
    return false;
  };
  now->fit = FitWithout(now->weighted, present, c);
  now->causes.erase(now->causes.begin() + c);
  if (!now->fit.usable) return keep();
  const JudgeOptions& judge = now->options.judge;
  const double kept = EvidenceOf(now->weighted, now->base, judge, present).complete +
                      LogPriorOdds(*chosen[c].effect, judge);
  const Hypotheses place = FitCandidates(*now, ScoreOpen(now));
  if (now->weighted.progress.Stopped()) return keep();
  const double none = place.none.LogComplete();
  const auto best = MostProbable(place.candidates);
  const bool replaced = best != place.candidates.end() && best->score.effect != chosen[c].effect &&
                        best->LogComplete() > std::max(kept, none) + kClearly;
  if (!replaced && none < kept) return keep();
  if (replaced) {
    now->fit = best->fit;
    now->causes.push_back({best->score.effect, best->score});
  }
  SettleNoise(now);
  return true;
}

}  // namespace

void SwapCauses(SelectionState* now) {
  if (now->options.repeats) return;
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (int c = 0; c + 1 < static_cast<int>(now->causes.size()); ++c) {
      if (now->causes[c].in_values) continue;
      if (now->weighted.progress.Stopped()) return;
      changed = SwapOne(c, now) || changed;
    }
    if (!changed) return;
  }
}

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

namespace {

// Standard deviation of the rounding errors of each reading, for grids much coarser than the noise:
// neighbours share such errors. Empty if there is no coarse grid.
std::vector<double> CoarseRounding(const Measurement& measurement, const Noise& noise) {
  const ValueFindings& values = measurement.values;
  std::vector<double> rounding;
  const auto add = [&](const std::vector<double>& by, double shared) {
    rounding.resize(by.size(), 0.0);
    for (std::size_t k = 0; k < by.size(); ++k) {
      rounding[k] = std::hypot(rounding[k], std::sqrt(shared) * by[k]);
    }
  };
  if (IsCoarse(measurement, noise)) add(values.rounding, 1);
  if (HasCoarseBins(measurement, noise)) add(values.bin_rounding, values.bins_shared);
  return rounding;
}

// Root mean square of a fit's residuals, without the part that rounding explains.
double Misfit(const WeightedData& weighted, const std::vector<double>& residual,
              const std::vector<double>& rounding) {
  constexpr double kReach = 2;
  double sum = 0;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    const double by_rounding = rounding.empty() ? 0 : kReach * rounding[k];
    const double beyond = residual[k] * residual[k] - by_rounding * by_rounding;
    if (weighted.used[k] != 0) sum += std::max(beyond, 0.0);
  }
  return std::sqrt(sum / std::max(weighted.count(), 1));
}

// With a large misfit, steps that a fit does not follow would count as noise where readings are
// few. All sigmas are then set to one value.
void LevelNoise(WeightedData* weighted, double misfit) {
  constexpr double kRuined = 0.01, kByFar = 3, kUsual = 1.5e-3;
  const double middle = UpperMedian(weighted->sigma);
  if (misfit < kRuined || misfit < kByFar * middle) return;
  weighted->sigma.assign(weighted->sigma.size(), std::max(kUsual, std::min(middle, 0.3 * misfit)));
}

void Widen(const std::vector<double>& rounding, WeightedData* weighted) {
  if (rounding.empty()) return;
  weighted->least_variance = 1;
  for (std::size_t k = 0; k < rounding.size(); ++k) {
    weighted->sigma[k] = std::hypot(weighted->sigma[k], rounding[k]);
  }
}

// Uses the sigma that the file states for each current.
void TakeStatedSigma(const Measurement& measurement, WeightedData* weighted) {
  for (std::size_t k = 0; k < weighted->sigma.size(); ++k) {
    weighted->sigma[k] = std::max(measurement.stated_sigma[k], kSmallestNoise);
  }
}

// Uses error sizes from the options. Errors of the voltage enter by the slope of the fitted curve.
void TakeStated(const Measurement& measurement, const LawFit& fit, WeightedData* weighted) {
  const ErrorSizes& sizes = measurement.errors.sizes;
  const std::vector<Reading>& points = measurement.readings.points;
  const ReadingScale& scale = measurement.readings.scale;
  const double voltage = sizes.voltage_V / scale.cells / measurement.readings.pivot_voltage;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t a = k > 0 ? k - 1 : k, b = k + 1 < points.size() ? k + 1 : k;
    const double span = points[b].voltage - points[a].voltage;
    const double slope = span != 0 ? (fit.current[b] - fit.current[a]) / span : 0;
    weighted->sigma[k] =
        std::max(std::hypot(sizes.current_A / scale.current_A, voltage * points[k].voltage * slope),
                 kSmallestNoise);
  }
  weighted->path = sizes.path;
  weighted->path_length = sizes.length;
}

}  // namespace

Noise TakeNoise(const Measurement& measurement, const LawFit& fit, WeightedData* weighted) {
  const Readings& readings = measurement.readings;
  std::vector<double> residual(readings.points.size());
  for (std::size_t k = 0; k < residual.size(); ++k) {
    residual[k] = fit.current[k] - readings.points[k].current;
  }
  Noise noise = EstimateNoise(measurement, residual, weighted->used);
  weighted->sigma = noise.sigma;
  const std::vector<double> rounding = CoarseRounding(measurement, noise);
  const bool exact = *std::max_element(noise.sigma.begin(), noise.sigma.end()) <
                     10 * kSmallestNoise;  // simulated readings: arithmetic rounding only
  if (exact) weighted->least_variance = 1;
  const bool stated = measurement.errors.kind == ErrorKind::kStated;
  if (measurement.has_path()) {
    weighted->least_variance = 1;
    if (stated) {
      TakeStated(measurement, fit, weighted);
    } else if (measurement.stated_sigma.empty()) {
      LevelNoise(weighted, Misfit(*weighted, residual, rounding));
    } else {
      TakeStatedSigma(measurement, weighted);
    }
  }
  if (!stated) Widen(rounding, weighted);
  for (std::size_t k = 0; k < weighted->sigma.size(); ++k)
    weighted->sigma[k] = std::hypot(weighted->sigma[k], TraceError(readings.points, k));
  return noise;
}

SettledFit SettleNoise(const Measurement& measurement, WeightedData weighted, LawFit fit) {
  const bool stated = measurement.errors.kind == ErrorKind::kStated;
  Noise noise;
  for (int round = 0; round < 2; ++round) {
    noise = TakeNoise(measurement, fit, &weighted);
    if (measurement.has_path() && !stated) weighted.path = FindPath(weighted, fit);
    LawFit again = FitLaw(weighted, fit.law, fit.p);
    if (again.usable) fit = std::move(again);
  }
  return {std::move(weighted), std::move(fit), std::move(noise)};
}

}  // namespace lyrefit
