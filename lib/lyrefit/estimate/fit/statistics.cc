#include "lyrefit/estimate/fit/statistics.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/groups.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/numbers.h"

namespace lyrefit {

// Caches the last value: it is computed for every parameter of every curve, mostly with equal
// degrees.
double StudentT95(int degrees_of_freedom) {
  thread_local int known_for = 0;
  thread_local double known = 0;
  const int degrees = std::max(degrees_of_freedom, 1);
  if (known_for != degrees) known = StudentQuantile(0.975, degrees);
  known_for = degrees;
  return known;
}

double FTestPValue(double mean_square_simple, double mean_square_rich, int extra,
                   int degrees_of_freedom_rich) {
  if (degrees_of_freedom_rich < 1 || !(mean_square_rich > 0)) return kUnknown;
  const double f = (mean_square_simple / mean_square_rich - 1) / extra * degrees_of_freedom_rich;
  if (!(f > 0)) return 1;
  return FisherTail(f, extra, degrees_of_freedom_rich);
}

InformationCriteria FindInformation(double mean_square, int points, int parameters) {
  InformationCriteria criteria;
  criteria.points = points;
  criteria.parameters = parameters;
  const double fit = points * std::log(std::max(mean_square, 1e-300));
  const int k = parameters + 1;
  criteria.bic = fit + k * std::log(points);
  if (points - k - 1 > 0) criteria.aicc = fit + 2.0 * k + 2.0 * k * (k + 1) / (points - k - 1);
  return criteria;
}

std::vector<int> OrderByVoltage(const std::vector<double>& voltage_V) {
  return RisingOrder(voltage_V);
}

ResidualStatistics FindResidualStatistics(const std::vector<double>& voltage_V,
                                          const std::vector<double>& residual_A) {
  ResidualStatistics result;
  const std::vector<int> order = OrderByVoltage(voltage_V);
  double sum = 0, squares = 0, steps = 0, positive = 0, previous = 0;
  result.largest_A = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double r = residual_A[order[k]];
    if (std::fabs(r) >= result.largest_A) {
      result.largest_A = std::fabs(r);
      result.largest_at_V = voltage_V[order[k]];
    }
    sum += r;
    squares += r * r;
    positive += r > 0;
    if (k > 0) steps += (r - previous) * (r - previous);
    if (k == 0 || (r > 0) != (previous > 0)) ++result.runs;
    previous = r;
  }
  const double n = static_cast<double>(order.size());
  const double negative = n - positive;
  result.mean_A = sum / n;
  if (squares > 0) result.durbin_watson = steps / squares;
  result.expected_runs = 2 * positive * negative / n + 1;
  const double variance =
      (result.expected_runs - 1) * (result.expected_runs - 2) / std::max(n - 1, 1.0);
  if (positive > 0 && negative > 0 && variance > 0) {
    const double distance = std::max(std::fabs(result.runs - result.expected_runs) - 0.5, 0.0);
    result.runs_p_value = 2 * NormalTail(distance / std::sqrt(variance));
  }
  return result;
}

double NoiseFromDifferences(const std::vector<double>& voltage_V,
                            const std::vector<double>& values) {
  if (values.size() < 5) return 0;
  std::vector<int> order = OrderByVoltage(voltage_V);
  const auto copy = [&](int a, int b) {
    return voltage_V[a] == voltage_V[b] && values[a] == values[b];
  };
  order.erase(std::unique(order.begin(), order.end(), copy), order.end());
  if (order.size() < 5) return 0;
  std::vector<double> differences;
  for (std::size_t k = 1; k + 1 < order.size(); ++k) {
    differences.push_back(values[order[k - 1]] - 2 * values[order[k]] + values[order[k + 1]]);
  }
  return RobustScale(std::move(differences), UpperMedian) / std::sqrt(6.0);
}

}  // namespace lyrefit
