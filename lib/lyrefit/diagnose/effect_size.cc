#include "lyrefit/diagnose/effect_size.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/distributions.h"
#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit {
namespace {

// The device terms of a fit: base and device effects. `of`: position of each parameter in the fit, -1
// of one that is not the fit's.
struct DeviceTerms {
  Law law;
  std::vector<double> p;
  std::vector<int> of;
};

// `keep`: whether an effect of the device, by its number, is among the terms.
template <class Keep>
DeviceTerms DeviceTermsOf(const LawFit& fit, Keep keep) {
  DeviceTerms terms;
  terms.law = fit.law;
  terms.law.effects.clear();
  const auto take = [&](int first, int size) {
    for (int k = first; k < first + size; ++k) {
      terms.p.push_back(fit.p[k]);
      terms.of.push_back(k);
    }
  };
  take(0, fit.law.base_size());
  for (int e = 0; e < static_cast<int>(fit.law.effects.size()); ++e) {
    if (fit.law.effects[e]->where != Where::kDevice || !keep(e)) continue;
    terms.law.effects.push_back(fit.law.effects[e]);
    take(fit.law.Offset(e), fit.law.effects[e]->size());
  }
  return terms;
}

DeviceTerms DeviceTermsOf(const LawFit& fit) {
  return DeviceTermsOf(fit, [](int) { return true; });
}

// In current scales and V per cell.
struct PowerPoint {
  double voltage = kUnknown;
  double power = kUnknown;
};

// Voltages per cell and currents in scales of a curve; empty if the law cannot be evaluated.
struct CurveOfLaw {
  std::vector<double> voltage, current;
};

// Up to voltages that end beyond open circuit, which without a cause may lie far beyond the
// readings.
CurveOfLaw CurveOf(const Readings& bare, const DeviceTerms& terms) {
  constexpr int kPoints = 400, kMostTimes = 6;
  CurveOfLaw curve;
  curve.current.assign(kPoints + 1, 1);
  double top = 1.1 * bare.pivot_voltage;
  for (int times = 0; times < kMostTimes && curve.current.back() > 0; ++times, top *= 1.5) {
    Readings grid = bare;
    grid.points.resize(kPoints + 1, bare.points.front());
    for (int k = 0; k <= kPoints; ++k) grid.points[k].voltage = top * k / kPoints;
    LawWorkspace workspace;
    if (!EvaluateLaw(terms.law, grid, terms.p.data(), &workspace, curve.current.data(), nullptr)) {
      return {};
    }
    curve.voltage.clear();
    for (const Reading& reading : grid.points) curve.voltage.push_back(reading.voltage);
  }
  return curve;
}

PowerPoint FindPowerPoint(const Readings& bare, const DeviceTerms& terms) {
  const auto [voltage, current] = CurveOf(bare, terms);
  if (voltage.empty()) return {};
  const int last = static_cast<int>(voltage.size()) - 1;
  int best = 0;
  const auto power = [&voltage = voltage, &current = current](int k) {
    return voltage[k] * current[k];
  };
  for (int k = 1; k <= last; ++k) best = power(k) > power(best) ? k : best;
  PowerPoint peak = {voltage[best], power(best)};
  if (best > 0 && best < last) {  // vertex of the parabola
    const double a = power(best - 1), b = power(best), c = power(best + 1);
    const double bend = a - 2 * b + c;
    if (bend < 0) {
      peak.power = b - (a - c) * (a - c) / (8 * bend);
      peak.voltage += voltage[1] * (a - c) / (2 * bend);
    }
  }
  return peak;
}

double InWatts(const WeightedData& weighted, const PowerPoint& peak) {
  const ReadingScale& scale = weighted.readings->scale;
  return peak.power * scale.cells * scale.current_A;
}

// Derivative of the maximum power by all coordinates of the fit, in its unit. Empty if the law
// cannot be evaluated.
std::vector<double> SlopesOfPower(const LawFit& fit, Readings bare, const DeviceTerms& terms,
                                  const PowerPoint& peak) {
  if (!(peak.power > 0)) return {};
  // To first order the power at its peak changes as the current at that voltage.
  bare.points.front().voltage = peak.voltage;
  LawWorkspace workspace;
  double current = 0;
  std::vector<double> derivative(terms.p.size());
  const LawCoordinates coordinates(terms.law, bare);
  const std::vector<double> theta = coordinates.Of(terms.p);
  if (!coordinates.Evaluate(theta.data(), &workspace, &current, derivative.data())) return {};
  std::vector<double> by(fit.p.size(), 0.0);
  for (std::size_t k = 0; k < terms.of.size(); ++k) {
    if (terms.of[k] >= 0) by[terms.of[k]] = derivative[k] * peak.power / current;
  }
  return by;
}

// Standard error of a value with this derivative by all coordinates of the fit.
double ErrorBy(const WeightedData& weighted, const LawFit& fit, const std::vector<double>& by) {
  if (by.empty()) return kUnknown;
  return StandardError(Linearize(weighted, fit), by) * std::sqrt(NoiseVariance(weighted, fit));
}

// Relative standard error of the maximum power.
double ErrorOf(const WeightedData& weighted, const LawFit& fit, const Readings& bare,
               const DeviceTerms& terms, const PowerPoint& peak) {
  return ErrorBy(weighted, fit, SlopesOfPower(fit, bare, terms, peak)) / peak.power;
}

// Gain of the device with the `rest` of its terms.
PowerGain GainTo(const WeightedData& weighted, const LawFit& fit, const DeviceTerms& rest) {
  const DeviceTerms terms = DeviceTermsOf(fit);
  const Readings bare = InBrightestLight(*weighted.readings);
  const PowerPoint now = FindPowerPoint(bare, terms), then = FindPowerPoint(bare, rest);
  std::vector<double> by = SlopesOfPower(fit, bare, rest, then);
  const std::vector<double> by_now = SlopesOfPower(fit, bare, terms, now);
  if (by.empty() || by_now.empty()) return {};
  for (std::size_t k = 0; k < by.size(); ++k) by[k] -= by_now[k];
  const double gain = then.power - now.power;
  double error = std::hypot(ErrorBy(weighted, fit, by), weighted.path * then.power);
  if (weighted.path > 0) {
    constexpr int kMostOfAModule = 4;  // substrings
    const bool string = SubstringsOf(weighted.readings->traits) > kMostOfAModule;
    double part = string ? kCausesDifferInStrings : kCausesDiffer;
    for (const Effect* effect : fit.law.effects) part = std::max(part, effect->gain_scatter);
    error = std::hypot(error, std::hypot(kCellsDiffer * then.power, part * gain));
  }
  const PowerPoint half = {0, std::min(kNormal95 * error, then.power)};
  return {InWatts(weighted, {0, gain}), InWatts(weighted, half)};
}

}  // namespace

double DevicePower(const WeightedData& weighted, const LawFit& fit) {
  return InWatts(weighted,
                 FindPowerPoint(InBrightestLight(*weighted.readings), DeviceTermsOf(fit)));
}

PowerAndError DevicePowerAndError(const WeightedData& weighted, const LawFit& fit) {
  const DeviceTerms terms = DeviceTermsOf(fit);
  const Readings bare = InBrightestLight(*weighted.readings);
  const PowerPoint peak = FindPowerPoint(bare, terms);
  return {InWatts(weighted, peak), ErrorOf(weighted, fit, bare, terms, peak)};
}

PowerGain GainWithout(const WeightedData& weighted, const LawFit& fit, int index) {
  return GainTo(weighted, fit, DeviceTermsOf(fit, [index](int e) { return e != index; }));
}

PowerGain GainWithoutEffects(const WeightedData& weighted, const LawFit& fit) {
  return GainTo(weighted, fit, DeviceTermsOf(fit, [](int) { return false; }));
}

KeyPoints DeviceKeyPoints(const WeightedData& weighted, const LawFit& fit) {
  CurveOfLaw curve = CurveOf(InBrightestLight(*weighted.readings), DeviceTermsOf(fit));
  if (curve.voltage.empty()) return {};
  const ReadingScale& scale = weighted.readings->scale;
  for (double& voltage : curve.voltage) voltage *= scale.cells;
  for (double& current : curve.current) current *= scale.current_A;
  return FindKeyPoints(curve.voltage, curve.current);
}

LawFit TakenOut(const LawFit& fit, int index) {
  LawFit rest = fit;
  const int first = fit.law.Offset(index), size = fit.law.effects[index]->size();
  rest.p.erase(rest.p.begin() + first, rest.p.begin() + first + size);
  rest.law.effects.erase(rest.law.effects.begin() + index);
  return rest;
}

LawFit WithoutEffects(const LawFit& fit) {
  LawFit rest = fit;
  rest.p.resize(fit.law.base_size());
  rest.law.effects.clear();
  return rest;
}

Without MakeWithout(const WeightedData& weighted, const LawFit& fit) {
  return {fit, PlainBasis(weighted, fit), DevicePower(weighted, fit)};
}

EffectSize SizeOf(const WeightedData& weighted, const LawFit& with, int index,
                  const Without& without) {
  EffectSize size;
  size.one_sweep = weighted.readings->traits.single;
  size.current = LackOfFit(weighted, without.fit, without.basis, with.current);
  const auto [power, error] = DevicePowerAndError(weighted, with);
  size.power = power / without.power - 1;
  if (with.law.effects[index]->where == Where::kDevice) {
    size.recoverable = DevicePower(weighted, TakenOut(with, index)) / power - 1;
  }
  const double statistic = (without.fit.sum - with.sum) / NoiseVariance(weighted, with);
  size.reach = statistic > kNormal95 * kNormal95 ? kNormal95 / std::sqrt(statistic) : 1;
  size.power_error =
      std::max(kNormal95 * error, std::fabs(size.power) * size.reach) + kNormal95 * weighted.path;
  return size;
}

double ProbabilityAbove(const EffectSize& size, const Floors& floors) {
  if (!floors.Any()) return 1;
  const auto above = [](double value, double half, double floor) {
    if (!(half > 0)) return value > floor ? 1.0 : 0.0;
    const double below = (floor - value) * kNormal95 / half;
    return std::isnan(below) ? 0.0 : NormalTail(below);
  };
  const double half = size.current * size.reach;
  const double current = above(size.current, half, floors.current);
  double power = above(std::fabs(size.power), size.power_error, floors.power);
  // The power of one sweep counts only where the effect shows as well.
  if (size.one_sweep) power *= above(size.current, half, kShownPart * floors.current);
  return std::max(current, power);
}

bool ExceedsFloors(const EffectSize& size, const Floors& floors) {
  const double current = size.current * (1 - size.reach);
  if (current >= floors.current) return true;
  if (size.one_sweep && current < kShownPart * floors.current) return false;
  // False if the power is NaN.
  return std::fabs(size.power) - size.power_error >= floors.power;
}

}  // namespace lyrefit
