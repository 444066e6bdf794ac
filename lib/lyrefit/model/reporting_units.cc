#include "lyrefit/model/reporting_units.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/roots.h"

namespace lyrefit {

double EffectParameter::ReportedFactor(const double* p, const ReadingScale& scale) const {
  double result = factor * std::pow(scale.current_A, current) * std::pow(scale.cells, cells) *
                  std::pow(scale.rate_V_per_s, rate);
  if (convert != nullptr) result *= convert(p, scale);
  return result;
}

double InternalValue(const Effect& effect, int k, double value, std::vector<double> p,
                     const ReadingScale& scale) {
  const EffectParameter& info = effect.parameters[k];
  const auto reported = [&](double x) {
    p[k] = x;
    return x * info.ReportedFactor(p.data(), scale);
  };
  if (info.convert == nullptr) return value / info.ReportedFactor(p.data(), scale);
  // If the factor does not depend on the parameter itself, one division gives the value. Otherwise
  // a root does, since the reported value is monotone.
  const double middle = 0.5 * (info.lower + info.upper);
  const double straight = value / (reported(middle) / middle);
  if (std::fabs(reported(straight) - value) <= 1e-12 * std::fabs(value)) return straight;
  return RootBetween([&](double x) { return reported(x) - value; }, info.lower, info.upper);
}

// The factor of a parameter may depend on parameters after it, so the last one is converted first.
std::vector<double> InternalValues(const Effect& effect, const std::vector<double>& reported,
                                   const ReadingScale& scale) {
  std::vector<double> p;
  for (const EffectParameter& info : effect.parameters) p.push_back(info.neutral);
  for (int k = effect.size() - 1; k >= 0; --k)
    p[k] = InternalValue(effect, k, reported[k], p, scale);
  return p;
}

std::vector<double> ReportedValues(const Effect& effect, const double* p,
                                   const ReadingScale& scale) {
  std::vector<double> reported;
  reported.reserve(effect.size());
  for (int k = 0; k < effect.size(); ++k) {
    reported.push_back(p[k] * effect.parameters[k].ReportedFactor(p, scale));
  }
  return reported;
}

std::vector<ParameterRange> ReportedRanges(const Effect& effect, const ReadingScale& scale,
                                           const double* lower, const double* upper) {
  const int size = effect.size();
  std::vector<ParameterRange> ranges(size, {HUGE_VAL, -HUGE_VAL});
  std::vector<double> p(size);
  for (int corner = 0; corner < 1 << size; ++corner) {
    for (int k = 0; k < size; ++k) p[k] = (corner >> k & 1) != 0 ? upper[k] : lower[k];
    const std::vector<double> reported = ReportedValues(effect, p.data(), scale);
    for (int k = 0; k < size; ++k) {
      ranges[k].low = std::min(ranges[k].low, reported[k]);
      ranges[k].high = std::max(ranges[k].high, reported[k]);
    }
  }
  return ranges;
}

Eigen::MatrixXd InternalByReported(const Effect& effect, const ReadingScale& scale,
                                   const double* p) {
  constexpr double kStep = 1e-6;  // of a parameter's range
  const int size = effect.size();
  Eigen::MatrixXd slopes(size, size);
  for (int k = 0; k < size; ++k) {
    const double step = kStep * (effect.parameters[k].upper - effect.parameters[k].lower);
    std::vector<double> above(p, p + size), below = above;
    above[k] += step;
    below[k] -= step;
    above = ReportedValues(effect, above.data(), scale);
    below = ReportedValues(effect, below.data(), scale);
    for (int j = 0; j < size; ++j) slopes(j, k) = (above[j] - below[j]) / (2 * step);
  }
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(size, size);
  return LeastSquares(slopes, one);
}

EffectSpan SpanOf(const Device& device) {
  if (device.effects == nullptr) return {};
  return {device.effects.get(), device.effects->law.base_size()};
}

std::vector<double> Reported(const EffectSpan& span, std::vector<double> p) {
  if (span.effects == nullptr || p.empty()) return p;
  int first = span.first;
  for (const EffectUse& use : span.effects->uses) {
    const std::vector<double> values =
        ReportedValues(*use.effect, p.data() + first, span.effects->readings.scale);
    std::copy(values.begin(), values.end(), p.begin() + first);
    first += use.effect->size();
  }
  return p;
}

std::vector<double> Internal(const EffectSpan& span, std::vector<double> reported) {
  if (span.effects == nullptr || reported.empty()) return reported;
  auto first = reported.begin() + span.first;
  for (const EffectUse& use : span.effects->uses) {
    const std::vector<double> own(first, first + use.effect->size());
    const std::vector<double> values =
        InternalValues(*use.effect, own, span.effects->readings.scale);
    first = std::copy(values.begin(), values.end(), first);
  }
  return reported;
}

std::vector<double> Reported(const Device& device, std::vector<double> p) {
  return Reported(SpanOf(device), std::move(p));
}

std::vector<double> Internal(const Device& device, std::vector<double> reported) {
  return Internal(SpanOf(device), std::move(reported));
}

ParameterBounds ReportedBounds(const EffectSpan& span, const ParameterBounds& own,
                               std::vector<double> p, int i) {
  if (!span.Has(i)) return own;
  const auto reported = [&](double value) {
    p[i] = value;
    return Reported(span, p)[i];
  };
  const std::pair<double, double> ends = std::minmax({reported(own.lower), reported(own.upper)});
  const auto& [lower, upper] = ends;
  return {lower, upper, lower, upper, own.scale, own.whole};
}

}  // namespace lyrefit
