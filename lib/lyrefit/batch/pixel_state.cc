#include "lyrefit/batch/pixel_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr double kSun_W_m2 = 1000;
constexpr double kResistorFf = 0.25;
constexpr double kUsualArea_cm2 = 0.1;
// Slopes at 0 V and at Voc that differ by less are those of a straight line.
constexpr double kStraight = 1.5;

// The area, or that of a usual pixel, so that pixels without an area can be judged.
double AreaToJudge(const CellReport& report) {
  return std::isfinite(report.area_cm2) ? report.area_cm2 : kUsualArea_cm2;
}

// Largest density of current within 0.1 V of 0 V, in mA/cm2.
double LargestNearZero(const CellReport& report) {
  constexpr double kNear_V = 0.1;
  double largest_A = 0;
  for (const CellSweep& sweep : report.sweeps) {
    for (std::size_t k = 0; k < sweep.voltage_V.size(); ++k) {
      if (std::fabs(sweep.voltage_V[k]) > kNear_V) continue;
      largest_A = std::max(largest_A, std::fabs(sweep.current_A[k]));
    }
  }
  return 1e3 * largest_A / AreaToJudge(report);
}

// A pixel without photocurrent: a resistor, or nothing.
JudgedPixel WithoutPhotocurrent(const CellReport& report, const PixelOptions& options) {
  const double near_zero = LargestNearZero(report);
  if (near_zero > options.least_jsc_mA_cm2) {
    return {PixelState::kShorted,
            fmt::format("shorted: no power, but {:.3g} mA/cm2 within 0.1 V of 0 V", near_zero)};
  }
  return {PixelState::kDead, "dead: no photocurrent (or a dark curve that is not said to be one)"};
}

bool IsStraight(const CellSweep& sweep) {
  const double ratio = sweep.resistance_at_isc_ohm / sweep.resistance_at_voc_ohm;
  return ratio < kStraight && ratio > 1 / kStraight;
}

}  // namespace

const CellSweep* BrightestSweeps::better() const {
  if (forward == nullptr || reverse == nullptr) return forward == nullptr ? reverse : forward;
  return reverse->key.max_power_W > forward->key.max_power_W ? reverse : forward;
}

BrightestSweeps BrightestSweepsOf(const CellReport& report) {
  constexpr double kSameLight = 0.02;
  double brightest = 0;
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind == SweepKind::kLit) brightest = std::max(brightest, sweep.irradiance_W_m2);
  }
  BrightestSweeps found;
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind != SweepKind::kLit || sweep.irradiance_W_m2 < (1 - kSameLight) * brightest) {
      continue;
    }
    const bool forward = sweep.direction == ScanDirection::kForward;
    const CellSweep*& place = forward ? found.forward : found.reverse;
    if (place == nullptr) place = &sweep;
  }
  return found;
}

JudgedPixel JudgePixel(const CellReport& report, bool all_dark, const PixelOptions& options) {
  if (all_dark) return {PixelState::kUnlit, ""};
  const CellSweep* const best = BrightestSweepsOf(report).better();
  if (best == nullptr || !(best->key.max_power_W > 0)) return WithoutPhotocurrent(report, options);
  const KeyPoints& key = best->key;
  const double least_jsc = options.least_jsc_mA_cm2 * best->irradiance_W_m2 / kSun_W_m2;
  const double jsc = 1e3 * key.short_circuit_current_A / AreaToJudge(report);
  if (jsc < least_jsc) {
    return {PixelState::kDead,
            fmt::format("dead: Jsc of {:.3g} mA/cm2 is below {:.3g} mA/cm2", jsc, least_jsc)};
  }
  const double least_voc_V = options.least_voc_V * report.cells_in_series;
  if (key.open_circuit_voltage_V < least_voc_V) {
    return {PixelState::kShorted, fmt::format("shorted: Voc of {:.3g} V is below {:.3g} V",
                                              key.open_circuit_voltage_V, least_voc_V)};
  }
  const double from_resistor = 100 * std::fabs(key.fill_factor - kResistorFf);
  if (from_resistor <= options.resistor_ff_percent && IsStraight(*best)) {
    return {PixelState::kShorted,
            fmt::format("shorted: a straight line, FF of {:.1f} %", 100 * key.fill_factor)};
  }
  if (100 * best->efficiency < options.least_efficiency_percent) {
    return {PixelState::kWeak,
            fmt::format("weak: efficiency of {:.3g} % is below {:.3g} %", 100 * best->efficiency,
                        options.least_efficiency_percent)};
  }
  return {};
}

std::string PixelCriterion(const PixelOptions& options) {
  std::string text = fmt::format(
      "A pixel works if its direction of more power passes these limits. Dead: Jsc below {:g} "
      "mA/cm2 at 1000 W/m2 (where no area is known, {:g} cm2 are assumed). Shorted: Voc below {:g} "
      "V a cell, or a straight line with an FF within {:g} of 25 %.",
      options.least_jsc_mA_cm2, kUsualArea_cm2, options.least_voc_V, options.resistor_ff_percent);
  if (options.least_efficiency_percent > 0) {
    text += fmt::format(" Weak: efficiency below {:g} %.", options.least_efficiency_percent);
  }
  return text;
}

}  // namespace lyrefit
