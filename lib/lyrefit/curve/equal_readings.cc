#include "lyrefit/curve/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

constexpr int kFewestEqual = 5;    // readings; shorter runs occur by chance
constexpr double kSteps = 20;      // steps of the instrument that exceed rounding
constexpr double kVisible = 0.02;  // of the range of the currents
constexpr double kSharp = 5e-4;    // of the range of the currents, at a corner

// The readings by rising voltage; by falling voltage to examine the low-voltage end.
struct Ordered {
  std::vector<int> position;  // in the curve
  std::vector<double> voltage_V;
  std::vector<double> current_A;
};

Ordered ByVoltage(const IvCurve& curve, bool falling) {
  Ordered ordered;
  ordered.position.resize(curve.size());
  std::iota(ordered.position.begin(), ordered.position.end(), 0);
  std::stable_sort(ordered.position.begin(), ordered.position.end(), [&](int a, int b) {
    return falling ? curve.voltage_V[a] > curve.voltage_V[b]
                   : curve.voltage_V[a] < curve.voltage_V[b];
  });
  for (const int k : ordered.position) {
    ordered.voltage_V.push_back(curve.voltage_V[k]);
    ordered.current_A.push_back(curve.current_A[k]);
  }
  return ordered;
}

// Number of equal values at the end.
int EqualAtTheEnd(const std::vector<double>& values) {
  const auto other = std::find_if(values.rbegin(), values.rend(),
                                  [&](double value) { return value != values.back(); });
  return static_cast<int>(other - values.rbegin());
}

// Current step of a coarse instrument, of which all small differences between neighbours are
// multiples; 0 for a fine instrument. With too few small differences to decide, it is the smallest
// difference.
double CoarseStep(const std::vector<double>& values) {
  constexpr int kTelling = 6;
  constexpr int kMostParts = 8;
  constexpr double kMany = 20;      // steps beyond which written digits hide the multiple
  constexpr double kRounded = 0.1;  // of a step
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (values[k] != values[k - 1]) steps.push_back(std::fabs(values[k] - values[k - 1]));
  }
  if (steps.empty()) return 0;
  const double smallest = *std::min_element(steps.begin(), steps.end());
  for (int parts = 1; parts <= kMostParts; ++parts) {
    const double step = smallest / parts;
    int telling = 0, multiples = 0;
    for (const double difference : steps) {
      const double multiple = difference / step;
      if (multiple > kMany) continue;
      ++telling;
      multiples += std::fabs(multiple - std::round(multiple)) < kRounded;
    }
    if (telling < kTelling) return parts == 1 ? smallest : 0;
    if (multiples == telling) return step;
  }
  return 0;
}

double RangeOf(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

// The smallest slope of the three intervals before the last `run` readings, in A/V. An outlier or
// the step of a bypass diode makes one or two intervals steep, but not three.
double SlopeBefore(const Ordered& readings, int run) {
  double slope = HUGE_VAL;
  int intervals = 0;
  // The first reading of the run may lie anywhere between the curve and the limit.
  const int last = static_cast<int>(readings.position.size()) - run - 1;
  for (int k = last; k > 0 && intervals < 3; --k) {
    const double width = std::fabs(readings.voltage_V[k] - readings.voltage_V[k - 1]);
    if (!(width > 0)) continue;
    slope = std::min(slope, (readings.current_A[k - 1] - readings.current_A[k]) / width);
    ++intervals;
  }
  return intervals == 3 ? slope : 0;
}

// Whether the slope before the run makes constant current implausible: beyond the knee a device's
// current falls ever faster.
bool IsForwardLimit(const Ordered& readings, int run) {
  const double width =
      std::fabs(readings.voltage_V.back() - readings.voltage_V[readings.position.size() - run]);
  const double expected = SlopeBefore(readings, run) * width;
  return expected > kSteps * CoarseStep(readings.current_A) &&
         expected > kVisible * RangeOf(readings.current_A);
}

// Lower limit of the voltage over which the slope of a device falls by a factor of e, in V. It is
// that of a cold diode with n = 1 for each cell. In a module a third of the cells may pass the knee
// alone, behind a bypass diode.
double SharpestCorner_V(const IvCurve& curve) {
  constexpr double kThermal_V = 0.02;
  constexpr double kUsual_V = 0.62;  // of a cell, if their number is unknown
  constexpr double kFewestBypassed = 18;
  const double highest_V = *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
  const double cells =
      curve.cells_known ? curve.conditions.cells_in_series : std::max(1.0, highest_V / kUsual_V);
  return kThermal_V * (cells < kFewestBypassed ? cells : cells / 3);
}

// Whether the run ends the curve more abruptly than a diode. Towards low voltage (`readings` are in
// falling order) the slope decays at most exponentially.
bool IsReverseLimit(const Ordered& readings, int run, double corner_V) {
  const std::size_t first = readings.position.size() - run;
  const double level = readings.current_A.back();
  const double beside = readings.current_A[first - 1], beyond = readings.current_A[first - 2];
  const bool goes_on = (beside - level) * (beyond - beside) > 0 &&
                       (beyond - beside) * (readings.current_A[first - 3] - beyond) > 0;
  if (!goes_on) return false;
  const double away = (readings.voltage_V[first - 2] + readings.voltage_V[first - 1] -
                       readings.voltage_V[first] - readings.voltage_V[first + 1]) /
                      2;
  const double expected = std::fabs(beyond - beside) * std::exp(-away / corner_V);
  return expected > kSteps * CoarseStep(readings.current_A) &&
         expected > kSharp * RangeOf(readings.current_A);
}

ReadingFinding LimitFinding(const Ordered& readings, int run, const std::string& sentence) {
  ReadingFinding finding;
  finding.id = "limit";
  finding.sentence = sentence;
  finding.points.assign(readings.position.end() - run, readings.position.end());
  std::sort(finding.points.begin(), finding.points.end());
  return finding;
}

void LookForCurrentLimit(const IvCurve& curve, bool low_end, std::vector<ReadingFinding>* out) {
  const Ordered readings = ByVoltage(curve, low_end);
  const int run = EqualAtTheEnd(readings.current_A);
  if (run < kFewestEqual || run + 4 > static_cast<int>(curve.size())) return;
  const bool limit = low_end ? IsReverseLimit(readings, run, SharpestCorner_V(curve))
                             : IsForwardLimit(readings, run);
  if (!limit) return;
  const double from_V = readings.voltage_V[readings.position.size() - run];
  out->push_back(LimitFinding(
      readings, run,
      fmt::format("{} consecutive readings of exactly the same current {:.6g} A from "
                  "{:.4g} V {}: a current limit (compliance) of the instrument? "
                  "if so, leave them out: no model follows them, and robust losses do not help",
                  run, readings.current_A.back(), from_V, low_end ? "down" : "up")));
}

int LongestRunElsewhere(const Ordered& readings, int run) {
  int longest = 1, here = 1;
  for (std::size_t k = 1; k + run < readings.position.size(); ++k) {
    here = readings.voltage_V[k] == readings.voltage_V[k - 1] ? here + 1 : 1;
    longest = std::max(longest, here);
  }
  return longest;
}

void LookForVoltageLimit(const IvCurve& curve, bool low_end, std::vector<ReadingFinding>* out) {
  constexpr int kUpAndDown = 2;  // readings at one voltage in a sweep up and down
  const Ordered readings = ByVoltage(curve, low_end);
  const int run = EqualAtTheEnd(readings.voltage_V);
  if (run < kFewestEqual || run + 4 > static_cast<int>(curve.size())) return;
  if (LongestRunElsewhere(readings, run) > kUpAndDown) return;
  // If the currents agree as well, one state was read repeatedly, which is harmless.
  const std::vector<double> currents(readings.current_A.end() - run, readings.current_A.end());
  if (RangeOf(currents) < kVisible * RangeOf(readings.current_A)) return;
  out->push_back(LimitFinding(
      readings, run,
      fmt::format("{} readings of exactly the same voltage {:.6g} V at the {} end: a voltage limit "
                  "of the instrument? if so, leave them out",
                  run, readings.voltage_V.back(), low_end ? "low" : "high")));
}

template <class T>
void RemoveAt(const std::vector<bool>& removed, std::vector<T>* values) {
  if (values->size() != removed.size()) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < removed.size(); ++k) {
    if (!removed[k]) (*values)[kept++] = (*values)[k];
  }
  values->resize(kept);
}

}  // namespace

void LeaveOutLimited(IvCurve* curve) {
  constexpr double kReached = 0.998;
  constexpr std::size_t kFewestLeft = 4;
  if (!curve->notes.compliance_A || curve->size() == 0) return;
  const double limit_A = *curve->notes.compliance_A;
  const Ordered readings = ByVoltage(*curve, false);
  std::vector<bool> removed(curve->size());
  std::size_t run = 0;
  while (run < curve->size()) {
    const std::size_t at = curve->size() - 1 - run;
    if (!(readings.current_A[at] <= -kReached * limit_A)) break;
    removed[readings.position[at]] = true;
    ++run;
  }
  if (run == 0 || curve->size() < run + kFewestLeft) return;
  curve->assumptions.push_back(
      fmt::format("{} of {} readings, from {:.4g} V up, at the stated limit of {:.6g} A left out: "
                  "the source held its current there",
                  run, curve->size(), readings.voltage_V[curve->size() - run], limit_A));
  for (auto* column : {&curve->voltage_V, &curve->current_A, &curve->sigma_A, &curve->time_s,
                       &curve->irradiance_W_m2, &curve->temperature_C}) {
    RemoveAt(removed, column);
  }
  RemoveAt(removed, &curve->sweep);
}

std::size_t LeaveOutPadding(std::size_t begin, IvCurve* curve) {
  constexpr double kNear = 2;      // usual steps of the voltage
  constexpr double kSmall = 0.05;  // of the largest current, at a reading beside the origin
  const std::size_t size = curve->size();
  std::size_t end = size;
  while (end > begin && curve->voltage_V[end - 1] == 0 && curve->current_A[end - 1] == 0) --end;
  if (end == size) return 0;
  if (end >= begin + 2) {  // a dark sweep may end at the origin, with one reading of zeros
    const std::vector<double>& voltage = curve->voltage_V;
    const double largest =
        LargestMagnitude({curve->current_A.begin() + static_cast<std::ptrdiff_t>(begin),
                          curve->current_A.begin() + static_cast<std::ptrdiff_t>(end)});
    std::vector<double> steps;
    for (std::size_t k = begin + 1; k < end; ++k) {
      steps.push_back(std::fabs(voltage[k] - voltage[k - 1]));
    }
    const bool arrives = std::fabs(voltage[end - 1]) <= kNear * Median(steps) &&
                         std::fabs(curve->current_A[end - 1]) <= kSmall * largest;
    if (arrives) ++end;
  }
  for (auto* column : {&curve->voltage_V, &curve->current_A, &curve->sigma_A, &curve->time_s,
                       &curve->irradiance_W_m2, &curve->temperature_C}) {
    if (column->size() == size) column->resize(end);
  }
  if (curve->sweep.size() == size) curve->sweep.resize(end);
  return size - end;
}

std::vector<ReadingFinding> FindEqualReadings(const IvCurve& curve) {
  std::vector<ReadingFinding> findings;
  if (curve.size() == 0) return findings;
  for (const bool low_end : {false, true}) {
    LookForCurrentLimit(curve, low_end, &findings);
    LookForVoltageLimit(curve, low_end, &findings);
  }
  return findings;
}

bool AreWholeNumbers(const std::vector<double>& readings) {
  constexpr std::size_t kFewest = 8;
  constexpr double kLarge = 100;  // whole numbers below may be readings of a coarse instrument
  return readings.size() >= kFewest && LargestMagnitude(readings) > kLarge &&
         std::all_of(readings.begin(), readings.end(),
                     [](double value) { return value == std::floor(value); });
}

}  // namespace lyrefit
