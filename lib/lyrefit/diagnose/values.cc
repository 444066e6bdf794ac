#include "lyrefit/diagnose/values.h"
#include "lyrefit/model/curve_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace lyrefit {
namespace {

// Whether all values are whole multiples of `step` from the first, to within 3 % of a step (plus
// 2e-6 per step of the distance).
bool LieOn(const std::vector<double>& sorted, double step) {
  for (const double value : sorted) {
    const double steps = (value - sorted.front()) / step;
    if (std::fabs(steps - std::round(steps)) > 0.03 + 2e-6 * std::fabs(steps)) return false;
  }
  return true;
}

// The step by least squares over the whole range.
double Sharpen(const std::vector<double>& sorted, double step) {
  double xy = 0, xx = 0;
  for (const double value : sorted) {
    const double steps = std::round((value - sorted.front()) / step);
    xy += steps * (value - sorted.front());
    xx += steps * steps;
  }
  return xx > 0 ? xy / xx : step;
}

// Sets the rounding error of each reading. Neighbours with the same value share their error, so
// that together they count as one reading.
void AddRounding(const Readings& readings, bool dark, double step, std::vector<double>* rounding) {
  const std::vector<Reading>& points = readings.points;
  for (std::size_t first = 0; step > 0 && first < points.size();) {
    std::size_t last = first;
    while (last + 1 < points.size() && points[last + 1].segment == points[first].segment &&
           std::fabs(points[last + 1].current - points[first].current) < 0.1 * step) {
      ++last;
    }
    const double run = static_cast<double>(last - first + 1);
    for (std::size_t k = first; k <= last; ++k) {
      if (points[k].dark == dark) (*rounding)[k] = step * std::sqrt(run / 12);
    }
    first = last + 1;
  }
}

// Appends the readings at the smallest current at the high-voltage end of a monotone stretch.
// Before it reaches the limit, the curve must have been falling.
void AddEnd(const std::vector<Reading>& points, std::size_t first, std::size_t last,
            double smallest, double step, std::vector<int>* at) {
  const bool rising = points[last].voltage > points[first].voltage;
  const int inwards = rising ? -1 : 1;
  const int end = static_cast<int>(rising ? last : first);
  const int stop = static_cast<int>(rising ? first : last) + inwards;
  constexpr double kHeld = 1e-4;  // of the limit: sources hold it, meters read it
  const double slack = kHeld * std::fabs(smallest) + 1e-9;
  int k = end;
  while (k != stop && points[k].current <= smallest + slack) k += inwards;
  const int run = std::abs(k - end);
  // Beyond open circuit currents fall steeply; near 0 coarse readings repeat.
  const int fewest = smallest < -0.01 ? 3 : 4;
  if (run < fewest || k == stop || k + inwards == stop) return;
  const double fall = points[k + inwards].current - points[k].current;
  if (!(fall > std::max(3 * step, 1e-3))) return;
  for (int i = end; i != k; i += inwards) at->push_back(i);
}

// Appends the readings at the high-voltage end of a monotone stretch, beyond open circuit, that stay
// near the smallest current, as a noisy limit does, while the voltage goes on by so much that the
// current would fall by far more.
void AddNoisyEnd(const std::vector<Reading>& points, std::size_t first, std::size_t last,
                 double smallest, std::vector<int>* at) {
  constexpr double kHeld = 0.007, kLeast = -0.01;  // of the limit; the limit itself, in scales
  constexpr int kFewest = 5;
  constexpr double kMore = 10;  // times the slack
  if (!(smallest < kLeast)) return;
  const bool rising = points[last].voltage > points[first].voltage;
  const int inwards = rising ? -1 : 1;
  const int end = static_cast<int>(rising ? last : first);
  const int stop = static_cast<int>(rising ? first : last) + inwards;
  const double slack = kHeld * std::fabs(smallest);
  int k = end;
  while (k != stop && points[k].current <= smallest + slack) k += inwards;
  if (std::abs(k - end) < kFewest || k == stop || k + inwards == stop) return;
  const Reading &before = points[k], &earlier = points[k + inwards];
  const double rise = before.voltage - earlier.voltage;
  const double slope = rise > 0 ? (earlier.current - before.current) / rise : 0;
  if (!(slope * (points[end].voltage - points[k - inwards].voltage) > kMore * slack)) return;
  for (int i = end; i != k; i += inwards) at->push_back(i);
}

// Finds readings at the smallest current that follow each other at the high-voltage end of a
// stretch. Those of a noisy limit are only left out: it shows beyond open circuit alone, and is
// nothing to act on.
void FindLowerLimit(const Readings& readings, double step, ValueFindings* findings) {
  const std::vector<Reading>& points = readings.points;
  double smallest = points.front().current;
  for (const Reading& r : points) smallest = std::min(smallest, r.current);
  std::vector<int> at, noisy;
  for (std::size_t first = 0; first < points.size();) {
    std::size_t last = first;
    while (last + 1 < points.size() && points[last + 1].segment == points[first].segment) ++last;
    AddEnd(points, first, last, smallest, step, &at);
    AddNoisyEnd(points, first, last, smallest, &noisy);
    first = last + 1;
  }
  if (at.empty()) {
    findings->at_lower = noisy;
    return;
  }
  findings->limited = true;
  findings->lower_limit = smallest;
  findings->at_lower = at;
}

// Finds readings at a limit that is stated. `limit`: in scales.
void FindStatedLimit(const Readings& readings, double limit, ValueFindings* findings) {
  constexpr double kHeld = 1e-3;  // of the limit
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    const double current = readings.points[k].current;
    if (std::fabs(current) < limit * (1 - kHeld)) continue;
    (current < 0 ? findings->at_lower : findings->clipped).push_back(static_cast<int>(k));
  }
  findings->limited = !findings->at_lower.empty();
  if (findings->limited) findings->lower_limit = -limit;
  if (!findings->clipped.empty()) findings->clip_level = limit;
}

// Finds readings at the largest voltage at the high-voltage end of a stretch while the current
// still falls: the voltmeter was at its limit.
void FindVoltageLimit(const Readings& readings, double step, ValueFindings* findings) {
  constexpr std::size_t kFewest = 4;
  const std::vector<Reading>& points = readings.points;
  double largest = 0, least = 1e300, most = -1e300;
  for (const Reading& r : points) largest = std::max(largest, r.voltage);
  const auto at_limit = [&](std::size_t k) {
    return k < points.size() && !points[k].dark && !(points[k].voltage < largest * (1 - 1e-9));
  };
  // Sweeps of equal length all end at the largest voltage, so a single reading of a stretch is no
  // limit.
  const auto stands_alone = [&](std::size_t k) {
    const auto beside = [&](std::size_t i) {
      return at_limit(i) && points[i].segment == points[k].segment;
    };
    return !beside(k + 1) && !(k > 0 && beside(k - 1));
  };
  std::vector<int> at;
  std::size_t ties = 0;  // in coarse bins, repeats are no evidence
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!at_limit(k)) {
      ties += k > 0 && points[k].voltage == points[k - 1].voltage;
      continue;
    }
    if (stands_alone(k)) continue;
    at.push_back(static_cast<int>(k));
    least = std::min(least, points[k].current);
    most = std::max(most, points[k].current);
  }
  if (at.size() < kFewest || at.size() <= 3 * (ties + 1) ||
      !(most - least > std::max(3 * step, 0.01)))
    return;
  findings->at_voltage_limit = at;
  findings->voltage_limit = largest;
}

// Absolute slope |dI/dV| at a reading, from its nearest neighbours that are about two voltage steps
// away.
double SlopeOver(const std::vector<Reading>& points, int k, double step) {
  const int count = static_cast<int>(points.size());
  const auto next = [&](int inwards) {
    int i = k;
    while (i + inwards >= 0 && i + inwards < count &&
           points[i + inwards].segment == points[k].segment &&
           std::fabs(points[i].voltage - points[k].voltage) < 1.5 * step) {
      i += inwards;
    }
    return i;
  };
  const Reading &a = points[next(-1)], &b = points[next(1)];
  const double dv = b.voltage - a.voltage;
  return std::fabs(dv) > 0.5 * step ? std::fabs((b.current - a.current) / dv) : 0;
}

}  // namespace

double FindGrid(const std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.size() < 8) return 0;
  const double range = sorted.back() - sorted.front();
  // Differences below a millionth of the range are rounding of digits, not steps.
  double smallest = range;
  std::vector<double> distinct = {sorted.front()};
  for (const double value : sorted) {
    const double difference = value - distinct.back();
    if (difference < 1e-6 * range) continue;
    smallest = std::min(smallest, difference);
    distinct.push_back(value);
  }
  if (distinct.size() < 3) return 0;
  for (int part = 1; part <= 3; ++part) {
    const double step = smallest / part;
    if (step < 1e-4 * range) break;
    // Start with few values: the step must be accurate before large multiples of it are tested.
    double sharp = step;
    bool on = true;
    for (std::size_t count = 3; on; count = 2 * count) {
      const std::size_t upto = std::min(count, distinct.size());
      std::vector<double> near(distinct.end() - static_cast<std::ptrdiff_t>(upto), distinct.end());
      on = LieOn(near, sharp);
      sharp = Sharpen(near, sharp);
      if (upto == distinct.size()) break;
    }
    if (on && LieOn(distinct, sharp)) return sharp;
  }
  return 0;
}

namespace {

// Whether positions are equally spaced up to rounding, and more than two apart.
bool ComeRegularly(const std::vector<int>& places) {
  if (places.size() < 4) return false;
  int least = places[1] - places[0], most = least;
  for (std::size_t k = 2; k < places.size(); ++k) {
    least = std::min(least, places[k] - places[k - 1]);
    most = std::max(most, places[k] - places[k - 1]);
  }
  return least > 2 && most <= least + 1;
}

}  // namespace

VoltageBins FindBins(const Readings& readings) {
  constexpr double kUneven = 0.25, kRepeated = 0.1;  // fractions of the steps
  // By hand one sets a dozen round voltages, closer where the curve bends: no mark of an instrument.
  constexpr std::size_t kFewest = 16;
  if (readings.points.size() < kFewest) return {};
  std::vector<double> voltages;
  for (const Reading& r : readings.points) voltages.push_back(r.voltage);
  const double step = FindGrid(voltages);
  if (step == 0) return {};
  const std::vector<Reading>& points = readings.points;
  const auto steps_to = [&](std::size_t k) {
    return std::lround(std::fabs(points[k].voltage - points[k - 1].voltage) / step);
  };
  int uneven = 0, all = 0;
  std::vector<int> repeated, twice;  // readings 0 and 2 steps from the previous one
  std::map<long, int> steps;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k - 1].segment != points[k].segment) continue;
    ++all;
    ++steps[steps_to(k)];
    if (steps_to(k) == 0) repeated.push_back(static_cast<int>(k));
    if (steps_to(k) == 2) twice.push_back(static_cast<int>(k));
    const bool within = k + 1 < points.size() && points[k + 1].segment == points[k].segment;
    uneven += within && steps_to(k) != steps_to(k + 1);
  }
  const bool beats = ComeRegularly(repeated.empty() ? twice : repeated);
  const bool often =
      uneven > kUneven * all || static_cast<double>(repeated.size()) > kRepeated * all;
  if (!often && !beats) return {};
  int commonest = 0;
  for (const auto& [size, count] : steps) commonest = std::max(commonest, count);
  return {step, static_cast<double>(all) / std::max(all - commonest, 1)};
}

ValueFindings LookAtValues(const Readings& readings, std::optional<double> limit) {
  ValueFindings findings;
  std::vector<double> currents, lit, unlit;
  double largest = 0;
  for (const Reading& r : readings.points) {
    currents.push_back(r.current);
    (r.dark ? unlit : lit).push_back(r.current);
    if (!r.dark) largest = std::max(largest, r.current);
  }
  findings.grids.lit = FindGrid(lit);
  findings.grids.dark = FindGrid(unlit);
  findings.rounding.assign(currents.size(), 0.0);
  AddRounding(readings, false, findings.grids.lit, &findings.rounding);
  AddRounding(readings, true, findings.grids.dark, &findings.rounding);
  // Exact repeats of the largest current are clipped, except on a coarse grid.
  std::vector<int> repeats;
  std::vector<double> below;
  for (std::size_t k = 0; k < currents.size(); ++k) {
    if (readings.points[k].dark) continue;
    if (currents[k] >= largest * (1 - 1e-9)) {
      repeats.push_back(static_cast<int>(k));
    } else {
      below.push_back(currents[k]);
    }
  }
  std::sort(below.begin(), below.end());
  int ties = 0;
  for (std::size_t k = 1; k < below.size(); ++k) ties += below[k] == below[k - 1];
  if (limit) FindStatedLimit(readings, *limit, &findings);
  if (!findings.HasLimits()) {
    FindLowerLimit(readings, std::max(findings.grids.lit, findings.grids.dark), &findings);
  }
  FindVoltageLimit(readings, std::max(findings.grids.lit, findings.grids.dark), &findings);
  const VoltageBins bins = FindBins(readings);
  findings.voltage_bin = bins.step;
  findings.bins_shared = bins.shared;
  findings.bin_rounding.assign(currents.size(), 0.0);
  for (std::size_t k = 0; k < currents.size() && findings.voltage_bin > 0; ++k) {
    const double slope = SlopeOver(readings.points, static_cast<int>(k), findings.voltage_bin);
    findings.bin_rounding[k] = findings.voltage_bin * slope / std::sqrt(12);
  }
  const bool many = repeats.size() >= 4 && static_cast<int>(repeats.size()) > 3 * (ties + 1);
  if (many && findings.grids.lit == 0 && findings.clip_level == 0) {
    findings.clip_level = largest;
    findings.clipped = repeats;
  }
  return findings;
}

bool LightMoved(const Readings& readings) {
  constexpr double kLeast = 0.01;
  if (!readings.traits.single || readings.traits.only_dark) return false;
  if (readings.traits.up_down) return false;
  double lowest = HUGE_VAL, rise = 0;
  for (const double current : ShapeOf(readings).current) {
    lowest = std::min(lowest, current);
    rise = std::max(rise, current - lowest);
  }
  return rise > kLeast;
}

}  // namespace lyrefit
