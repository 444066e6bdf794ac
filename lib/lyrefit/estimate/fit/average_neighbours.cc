#include "lyrefit/estimate/fit/average_neighbours.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/refine/coarsen.h"
#include "lyrefit/model/current.h"

namespace lyrefit {
namespace {

constexpr double kWidest = 0.01;  // largest width of a group, in units of Voc

using Values = std::vector<double>;

// Width of each group along the path, at most kWidest: the distance of its mean to the nearer
// neighbouring mean. `position` has the means.
Values WidthsOf(const Values& position) {
  Values widths(position.size(), kWidest);
  for (std::size_t g = 0; g < position.size(); ++g) {
    if (g > 0) widths[g] = std::min(widths[g], position[g] - position[g - 1]);
    if (g + 1 < position.size()) widths[g] = std::min(widths[g], position[g + 1] - position[g]);
  }
  return widths;
}

// Relative loss of path variance by averaging within each group, times the path length l. For m
// readings at equal distances d, averaging multiplies the variance by the mean of exp(-|x - x'| /
// l) over all pairs. That is 1 - d (m^2 - 1) / (3 m l) where d m is much less than l.
Values AveragedAway(const Grouping& first, const Values& position) {
  Values parts = WidthsOf(position);
  for (std::size_t g = 0; g < parts.size(); ++g) {
    const double m = first[g + 1] - first[g];
    parts[g] *= (m * m - 1) / (3 * m * m);
  }
  return parts;
}

}  // namespace

Grouping GroupNeighbours(const std::vector<double>& voltage_V, double open_circuit_V) {
  const int readings = static_cast<int>(voltage_V.size());
  return GroupByRule(
      readings,
      {(readings + kFewPoints - 1) / kFewPoints, voltage_V, kWidest * open_circuit_V, {}});
}

ErrorShape AverageShape(const Grouping& first, const ErrorShape& shape) {
  ErrorShape means;
  means.current = MeanErrors(first, shape.current);
  means.voltage = MeanErrors(first, shape.voltage);
  means.stated = MeanErrors(first, shape.stated);
  means.part = MeanErrors(first, shape.part);
  means.path = Means(first, shape.path);
  means.position = Means(first, shape.position);
  if (first.size() <= shape.position.size()) {
    means.averaged_away = AveragedAway(first, means.position);
  }
  for (int g = 0; g < GroupCount(first); ++g) means.chain.push_back(shape.chain[first[g]]);
  return means;
}

Differences DifferencesWithin(const Grouping& first, const ErrorShape& shape,
                              const Eigen::VectorXd& residual) {
  Differences differences;
  const Values widths = WidthsOf(Means(first, shape.position));
  // The standard deviation of a difference is sqrt(2) times that of a typical reading.
  const auto append = [](const Values& errors, int begin, int end, Values* to) {
    double squares = 0;
    for (int k = begin; k < end && !errors.empty(); ++k) squares += errors[k] * errors[k];
    if (!errors.empty()) to->push_back(std::sqrt(2 * squares / (end - begin)));
  };
  for (int g = 0; g < GroupCount(first); ++g) {
    const int begin = first[g], count = first[g + 1] - begin, pairs = count / 2;
    if (pairs == 0) continue;
    const int end = begin + 2 * pairs;
    double squares = 0;
    for (int k = begin; k < end; k += 2) squares += std::pow(residual[k + 1] - residual[k], 2);
    append(shape.current, begin, end, &differences.shape.current);
    append(shape.voltage, begin, end, &differences.shape.voltage);
    append(shape.stated, begin, end, &differences.shape.stated);
    append(shape.part, begin, end, &differences.shape.part);
    append(shape.path, begin, end, &differences.shape.path);
    differences.shape.position.push_back(widths[g] / count);
    differences.count.push_back(pairs);
    differences.mean_square.push_back(squares / pairs);
  }
  return differences;
}

RefineProblem AverageProblem(const Grouping& first, const RefineProblem& problem,
                             const std::vector<double>& p) {
  const auto model = [&](const Values& voltage_V, const Values& near_A) {
    return SolveCurrents(problem.device, p.data(), MakePointSet(voltage_V, near_A));
  };
  Values distance = problem.current_A;
  const Values fitted = model(problem.voltage_V, problem.current_A);
  for (std::size_t k = 0; k < distance.size(); ++k) distance[k] -= fitted[k];
  Values voltage = Means(first, problem.voltage_V), current = Means(first, distance);
  const Values there = model(voltage, Means(first, problem.current_A));
  for (std::size_t g = 0; g < current.size(); ++g) current[g] += there[g];
  return WithPoints(problem, std::move(voltage), std::move(current), {});
}

}  // namespace lyrefit
