#pragma once

#include <limits>
#include <vector>

#include "lyrefit/base/dense.h"

namespace lyrefit {

// Few points that replace many. Points that are neighbours in a sequence are grouped by a rule.
// The caller then replaces each group, for example by its mean or by its extreme points.

// Index of the first point of each group, followed by the number of points.
using Grouping = std::vector<int>;

// Where groups end. A point joins the group before it unless a member forbids it. The vectors have
// one value per point, or none.
struct GroupRule {
  int most = std::numeric_limits<int>::max();  // points of a group
  // A group has no point whose place is farther than `widest` from that of its first point. With
  // `widest` 0 a group ends where the place changes.
  std::vector<double> place;
  double widest = 0;
  std::vector<char> alone;  // not 0: the point is a group of its own
};

// Groups by a rule.
Grouping GroupByRule(int points, const GroupRule& rule);

// Appends the first points of the groups of the points in [begin, end).
void AppendGroups(int begin, int end, const GroupRule& rule, Grouping* first);

// Groups of equally many points, to one point.
Grouping EqualGroups(int points, int groups);

// Each point is a group of its own.
inline Grouping EachAlone(std::size_t points) {
  return EqualGroups(static_cast<int>(points), static_cast<int>(points));
}

// Number of groups.
inline int GroupCount(const Grouping& first) { return static_cast<int>(first.size()) - 1; }

// Groups that contain the given points.
std::vector<int> GroupsWith(const Grouping& first, const std::vector<int>& points);

// Points in the given groups.
std::vector<int> PointsIn(const Grouping& first, const std::vector<int>& groups);

// Means of values, one per group; empty if `values` is empty.
std::vector<double> Means(const Grouping& first, const std::vector<double>& values);

// Standard deviations of the means for independent errors of standard deviation `errors`.
std::vector<double> MeanErrors(const Grouping& first, const std::vector<double>& errors);

// Means of rows, one row per group.
RowMatrix AverageRows(const Grouping& first, const RowMatrix& rows);

// Indices of the values in rising order; equal values keep their order.
std::vector<int> RisingOrder(const std::vector<double>& values);

}  // namespace lyrefit
