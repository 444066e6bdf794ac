#include "lyrefit/curve/current_sign.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lyrefit/base/largest.h"
#include "lyrefit/base/median.h"

namespace lyrefit {
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
