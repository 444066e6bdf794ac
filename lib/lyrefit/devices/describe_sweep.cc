#include "lyrefit/devices/describe_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/median.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewestReadings = 5;
constexpr double kJudgedFrom = 0.3;  // of Voc: below it a device still settles to the sweep

// Number of the sweep of each reading.
std::vector<int> SweepNumbers(const IvCurve& curve) {
  if (!curve.sweep.empty()) return curve.sweep;
  std::vector<int> numbers(curve.size(), 0);
  for (const int turn : FindTurns(curve.voltage_V)) {
    for (std::size_t k = turn; turn > 0 && k < numbers.size(); ++k) ++numbers[k];
  }
  return numbers;
}

// The readings from `first` to before `last`.
IvCurve PartOf(const IvCurve& curve, std::size_t first, std::size_t last) {
  IvCurve part = curve;
  const auto cut = [&](auto* values) {
    if (values->size() != curve.size()) return;
    *values = {values->begin() + static_cast<std::ptrdiff_t>(first),
               values->begin() + static_cast<std::ptrdiff_t>(last)};
  };
  cut(&part.voltage_V);
  cut(&part.current_A);
  cut(&part.sigma_A);
  cut(&part.time_s);
  cut(&part.irradiance_W_m2);
  cut(&part.temperature_C);
  part.sweep.clear();
  return part;
}

// The sweep with one light, the mean of its readings where they state it.
IvCurve UnderMeanLight(IvCurve curve) {
  std::vector<double>& light = curve.irradiance_W_m2;
  if (light.empty()) return curve;
  curve.conditions.irradiance_W_m2 = std::max(
      0.0, std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size()));
  curve.irradiance_known = true;
  light.clear();
  return curve;
}

// Whether results are stated for the second sweep as well.
bool AreOfEach(const std::vector<StatedResult>& stated) {
  return std::any_of(stated.begin(), stated.end(), [](const auto& one) { return one.sweep > 0; });
}

// Leaves out three and more readings beyond Voc whose currents are equal within 2e-4 of Isc, at the
// smallest current: the source's limit, where voltages and currents pile up. Returns their number.
int LeaveOutEqualEnd(IvCurve* curve) {
  constexpr double kEqual = 2e-4;
  constexpr int kFewest = 3;
  if (curve->suns_voc_A || IsDark(*curve)) return 0;
  const KeyPoints key = FindKeyPoints(curve->voltage_V, curve->current_A);
  const double least = *std::min_element(curve->current_A.begin(), curve->current_A.end());
  const double reach = least + kEqual * key.short_circuit_current_A;
  const auto at_limit = [&](std::size_t k) {
    return curve->current_A[k] <= reach && curve->voltage_V[k] > key.open_circuit_voltage_V;
  };
  IvCurve kept = *curve;
  for (auto* values :
       {&kept.voltage_V, &kept.current_A, &kept.sigma_A, &kept.time_s, &kept.temperature_C}) {
    if (values->size() != curve->size()) continue;
    std::size_t count = 0;
    for (std::size_t k = 0; k < curve->size(); ++k) {
      if (!at_limit(k)) (*values)[count++] = (*values)[k];
    }
    values->resize(count);
  }
  const int left_out = static_cast<int>(curve->size() - kept.size());
  if (left_out < kFewest || kept.size() < kFewestReadings) return 0;
  *curve = std::move(kept);
  return left_out;
}

std::string NameOf(const CellSweep& sweep, const DeviceNotes& notes) {
  if (sweep.kind == SweepKind::kSunsVoc) return "Suns-Voc";
  const std::string direction = ToText(sweep.direction);
  if (sweep.kind == SweepKind::kDark) return direction + ", dark";
  if (!sweep.irradiance_known && notes.illuminance_lux) {
    return fmt::format("{}, {:.4g} lux", direction, *notes.illuminance_lux);
  }
  return fmt::format("{}, {:.4g} W/m2{}", direction, sweep.irradiance_W_m2,
                     sweep.irradiance_known ? "" : " (assumed)");
}

// The first finding on the magnitude of voltage and current, the other column, sign or area,
// unless the readings are to be taken as they are. The number of cells is no matter of these.
std::optional<ReadingFinding> DoubtOf(IvCurve curve, double area_cm2) {
  if (curve.as_is) return std::nullopt;
  if (std::isfinite(area_cm2)) curve.notes.area_cm2 = area_cm2;
  for (const ReadingFinding& finding : CheckReadings(curve)) {
    for (const char* const id :
         {"sign", "exchanged", "unit", "light", "technology", "current", "efficiency"}) {
      if (finding.id == id) return finding;
    }
  }
  return std::nullopt;
}

// Why the light is not known well enough for an efficiency; empty: it is. A hundredth of the current
// of a silicon cell under one sun is of other light, or of a cell that hardly works.
std::string WhyNoEfficiency(const IvCurve& curve, double jsc_mA_cm2) {
  constexpr double kLeast_mA_cm2 = 0.4;
  if (curve.irradiance_known) return "";
  if (curve.notes.illuminance_lux) {
    return fmt::format(
        "no efficiency: {:g} lux are stated, whose power depends on the spectrum of the lamp; give "
        "the irradiance (--irradiance-Wm2)",
        *curve.notes.illuminance_lux);
  }
  if (!(jsc_mA_cm2 < kLeast_mA_cm2)) return "";
  return fmt::format(
      "no efficiency: Jsc of {:.3g} mA/cm2 is far from what the assumed 1000 W/m2 give (some 10 to "
      "45); give the irradiance (--irradiance-Wm2)",
      jsc_mA_cm2);
}

// Rate of a sweep by the times of its readings, the median; NaN without times.
double RateOf(const IvCurve& curve) {
  std::vector<double> rates;
  for (std::size_t k = 1; k < curve.time_s.size(); ++k) {
    const double step_s = std::fabs(curve.time_s[k] - curve.time_s[k - 1]);
    const double step_V = std::fabs(curve.voltage_V[k] - curve.voltage_V[k - 1]);
    if (step_s > 0 && step_V > 0) rates.push_back(step_V / step_s);
  }
  return rates.empty() || curve.suns_voc_A ? kUnknown : Median(std::move(rates));
}

CellSweep Describe(const IvCurve& curve, double area_cm2) {
  CellSweep sweep;
  sweep.file = curve.source;
  sweep.kind = curve.suns_voc_A ? SweepKind::kSunsVoc
               : IsDark(curve)  ? SweepKind::kDark
                                : SweepKind::kLit;
  sweep.direction = Rises(curve.voltage_V) ? ScanDirection::kForward : ScanDirection::kReverse;
  sweep.irradiance_W_m2 = sweep.kind == SweepKind::kDark ? 0 : curve.conditions.irradiance_W_m2;
  sweep.irradiance_known = curve.irradiance_known || sweep.kind == SweepKind::kDark;
  sweep.scan_rate_V_s = curve.notes.scan_rate_V_s.value_or(RateOf(curve));
  sweep.elapsed_h = curve.notes.elapsed_h.value_or(kUnknown);
  sweep.suns_voc_A = curve.suns_voc_A.value_or(kUnknown);
  sweep.pseudo_current = curve.pseudo_current;
  const Line line = MakeLine(curve.voltage_V, curve.current_A);
  sweep.voltage_V = line.x;
  sweep.current_A = line.y;
  sweep.noise_A = NoiseFromDifferences(line.x, line.y);
  sweep.name = NameOf(sweep, curve.notes);
  const KeyPoints unknown = {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  sweep.key = sweep.kind == SweepKind::kLit ? FindKeyPoints(line.x, line.y) : unknown;
  const bool lit = sweep.kind == SweepKind::kLit;
  const auto doubt = sweep.kind == SweepKind::kSunsVoc ? std::nullopt : DoubtOf(curve, area_cm2);
  if (doubt && (lit || doubt->refuse)) {  // others are of figures that only a lit sweep has
    sweep.doubt = doubt->sentence;
    sweep.refused = doubt->refuse;
  }
  if (!lit) return sweep;
  const KeyPoints& key = sweep.key;
  if (sweep.doubt.empty()) {
    sweep.jsc_mA_cm2 = 1000 * key.short_circuit_current_A / area_cm2;
    sweep.no_efficiency_because = WhyNoEfficiency(curve, sweep.jsc_mA_cm2);
  }
  if (sweep.doubt.empty() && sweep.no_efficiency_because.empty()) {
    constexpr double kSquareMetre_cm2 = 1e4;
    sweep.efficiency = key.max_power_W / (sweep.irradiance_W_m2 * area_cm2 / kSquareMetre_cm2);
  }
  sweep.resistance_at_isc_ohm = ResistanceAtIsc(line, key);
  sweep.resistance_at_voc_ohm = ResistanceAtVoc(line, key);
  sweep.least_slope_ratio = LeastSlopeRatio(line, key, sweep.noise_A);
  return sweep;
}

// By how much the current rises with the voltage between `kJudgedFrom` and Voc.
double LargestRise(const CellSweep& sweep) {
  const double voc = sweep.key.open_circuit_voltage_V;
  double lowest = HUGE_VAL, rise = 0;
  for (std::size_t k = 0; k < sweep.voltage_V.size(); ++k) {
    if (!(sweep.voltage_V[k] >= kJudgedFrom * voc && sweep.voltage_V[k] <= voc)) continue;
    lowest = std::min(lowest, sweep.current_A[k]);
    rise = std::max(rise, sweep.current_A[k] - lowest);
  }
  return rise;
}

// Why n and Rs of the fit describe no diode.
std::vector<std::string> WhyNoDiode(const CellOptions& options, const CellSweep& sweep,
                                    const FitReport& fit) {
  constexpr double kSShape = 0.9, kMisfit = 0.01, kNoises = 6;
  if (!fit.usable) return {fit.not_usable_because};
  std::vector<std::string> reasons;
  const double isc = sweep.key.short_circuit_current_A;
  if (LargestRise(sweep) > std::max(kMisfit * isc, kNoises * sweep.noise_A)) {
    reasons.emplace_back("the current rises with the voltage: the light or the meter changed");
  } else if (sweep.least_slope_ratio < kSShape) {
    reasons.push_back(
        fmt::format("S-shape: the curve flattens towards Voc, its slope falls to {:.0f} % of what "
                    "it was at a lower voltage",
                    100 * sweep.least_slope_ratio));
  }
  if (fit.rmse.refined.solved_current_A > kMisfit * isc) {
    reasons.push_back(fmt::format("the single diode misses the curve by {:.1f} % of Isc (rms)",
                                  100 * fit.rmse.refined.solved_current_A / isc));
  }
  for (const Estimate& e : fit.estimates) {
    if (e.info.symbol[0] == 'n' && e.refined > options.ideal_n) {
      reasons.push_back(fmt::format(
          "n = {:.3g} of the fit is above {:.3g}: {}, a barrier or a second junction is in "
          "it",
          e.refined, options.ideal_n,
          sweep.kind == SweepKind::kDark ? "tunnelling"
                                         : "collection that depends on voltage, ions"));
    }
  }
  return reasons;
}

}  // namespace

std::vector<MeasuredSweep> FindSweeps(const IvCurve& curve, double area_cm2) {
  std::vector<MeasuredSweep> found;
  const std::vector<int> numbers = SweepNumbers(curve);
  for (std::size_t first = 0, place = 0; first < curve.size(); ++place) {
    std::size_t last = first;
    while (last < curve.size() && numbers[last] == numbers[first]) ++last;
    MeasuredSweep measured = {UnderMeanLight(PartOf(curve, first, last)), {}};
    if (last - first >= kFewestReadings) {
      const int limited = LeaveOutEqualEnd(&measured.curve);
      measured.sweep = Describe(measured.curve, area_cm2);
      measured.sweep.limited = limited;
      std::vector<StatedResult> own;
      for (const StatedResult& one : curve.stated) {
        if (one.sweep == static_cast<int>(place)) own.push_back(one);
      }
      const bool one_value_for_all = place == 0 && last < curve.size() && !AreOfEach(curve.stated);
      if (!one_value_for_all) measured.sweep.stated = CompareStated(own, measured.sweep, area_cm2);
      found.push_back(std::move(measured));
    }
    first = last;
  }
  return found;
}

double ResistanceAtIsc(const Line& line, const KeyPoints& key) {
  const auto [first, last] = NearZero(line.x, key.open_circuit_voltage_V / 10);
  const double slope = Regress(line.x, line.y, first, last).slope;
  return slope < 0 ? -1 / slope : kUnknown;
}

double ResistanceAtVoc(const Line& line, const KeyPoints& key) {
  const auto [first, last] = NearZero(line.y, key.short_circuit_current_A / 10);
  const double slope = Regress(line.y, line.x, first, last).slope;
  return slope < 0 ? -slope : kUnknown;
}

double LeastSlopeRatio(const Line& line, const KeyPoints& key, double noise_A) {
  constexpr std::size_t kReadings = 5;
  constexpr double kTo = 1.1, kErrors = 5, kWindow = 0.08;
  const double voc = key.open_circuit_voltage_V;
  const double mean_slope = key.short_circuit_current_A / voc;
  double ratio = 1, steepest = 0, its_error = 0;
  for (std::size_t k = 0; k + kReadings <= line.x.size(); ++k) {
    std::size_t last = k + kReadings;
    while (last < line.x.size() && line.x[last] - line.x[k] <= kWindow * voc) ++last;
    const Regression fit = Regress(line.x, line.y, k, last);
    if (!(fit.mean_x >= kJudgedFrom * voc && fit.mean_x <= kTo * voc)) continue;
    double xx = 0;
    for (std::size_t i = k; i < last; ++i) xx += std::pow(line.x[i] - fit.mean_x, 2);
    const double slope = -fit.slope;
    const double error = std::max(noise_A / std::sqrt(xx), fit.slope_error);
    const bool past_knee = steepest >= mean_slope;
    if (past_knee && steepest - slope > kErrors * std::hypot(error, its_error)) {
      ratio = std::min(ratio, std::max(slope, 0.0) / steepest);
    }
    if (slope <= steepest) continue;
    steepest = slope;
    its_error = error;
  }
  return ratio;
}

CellSweep FitCellSweep(MeasuredSweep measured, const CellOptions& options,
                       const Observer& observer) {
  CellSweep& sweep = measured.sweep;
  if (sweep.kind == SweepKind::kSunsVoc) return std::move(sweep);
  FitOptions how;
  how.constants = options.constants;
  how.random_baseline = false;
  how.threads = options.threads;
  how.bounds.overrides["n"] = {1, options.largest_n};
  if (sweep.kind == SweepKind::kDark) how.fixed["Iph"] = 0;
  auto fit = Fit(measured.curve, how, observer);
  if (fit) {
    sweep.void_because = WhyNoDiode(options, sweep, *fit);
    sweep.fit = std::move(*fit);
  } else {
    sweep.no_fit_because = fit.error().message;
  }
  return std::move(sweep);
}

Expected<AcceptedSweeps> LeaveOutRefused(std::vector<MeasuredSweep> measured) {
  AcceptedSweeps accepted;
  for (MeasuredSweep& one : measured) {
    const CellSweep& sweep = one.sweep;
    const std::string why = sweep.doubt + " (--as-is takes the readings as they are)";
    if (sweep.refused && measured.size() == 1) return Fail(why, sweep.file);
    if (sweep.refused) accepted.warnings.push_back(sweep.name + " is left out: " + why);
    if (!sweep.refused) accepted.sweeps.push_back(std::move(one));
  }
  if (accepted.sweeps.empty()) {
    return Fail(accepted.warnings.front(), measured.front().sweep.file);
  }
  return accepted;
}

}  // namespace lyrefit
