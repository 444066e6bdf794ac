#include "lyrefit/curve/sweep_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

constexpr std::vector<double> IvCurve::*kColumns[] = {&IvCurve::voltage_V, &IvCurve::current_A,
                                                      &IvCurve::sigma_A, &IvCurve::irradiance_W_m2,
                                                      &IvCurve::temperature_C};

template <class T>
void Permute(const std::vector<std::size_t>& order, std::vector<T>* values) {
  if (values->size() != order.size()) return;
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t k : order) sorted.push_back((*values)[k]);
  *values = std::move(sorted);
}

void SortByVoltage(IvCurve* curve) {
  std::vector<std::size_t> order(curve->size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return curve->voltage_V[a] < curve->voltage_V[b];
  });
  curve->time_s.clear();
  curve->sweep.clear();
  Permute(order, &curve->voltage_V);
  Permute(order, &curve->current_A);
  Permute(order, &curve->sigma_A);
  Permute(order, &curve->irradiance_W_m2);
  Permute(order, &curve->temperature_C);
}

}  // namespace

CurveSet InOrder(const CurveSet& set, std::vector<std::string>* warnings) {
  constexpr std::size_t kShortest = 6;  // readings of a sweep, on the average
  CurveSet ordered = set;
  for (IvCurve& curve : ordered.curves) {
    const std::size_t sweeps = FindTurns(curve.voltage_V).size();
    if (sweeps < 3 || curve.size() >= kShortest * sweeps) continue;
    SortByVoltage(&curve);
    warnings->push_back(curve.name +
                        ": the readings are in no order of voltage; taken as one sweep from the "
                        "lowest to the highest, so what happened in time cannot be seen");
  }
  return ordered;
}

bool Rises(const std::vector<double>& voltage_V) {
  return !voltage_V.empty() && voltage_V.back() > voltage_V.front();
}

void Reverse(IvCurve* curve) {
  curve->time_s.clear();
  for (const auto column : kColumns) {
    std::reverse((curve->*column).begin(), (curve->*column).end());
  }
  std::reverse(curve->sweep.begin(), curve->sweep.end());
}

void AppendSweep(const IvCurve& next, IvCurve* curve) {
  const std::size_t before = curve->size();
  curve->time_s.clear();
  if (curve->sweep.empty()) curve->sweep.assign(before, 1);
  const int sweeps = curve->sweep.back() - curve->sweep.front() + 1;
  for (StatedResult one : next.stated) {
    one.sweep += sweeps;
    curve->stated.push_back(std::move(one));
  }
  curve->sweep.insert(curve->sweep.end(), next.size(), curve->sweep.back() + 1);
  for (const auto column : kColumns) {
    std::vector<double>& values = curve->*column;
    const std::vector<double>& more = next.*column;
    if (values.size() == before && more.size() == next.size()) {
      values.insert(values.end(), more.begin(), more.end());
    } else {
      values.clear();
    }
  }
}

std::vector<int> FindTurns(const std::vector<double>& voltage) {
  const auto [low, high] = std::minmax_element(voltage.begin(), voltage.end());
  const double jitter = 0.2 * (*high - *low);
  std::vector<int> turns = {0};
  int direction = 0;
  std::size_t extreme = 0;
  for (std::size_t k = 1; k < voltage.size(); ++k) {
    const double move = voltage[k] - voltage[extreme];
    if (direction == 0) {
      if (std::fabs(move) > jitter) {
        direction = move > 0 ? 1 : -1;
        extreme = k;
      }
    } else if (direction * move > 0) {
      extreme = k;
    } else if (std::fabs(move) > jitter) {
      turns.push_back(static_cast<int>(extreme) + 1);
      direction = -direction;
      extreme = k;
    }
  }
  return turns;
}

namespace {

struct Line {
  double intercept = 0;
  double slope = 0;
};

// Tukey's resistant line, through the medians of the outer thirds. Outliers have little effect.
Line ResistantLine(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::size_t> order(x.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  const std::size_t third = std::max<std::size_t>(1, order.size() / 3);
  std::vector<double> ends[4];  // x and y of the lower third, x and y of the upper third
  for (std::size_t i = 0; i < third; ++i) {
    const std::size_t low = order[i];
    const std::size_t high = order[order.size() - 1 - i];
    ends[0].push_back(x[low]);
    ends[1].push_back(y[low]);
    ends[2].push_back(x[high]);
    ends[3].push_back(y[high]);
  }
  const double low_x = UpperMedian(ends[0]);
  const double low_y = UpperMedian(ends[1]);
  const double width = UpperMedian(ends[2]) - low_x;
  const double slope = width > 0 ? (UpperMedian(ends[3]) - low_y) / width : 0;
  return {low_y - slope * low_x, slope};
}

// Median of the three readings nearest to `voltage` (of fewer than five, the nearest one), against
// outliers.
double CurrentNear(double voltage, const std::vector<double>& voltage_V,
                   const std::vector<double>& current_A) {
  std::vector<std::size_t> order(voltage_V.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t count = order.size() < 5 ? 1 : 3;
  std::partial_sort(order.begin(), order.begin() + count, order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return std::abs(voltage_V[a] - voltage) < std::abs(voltage_V[b] - voltage);
                    });
  std::vector<double> nearest;
  for (std::size_t i = 0; i < count; ++i) nearest.push_back(current_A[order[i]]);
  return UpperMedian(nearest);
}

}  // namespace

CurrentSign DetectCurrentSign(const std::vector<double>& voltage_V,
                              const std::vector<double>& current_A) {
  if (voltage_V.empty() || voltage_V.size() != current_A.size()) return CurrentSign::kGenerator;
  const double largest_current = LargestMagnitude(current_A);
  double nearest = std::abs(voltage_V[0]);
  for (const double voltage : voltage_V) nearest = std::min(nearest, std::abs(voltage));

  const Line line = ResistantLine(voltage_V, current_A);
  const bool reaches_zero_volt = nearest <= 0.1 * LargestMagnitude(voltage_V);
  const double at_zero_volt =
      reaches_zero_volt ? CurrentNear(0, voltage_V, current_A) : line.intercept;
  const bool clear = std::abs(at_zero_volt) >= 0.3 * largest_current;
  if (!clear) return line.slope > 0 ? CurrentSign::kLoad : CurrentSign::kGenerator;

  const auto [low, high] = std::minmax_element(voltage_V.begin(), voltage_V.end());
  const double rise =
      CurrentNear(*high, voltage_V, current_A) - CurrentNear(*low, voltage_V, current_A);
  const bool steep = std::abs(rise) >= 0.3 * largest_current;
  if (steep && (rise > 0) != (at_zero_volt < 0)) return CurrentSign::kUnclear;
  return at_zero_volt < 0 ? CurrentSign::kLoad : CurrentSign::kGenerator;
}

void TurnLoadSign(IvCurve* curve) {
  switch (DetectCurrentSign(curve->voltage_V, curve->current_A)) {
    case CurrentSign::kGenerator:
      return;
    case CurrentSign::kLoad:
      for (double& current : curve->current_A) current = 0 - current;
      curve->assumptions.push_back(
          "the currents are in load sign (delivered current negative): their sign was turned");
      return;
    case CurrentSign::kUnclear:
      curve->assumptions.push_back(
          "the signs of voltage and current fit no generator (the current at zero volt and its "
          "trend disagree): both were left as written");
      return;
  }
}

}  // namespace lyrefit
