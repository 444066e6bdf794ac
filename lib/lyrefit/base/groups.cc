#include "lyrefit/base/groups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace lyrefit {

void AppendGroups(int begin, int end, const GroupRule& rule, Grouping* first) {
  const auto parted = [&](int at, int k) {
    if (!rule.alone.empty() && (rule.alone[at] != 0 || rule.alone[k] != 0)) return true;
    return !rule.place.empty() && std::fabs(rule.place[k] - rule.place[at]) > rule.widest;
  };
  for (int k = begin, at = begin; k < end; ++k) {
    if (k != begin && k - at < rule.most && !parted(at, k)) continue;
    at = k;
    first->push_back(k);
  }
}

Grouping GroupByRule(int points, const GroupRule& rule) {
  Grouping first;
  AppendGroups(0, points, rule, &first);
  first.push_back(points);
  return first;
}

Grouping EqualGroups(int points, int groups) {
  Grouping first = {0};
  for (int g = 1; g <= groups; ++g) {
    first.push_back(static_cast<int>(std::int64_t{points} * g / groups));
  }
  return first;
}

std::vector<int> GroupsWith(const Grouping& first, const std::vector<int>& points) {
  std::vector<int> groups;
  groups.reserve(points.size());
  for (const int k : points) {
    const auto next = std::upper_bound(first.begin(), first.end(), k);
    groups.push_back(static_cast<int>(next - first.begin()) - 1);
  }
  return groups;
}

std::vector<int> PointsIn(const Grouping& first, const std::vector<int>& groups) {
  std::vector<int> points;
  for (const int g : groups) {
    for (int k = first[g]; k < first[g + 1]; ++k) points.push_back(k);
  }
  return points;
}

std::vector<double> Means(const Grouping& first, const std::vector<double>& values) {
  std::vector<double> means;
  for (int g = 0; g < GroupCount(first) && !values.empty(); ++g) {
    const auto begin = values.begin() + first[g], end = values.begin() + first[g + 1];
    means.push_back(std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin));
  }
  return means;
}

std::vector<double> MeanErrors(const Grouping& first, const std::vector<double>& errors) {
  std::vector<double> squares = errors;
  for (double& one : squares) one *= one;
  std::vector<double> means = Means(first, squares);
  for (std::size_t g = 0; g < means.size(); ++g) {
    means[g] = std::sqrt(means[g] / static_cast<double>(first[g + 1] - first[g]));
  }
  return means;
}

RowMatrix AverageRows(const Grouping& first, const RowMatrix& rows) {
  RowMatrix means(GroupCount(first), rows.cols());
  for (int g = 0; g < GroupCount(first); ++g) {
    means.row(g) = rows.middleRows(first[g], first[g + 1] - first[g]).colwise().mean();
  }
  return means;
}

std::vector<int> RisingOrder(const std::vector<double>& values) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  if (std::is_sorted(values.begin(), values.end())) return order;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  return order;
}

}  // namespace lyrefit
