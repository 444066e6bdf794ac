#include "lyrefit/devices/cell_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/term.h"

namespace lyrefit {
namespace {

constexpr char kShuntOrCollection[] = "shunt or collection";
enum DiodeValue { kPhoto, kSaturation, kN, kSeries, kShunt, kCount };

// Iph, Is, n, Rs and the shunt conductance.
using Values = std::array<double, kCount>;
// Losses by recombination, shunt and series resistance, and the fitted fill factor.
using Parts = std::array<double, 4>;

KeyPoints PointsOf(Values p, double thermal_V) {
  Device device = MakeDevice(Model::kSingleDiode, {});
  device.module_thermal_voltage_V = thermal_V;
  p[kShunt] = 1 / p[kShunt];
  return ModelKeyPoints(device, p.data());
}

// The curve of the parameters by its ends.
DiodeThroughEnds EndsOf(const Values& p, double thermal_V) {
  const KeyPoints points = PointsOf(p, thermal_V);
  return {points.short_circuit_current_A, points.open_circuit_voltage_V, p[kN] * thermal_V,
          p[kSeries], p[kShunt]};
}

Parts PartsOf(const Values& p, double thermal_V) {
  const DiodeThroughEnds fit = EndsOf(p, thermal_V);
  DiodeThroughEnds diode = {fit.isc_A, fit.voc_V, thermal_V};
  const double ideal = FillFactorOf(diode);
  diode.nNsVth = fit.nNsVth;
  const double with_n = FillFactorOf(diode);
  diode.shunt_S = fit.shunt_S;
  const double with_shunt = FillFactorOf(diode);
  const double fitted = FillFactorOf(fit);
  return {ideal - with_n, with_n - with_shunt, with_shunt - fitted, fitted};
}

Values ValuesOf(const FitReport& fit) {
  Values p{};
  for (int i = 0; i < kCount; ++i) p[i] = fit.refined[i];
  p[kShunt] = 1 / p[kShunt];
  return p;
}

// Standard errors of the parts.
Parts ErrorsOf(const FitReport& fit, const Values& p, double thermal_V) {
  // d(Iph, Is, n, Rs, 1/Rsh) / d(reported parameters) is diagonal.
  const Values slope = {1, 1, 1, 1, -p[kShunt] * p[kShunt]};
  constexpr double kStep = 1e-4;  // in standard errors
  std::array<Parts, kCount> gradient{};
  const auto& covariance = fit.covariance.values;
  for (int i = 0; i < kCount; ++i) {
    const double error = std::sqrt(covariance[i][i]) * std::fabs(slope[i]);
    if (!(error > 0)) continue;
    // A saturation current may have an error larger than itself.
    const double step = std::min(kStep * error, 1e-3 * std::fabs(p[i]));
    Values above = p, below = p;
    above[i] += step;
    below[i] -= step;
    const Parts high = PartsOf(above, thermal_V), low = PartsOf(below, thermal_V);
    for (std::size_t k = 0; k < high.size(); ++k) gradient[i][k] = (high[k] - low[k]) / (2 * step);
  }
  Parts errors{};
  for (std::size_t k = 0; k < errors.size(); ++k) {
    double variance = 0;
    for (int i = 0; i < kCount; ++i) {
      for (int j = 0; j < kCount; ++j) {
        if (!std::isfinite(covariance[i][j])) continue;
        variance += gradient[i][k] * slope[i] * covariance[i][j] * slope[j] * gradient[j][k];
      }
    }
    errors[k] = std::sqrt(std::max(variance, 0.0));
  }
  return errors;
}

// Losses at the other ends of the intervals of n and the resistances that sit at their bounds;
// otherwise the losses of the fit.
Parts PartsAtOtherEnds(const CellSweep& lit, const Values& p, double thermal_V) {
  Values other = p;
  for (const Estimate& e : lit.fit->estimates) {
    const Ranged range = FittedValue(lit, e.info.symbol);
    if (e.info.symbol == "n1" && e.at_bound == BoundSide::kLower && range.high_95 > p[kN]) {
      other[kN] = range.high_95;
    }
    if (e.info.symbol == "Rs" && e.at_bound == BoundSide::kLower && range.high_95 > 0) {
      other[kSeries] = range.high_95;
    }
    if (e.info.symbol == "Rsh" && e.at_bound == BoundSide::kUpper && range.low_95 > 0) {
      other[kShunt] = 1 / range.low_95;
    }
  }
  return PartsOf(other, thermal_V);
}

void SetIntervals(const CellSweep& lit, const Values& p, double thermal_V,
                  FillFactorLosses* losses) {
  const FitReport& fit = *lit.fit;
  if (!fit.covariance.known()) return;
  const Parts own = PartsOf(p, thermal_V), errors = ErrorsOf(fit, p, thermal_V);
  const Parts other = PartsAtOtherEnds(lit, p, thermal_V);
  for (std::size_t k = 0; k < losses->parts.size(); ++k) {
    Ranged& loss = losses->parts[k].loss;
    const double reach = fit.covariance.t_95 * errors[k];
    const double extra = k < 3 ? std::max(0.0, other[k] - own[k]) : 0;
    loss.low_95 = loss.value - reach;
    loss.high_95 = loss.value + std::hypot(reach, extra);
    if (k == 1 || k == 2) loss.low_95 = std::max(loss.low_95, 0.0);
  }
}

std::string WhyNone(const CellSweep& lit) {
  if (!lit.fit) return lit.no_fit_because.empty() ? "no fit was requested" : lit.no_fit_because;
  return lit.diode() ? "" : "n and Rs of the fit are void, see the warnings";
}

}  // namespace

double FillFactorOf(const DiodeThroughEnds& diode) {
  const double a = diode.nNsVth, rs = diode.series_ohm, g = diode.shunt_S;
  const double isc = diode.isc_A, voc = diode.voc_V;
  // The current at both ends is linear in Iph and Is.
  const auto per_ampere = [&](double v) { return DiodeCurrent(1.0, 1 / a, v); };
  const double saturation =
      (isc * (1 + rs * g) - voc * g) / (per_ampere(isc * rs) - per_ampere(voc));
  // Beyond the largest exponent the model's diode is cut off: no device has that many volts a cell.
  if (!(saturation > 0) || voc / a > kLargestExponent) return kUnknown;
  return PointsOf({voc * g - saturation * per_ampere(voc), saturation, 1, rs, g}, a).fill_factor;
}

FillFactorLosses FindFillFactorLosses(const CellSweep& lit) {
  FillFactorLosses losses;
  losses.measured = lit.key.fill_factor;
  losses.missing = WhyNone(lit);
  if (!losses.missing.empty()) return losses;
  const FitReport& fit = *lit.fit;
  const Values p = ValuesOf(fit);
  const double thermal_V = fit.nNsVth / p[kN];
  const Parts parts = PartsOf(p, thermal_V);
  losses.fitted = parts[3];
  losses.without_series = losses.fitted + parts[2];
  losses.without_resistances = losses.without_series + parts[1];
  losses.ideal = losses.without_resistances + parts[0];
  const double voc = EndsOf(p, thermal_V).voc_V;
  losses.green_n1 = GreenFillFactor(voc, thermal_V);
  losses.green_fitted = GreenFillFactor(voc, fit.nNsVth);
  losses.parts = {{fmt::format("recombination: n from 1 to {:.4g}", p[kN]), {parts[0]}},
                  {kShuntOrCollection, {parts[1]}},
                  {"series resistance", {parts[2]}},
                  {"rest: fit minus measured", {losses.fitted - losses.measured}}};
  SetIntervals(lit, p, thermal_V, &losses);
  return losses;
}

void NameShuntLosses(const JointEstimate& joint, std::vector<FillFactorLosses>* all) {
  constexpr double kAlmostAll = 0.9;
  const double part = joint.collection_part;
  if (!joint.void_because.empty() || std::isnan(part)) return;
  std::string name = part > kAlmostAll       ? "collection that depends on voltage"
                     : part < 1 - kAlmostAll ? "shunt"
                                             : "collection and shunt";
  if (part > 0 && part < 1) name += fmt::format(": {:.0f} % goes with the light", 100 * part);
  for (FillFactorLosses& losses : *all) {
    for (FillFactorPart& loss : losses.parts) {
      if (loss.name == kShuntOrCollection) loss.name = name;
    }
  }
}

}  // namespace lyrefit
