#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace lyrefit {

// A measured curve as a line through its points: x rises strictly.
struct Line {
  std::vector<double> x;
  std::vector<double> y;  // of each x

  // Value at `at` by linear interpolation; NaN outside the points.
  double At(double at) const;
  // Like At, but linear in ln y between points whose y are both positive: exact for an exponential.
  double LogAt(double at) const;
  // Integral from `low` to `high`, both within the points; NaN otherwise.
  double Area(double low, double high) const;
};

// The line through points in any order. Points of equal x are averaged.
Line MakeLine(const std::vector<double>& x, const std::vector<double>& y);

// A straight line of least squares, y = mean_y + slope (x - mean_x).
struct Regression {
  double slope = 0;
  double slope_error = 0;  // standard error; NaN for two points
  double mean_x = 0;
  double mean_y = 0;
};

// The range [first, last) around the value nearest to 0 with |value| <= reach, extended to the three
// nearest.
std::pair<std::size_t, std::size_t> NearZero(const std::vector<double>& values, double reach);

// Least-squares line through the points [first, last) of equally long lists.
Regression Regress(const std::vector<double>& x, const std::vector<double>& y, std::size_t first,
                   std::size_t last);

}  // namespace lyrefit
