#include "lyrefit/curve/curve_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {
namespace {

constexpr double kHour_s = 3600;

double Span(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0 : *high - *low;
}

// The share of successive steps of the voltage that turn back. Equal voltages are no steps.
double ShareOfTurns(const std::vector<double>& voltage_V) {
  int steps = 0, turns = 0;
  double last = 0;
  for (std::size_t k = 1; k < voltage_V.size(); ++k) {
    const double step = voltage_V[k] - voltage_V[k - 1];
    if (step == 0) continue;
    if (last != 0) {
      ++steps;
      if ((step > 0) != (last > 0)) ++turns;
    }
    last = step;
  }
  return steps == 0 ? 0 : static_cast<double>(turns) / steps;
}

// Records what the extent of a lit sweep lacks, or has too much of.
void TakeExtent(const IvCurve& curve, KindOfMeasurement* found) {
  const auto add = [found](CurveKind kind, const std::string& words) {
    found->kind = std::max(found->kind, kind);
    found->words += (found->words.empty() ? "" : "; ") + words;
  };
  const KeyPoints points = FindKeyPoints(curve.voltage_V, curve.current_A);
  const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
  if (IsFlash(curve)) {
    add(CurveKind::kFlash,
        fmt::format("flash test: all readings within {:.3g} ms", 1e3 * Span(curve.time_s)));
  }
  if (std::isnan(points.short_circuit_current_A) && *low > 0) {
    add(CurveKind::kBeginsAtVoltage,
        fmt::format("begins at {:.4g} V: its short-circuit current is not measured", *low));
  }
  const double last_A = curve.current_A[high - curve.voltage_V.begin()];
  if (std::isnan(points.open_circuit_voltage_V) && last_A > 0) {
    const bool knee = points.max_power_voltage_V < *high;
    add(CurveKind::kEndsEarly, fmt::format("ends at {:.4g} V, before {}: its open-circuit voltage "
                                           "is not measured",
                                           *high, knee ? "open circuit" : "the maximum power"));
  }
  if (-last_A > points.short_circuit_current_A) {
    add(CurveKind::kFarBeyondVoc,
        fmt::format("goes to {:.3g} A into the device, more than its Isc of {:.3g} A", -last_A,
                    points.short_circuit_current_A));
  }
}

}  // namespace

bool IsFlash(const IvCurve& curve) {
  constexpr double kLongestPulse_s = 0.5;
  return !curve.time_s.empty() && !curve.irradiance_W_m2.empty() && Span(curve.time_s) > 0 &&
         Span(curve.time_s) < kLongestPulse_s;
}

bool OperatingPointsOfADay(const std::vector<double>& time_s,
                           const std::vector<double>& voltage_V) {
  constexpr std::size_t kLeast = 10;
  constexpr double kShortest_s = 2 * kHour_s;
  // Of a random walk half of the steps turn back, of a sweep almost none, of one with its noise few.
  constexpr double kWanders = 0.2;
  return time_s.size() == voltage_V.size() && time_s.size() >= kLeast &&
         Span(time_s) >= kShortest_s && ShareOfTurns(voltage_V) > kWanders;
}

std::string OperatingPointsWords(const std::vector<double>& time_s) {
  return fmt::format(
      "operating points of a day: {} readings over {:.1f} hours, one voltage and one current at a "
      "time, not a sweep: `lyrefit trend --operating FILE --module MODEL` reads such a table if it "
      "has irradiance and temperature",
      time_s.size(), Span(time_s) / kHour_s);
}

KindOfMeasurement KindOf(const IvCurve& curve) {
  if (OperatingPointsOfADay(curve.time_s, curve.voltage_V)) {
    return {CurveKind::kOperatingPoints, OperatingPointsWords(curve.time_s)};
  }
  if (curve.key_points) {
    if (std::isnan(curve.key_points->max_power_current_A)) {
      return {CurveKind::kIscVoc, "Isc and Voc alone, no sweep"};
    }
    return {CurveKind::kKeyPoints, "key points, no sweep"};
  }
  if (curve.suns_voc_A) {
    return {CurveKind::kSunsVoc,
            "Suns-Voc: open-circuit voltages over light, without series resistance"};
  }
  if (IsDark(curve)) return {CurveKind::kDark, "dark: no current flows at 0 V"};
  KindOfMeasurement found;
  TakeExtent(curve, &found);
  return found;
}

}  // namespace lyrefit
