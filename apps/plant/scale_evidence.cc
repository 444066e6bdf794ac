#include "plant/scale_evidence.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/base/distributions.h"

namespace lyrefit {
namespace {

constexpr double kMostHealthy =
    0.05;  // probability of a healthy string in spite of which it is claimed
constexpr double kAlternativePart = 0.05;  // of the probability of the first cause
// Errors of the computed effects, in parts of them.
constexpr double kShiftError = 0.05;
constexpr double kLeastUnlikeType = 0.05;  // of Isc and Voc of another type, in parts of them

// Logarithm of the density of the deviation under a hypothesis, without constants.
double LogDensity(const ScaleVector& deviation, const ScaleErrors& errors,
                  const ScaleHypothesis& one) {
  // Without a slope a step of the curve has the fill factor of a resistance.
  const bool no_slope = !std::isfinite(deviation[kScaleSlope]);
  if (one.cause == ScaleCause::kCableResistance && no_slope) return -kInfinity;
  double squares = 0, logs = 0;
  int known = 0;
  for (int q = 0; q < kScaleQuantities; ++q) {
    if (!std::isfinite(deviation[q]) || !std::isfinite(one.shift[q])) continue;
    const double error = std::hypot(errors.sizes[q], kShiftError * one.shift[q]);
    const double size = std::hypot(error, one.width[q]);
    squares += std::pow((deviation[q] - one.shift[q]) / size, 2);
    logs += std::log(size);
    ++known;
  }
  const double density =
      -(errors.degrees + known) / 2 * std::log1p(squares / errors.degrees) - logs;
  if (one.cause != ScaleCause::kWrongModuleType) return density;
  // No other type has the same Isc and Voc.
  const double apart = std::hypot(deviation[kScaleIsc], deviation[kScaleVoc]) / kLeastUnlikeType;
  return density + std::log(-std::expm1(-apart * apart / 2));
}

}  // namespace

double HealthyPValue(const ScaleVector& deviation, const ScaleErrors& errors) {
  double squares = 0, largest = 0;
  int known = 0;
  for (int q = 0; q < kScaleQuantities; ++q) {
    const double ratio = deviation[q] / errors.sizes[q];
    if (!std::isfinite(ratio)) continue;
    squares += ratio * ratio;
    largest = std::max(largest, ratio * ratio);
    ++known;
  }
  if (known == 0) return 1;
  const double together = FisherTail(squares / known, known, errors.degrees);
  const double alone = known * FisherTail(largest, 1, errors.degrees);
  return std::min(1.0, 2 * std::min(together, alone));
}

ScaleVerdict JudgeScale(const ScaleVector& deviation, const ScaleErrors& errors,
                        const std::vector<ScaleHypothesis>& hypotheses, double level) {
  ScaleVerdict verdict;
  verdict.p_value = HealthyPValue(deviation, errors);
  if (!(verdict.p_value < level)) return verdict;
  std::vector<double> logs;
  logs.reserve(hypotheses.size());
  for (const ScaleHypothesis& one : hypotheses) {
    logs.push_back(std::log(one.prior) + LogDensity(deviation, errors, one));
  }
  const double most = *std::max_element(logs.begin(), logs.end());
  std::map<ScaleCause, double> weights;
  double sum = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double weight = std::exp(logs[i] - most);
    weights[hypotheses[i].cause] += weight;
    sum += weight;
  }
  if (weights[ScaleCause::kNone] > kMostHealthy * sum) return verdict;
  std::vector<std::pair<double, ScaleCause>> order;
  for (const auto& [cause, weight] : weights) {
    if (cause != ScaleCause::kNone) order.emplace_back(-weight, cause);
  }
  std::sort(order.begin(), order.end());
  verdict.cause = order.front().second;
  verdict.probability = -order.front().first / sum;
  if (verdict.cause == ScaleCause::kSomethingElse) return verdict;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const bool named = order[i].second != ScaleCause::kSomethingElse;
    if (named && order[i].first < kAlternativePart * order.front().first) {
      verdict.alternatives.push_back(order[i].second);
    }
  }
  double own = 0;
  std::size_t best = 0;
  double highest = -kInfinity;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const ScaleHypothesis& one = hypotheses[i];
    if (one.cause != verdict.cause) continue;
    const double weight = std::exp(logs[i] - most);
    own += weight;
    verdict.mean.size += weight * one.size;
    for (int q = 0; q < kScaleQuantities; ++q) verdict.mean.shift[q] += weight * one.shift[q];
    if (logs[i] > highest) highest = logs[i], best = i;
  }
  verdict.mean.cause = verdict.cause;
  verdict.mean.size /= own;
  for (double& shift : verdict.mean.shift) shift /= own;
  verdict.mean.count = hypotheses[best].count;
  verdict.mean.of = hypotheses[best].of;
  return verdict;
}

}  // namespace lyrefit
