#include "lyrefit/devices/cell_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/roots.h"
#include "lyrefit/devices/line.h"

namespace lyrefit {
namespace {

constexpr double kNearShortCircuit = 10;  // readings up to Voc over this

// Voltage at which `isc_A` (0 in the dark) minus the current is `lost_A`, linear in the logarithm
// of that difference between readings; NaN if there is none.
double VoltageAt(const CellSweep& sweep, double isc_A, double lost_A) {
  for (std::size_t k = 1; k < sweep.voltage_V.size(); ++k) {
    const double below = isc_A - sweep.current_A[k - 1], above = isc_A - sweep.current_A[k];
    if (!(below > 0 && below <= lost_A && above > lost_A)) continue;
    const double part = std::log(lost_A / below) / std::log(above / below);
    return sweep.voltage_V[k - 1] + part * (sweep.voltage_V[k] - sweep.voltage_V[k - 1]);
  }
  return kUnknown;
}

// The reading of the largest power: as good as the power point for a resistance, and measured.
struct PowerReading {
  double voltage_V = kUnknown;
  double current_A = kUnknown;
};

PowerReading PowerReadingOf(const CellSweep& sweep) {
  PowerReading best = {0, 0};
  for (std::size_t k = 0; k < sweep.voltage_V.size(); ++k) {
    const double power = sweep.voltage_V[k] * sweep.current_A[k];
    if (power > best.voltage_V * best.current_A) best = {sweep.voltage_V[k], sweep.current_A[k]};
  }
  return best;
}

// |dI/dV| between the readings around a voltage; 0 outside them.
double SlopeAt(const CellSweep& sweep, double voltage_V) {
  for (std::size_t k = 1; k < sweep.voltage_V.size(); ++k) {
    const double below = sweep.voltage_V[k - 1], above = sweep.voltage_V[k];
    if (voltage_V < below || voltage_V > above) continue;
    return std::fabs((sweep.current_A[k] - sweep.current_A[k - 1]) / (above - below));
  }
  return 0;
}

// Conductance -dI/dV of the readings with |V| <= reach.
struct Conductance {
  double S = 0;
  double error_S = 0;
};

Conductance AtShortCircuit(const CellSweep& sweep, double reach_V) {
  const auto [first, last] = NearZero(sweep.voltage_V, reach_V);
  const Regression fit = Regress(sweep.voltage_V, sweep.current_A, first, last);
  double squares = 0;
  for (std::size_t k = first; k < last; ++k) {
    squares += std::pow(sweep.voltage_V[k] - fit.mean_x, 2);
  }
  if (!(squares > 0)) return {};
  const double by_noise = sweep.noise_A / std::sqrt(squares);
  return {-fit.slope, std::fmax(by_noise, fit.slope_error)};
}

// What a classical method is off by, since it takes the current that a junction loses for
// Isc - I: the current (G1 - G2) Vj - Rs (G1 Isc1 - G2 Isc2) over the conductance Gj of the junction at
// its voltage Vj and over Isc1 - Isc2, with the conductances G at short circuit, Isc2 = 0 in the
// dark. Gj falls with the current that the junction is left with of `lost_A`.
struct MethodError {
  double bias_ohm = 0;
  double error_ohm = 0;  // of the bias
};

MethodError ErrorOfMethod(const Conductance& one, double isc1_A, const Conductance& two,
                          double isc2_A, double junction_V, double junction_S, double ohm,
                          double lost_A) {
  constexpr double kMostPart = 0.9, kOfBias = 0.15;  // of what the linear terms leave out
  const double per = junction_S * (isc1_A - isc2_A);
  const double off = (one.S - two.S) * junction_V - ohm * (one.S * isc1_A - two.S * isc2_A);
  const double part = std::min(kMostPart, off / lost_A);
  const double bias = off / per * (part == 0 ? 1 : -std::log1p(-part) / part);
  const double by_slopes = junction_V * std::hypot(one.error_S, two.error_S) / per;
  return {bias, std::hypot(by_slopes, kOfBias * bias)};
}

// Conductance of the junction behind a slope that the series resistance flattens.
double BehindSeries(double slope_S, double ohm) {
  constexpr double kLeast = 0.05;
  return slope_S / std::max(kLeast, 1 - slope_S * ohm);
}

// The resistance with its interval: the value by the definition and that without the method's bias,
// each with the error of the noise and of the bias. One that lies below 0 by its noise is void:
// `because` says what is in it instead.
SeriesResistance WithErrors(SeriesResistance found, double noise_ohm, const MethodError& method,
                            const char* because) {
  constexpr double kNormal95 = 1.959964;
  const double value = found.ohm.value, unbiased = value - method.bias_ohm;
  const double reach = kNormal95 * std::hypot(noise_ohm, method.error_ohm);
  found.ohm = {value, std::fmin(value, unbiased) - reach, std::fmax(value, unbiased) + reach};
  if (!(value + kNormal95 * noise_ohm < 0)) return found;
  found.ohm = {};
  found.missing = fmt::format("void: {:.3g} ohm, below 0 as no resistance is; {}", value, because);
  return found;
}

}  // namespace

Ranged FittedValue(const CellSweep& sweep, const std::string& symbol) {
  if (!sweep.fit) return {};
  const auto& estimates =
      sweep.fit->under_errors.empty() ? sweep.fit->estimates : sweep.fit->under_errors;
  for (const Estimate& e : estimates) {
    if (e.info.symbol == symbol) return {e.refined, e.low_95, e.high_95};
  }
  return {};
}

SeriesResistance RsFromTwoLights(const CellSweep& brighter, const CellSweep& darker) {
  SeriesResistance found;
  found.method = SeriesMethod::kTwoLights;
  found.of =
      fmt::format("{:.4g} and {:.4g} W/m2", brighter.irradiance_W_m2, darker.irradiance_W_m2);
  found.note =
      "(V2 - V1) / (Isc1 - Isc2) at equal Isc - I, at the brighter curve's reading of most power";
  const double isc1 = brighter.key.short_circuit_current_A;
  const double isc2 = darker.key.short_circuit_current_A;
  const PowerReading at = PowerReadingOf(brighter);
  const double v2 = VoltageAt(darker, isc2, isc1 - at.current_A);
  found.ohm.value = (v2 - at.voltage_V) / (isc1 - isc2);
  if (!std::isfinite(found.ohm.value)) {
    found.missing = "the curve at less light does not reach this current: measure it further";
    return found;
  }
  // Four currents, each with its noise, decide where V2 is read.
  const double noise = std::sqrt(2.0) * std::hypot(brighter.noise_A, darker.noise_A);
  const double ohm = found.ohm.value, slope = SlopeAt(darker, v2);
  const double reach = brighter.key.open_circuit_voltage_V / kNearShortCircuit;
  const MethodError method = ErrorOfMethod(
      AtShortCircuit(brighter, reach), isc1, AtShortCircuit(darker, reach), isc2,
      at.voltage_V + at.current_A * ohm, BehindSeries(slope, ohm), ohm, isc1 - at.current_A);
  return WithErrors(std::move(found), noise / slope / (isc1 - isc2), method,
                    "a light that is not as stated, or a cell that changed between the curves");
}

SeriesResistance RsFromDark(const CellSweep& lit, const CellSweep& dark, const Ranged& dark_rs) {
  SeriesResistance found;
  const double dark_rs_ohm = dark_rs.value;
  const bool own = std::isfinite(dark_rs_ohm);
  found.method = SeriesMethod::kDark;
  found.of = own ? "Rs of the dark fit" : "equal Rs";
  found.note = own ? "(V_dark(Isc - Imp) - Vmp - (Isc - Imp) Rs_dark) / Imp"
                   : "(V_dark(Isc - Imp) - Vmp) / Isc";
  const PowerReading at = PowerReadingOf(lit);
  const double isc = lit.key.short_circuit_current_A, imp = at.current_A;
  const double dark_V = VoltageAt(dark, 0, isc - imp), v = dark_V - at.voltage_V;
  found.ohm.value = own ? (v - (isc - imp) * dark_rs_ohm) / imp : v / isc;
  if (!std::isfinite(found.ohm.value)) {
    found.missing = "the dark curve does not reach the current Isc - Imp: measure it further";
    return found;
  }
  const double noise = std::hypot(std::sqrt(2.0) * lit.noise_A, dark.noise_A);
  const double ohm = found.ohm.value, slope = SlopeAt(dark, dark_V), per = own ? imp : isc;
  const double reach = lit.key.open_circuit_voltage_V / kNearShortCircuit;
  MethodError method = ErrorOfMethod(AtShortCircuit(lit, reach), isc, AtShortCircuit(dark, reach),
                                     0, at.voltage_V + imp * ohm,
                                     BehindSeries(slope, own ? dark_rs_ohm : ohm), ohm, isc - imp);
  method.bias_ohm *= isc / per;
  method.error_ohm *= isc / per;
  const double of_dark = own ? (isc - imp) / imp * (dark_rs.high_95 - dark_rs.low_95) / 4 : 0;
  const double by_dark = std::isfinite(of_dark) ? of_dark : 0;
  return WithErrors(std::move(found), std::hypot(noise / slope / per, by_dark), method,
                    "the dark current in the light is larger: the curves do not superpose");
}

namespace {

// By how much a straight line between two lights is above the parabola through three, in V.
double AboveParabola(const std::vector<VocPoint>& points, double light_A) {
  if (points.size() < 3) return 0;
  std::size_t k = 1;
  while (k + 1 < points.size() && points[k].light_A < light_A) ++k;
  const VocPoint &a = points[k - 1], &b = points[k];
  const VocPoint& c = k + 1 < points.size() ? points[k + 1] : points[k - 2];
  const auto slope = [](const VocPoint& from, const VocPoint& to) {
    return (to.voc_V - from.voc_V) / std::log(to.light_A / from.light_A);
  };
  const double bend = (slope(b, c) - slope(a, b)) / std::log(c.light_A / a.light_A);
  return -bend * std::log(light_A / a.light_A) * std::log(light_A / b.light_A);
}

}  // namespace

SeriesResistance RsFromVoc(const CellSweep& lit, const IdealityOverLight& over) {
  constexpr double kStep = 1e-3;
  SeriesResistance found;
  found.method =
      over.source == SweepKind::kSunsVoc ? SeriesMethod::kSunsVoc : SeriesMethod::kVocOfLights;
  found.note = "(Voc at the light Isc - Imp, minus Vmp) / Imp";
  const PowerReading at = PowerReadingOf(lit);
  const double isc = lit.key.short_circuit_current_A, light = isc - at.current_A;
  const double voc = VocAt(over.points, light), imp = at.current_A;
  found.ohm.value = (voc - at.voltage_V) / imp;
  if (!std::isfinite(found.ohm.value)) {
    found.missing =
        fmt::format("needs a Voc at {:.2g} % of the light of the lit curve", 100 * light / isc);
    return found;
  }
  const double slope = (VocAt(over.points, light * (1 + kStep)) - voc) / (light * kStep);
  if (!(slope > 0)) return found;
  // In place of a second curve: the shunt of the trace, and at its light the same loss of collection.
  const double ohm = found.ohm.value;
  const Ranged& shunt = over.shunt_S;
  const Conductance own = AtShortCircuit(lit, lit.key.open_circuit_voltage_V / kNearShortCircuit);
  const Conductance dark = {shunt.value, (shunt.high_95 - shunt.low_95) / 4};
  MethodError method =
      ErrorOfMethod(own, isc, dark, 0, at.voltage_V + imp * ohm, 1 / slope, ohm, light);
  method.bias_ohm += AboveParabola(over.points, light) / imp;
  // The trace may be of another light or temperature than it says: it misses Voc of the curve.
  const double off_V = lit.key.open_circuit_voltage_V - VocAt(over.points, isc);
  if (std::isfinite(off_V)) method.error_ohm = std::hypot(method.error_ohm, off_V / imp);
  const double noise = std::hypot(slope * std::sqrt(2.0) * lit.noise_A, over.noise_V) / imp;
  return WithErrors(std::move(found), noise, method,
                    "a shunt, collection or an n that changes with the light is in it");
}

SeriesResistance RsFromSlope(const CellSweep& lit) {
  SeriesResistance found;
  found.method = SeriesMethod::kSlope;
  found.note = "-dV/dI at Voc, an upper limit: it contains n k T / (q Isc) of the junction";
  found.ohm.value = lit.resistance_at_voc_ohm;
  if (!std::isfinite(found.ohm.value)) found.missing = "the curve does not pass Voc";
  return found;
}

SeriesResistance RsOfFit(const CellSweep& lit) {
  SeriesResistance found;
  found.method = SeriesMethod::kFit;
  found.of = lit.name;
  found.ohm = FittedValue(lit, "Rs");
  found.note = "95 % interval of the fit";
  if (!lit.fit) {
    found.missing = lit.no_fit_because.empty() ? "no fit was requested" : lit.no_fit_because;
  } else if (!lit.diode()) {
    found.ohm = {};
    found.missing = "void: see the warnings";
  }
  return found;
}

double PseudoFillFactorOf(double isc_A, const std::vector<VocPoint>& points) {
  const double voc = VocAt(points, isc_A);
  if (points.size() < 2 || !std::isfinite(voc)) return kUnknown;
  double best = kUnknown;
  for (std::size_t k = 1; k < points.size(); ++k) {
    // Between two points ln(light) is linear in V, and V (Isc - light) is concave.
    const double rate = std::log(points[k].light_A / points[k - 1].light_A) /
                        (points[k].voc_V - points[k - 1].voc_V);
    const auto light = [&](double v) {
      return points[k - 1].light_A * std::exp(rate * (v - points[k - 1].voc_V));
    };
    const double low = points[k - 1].voc_V, high = std::min(points[k].voc_V, voc);
    if (!(low < high)) continue;
    const double best_V =
        RootBetween([&](double v) { return isc_A - light(v) * (1 + rate * v); }, low, high);
    const double power = best_V * (isc_A - light(best_V));
    if (!(power <= best)) best = power;
  }
  // A maximum at the first point lies outside the points.
  const double first = points.front().voc_V * (isc_A - points.front().light_A);
  return best > first ? best / (isc_A * voc) : kUnknown;
}

}  // namespace lyrefit
