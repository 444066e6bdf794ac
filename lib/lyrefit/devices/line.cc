#include "lyrefit/devices/line.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

// Index of the point after `at`, at least 1; 0 if `at` is outside the points.
std::size_t After(const Line& line, double at) {
  if (line.x.size() < 2 || !(at >= line.x.front() && at <= line.x.back())) return 0;
  const auto above = std::upper_bound(line.x.begin(), line.x.end(), at);
  return std::min<std::size_t>(above - line.x.begin(), line.x.size() - 1);
}

double PartOf(const Line& line, std::size_t k, double at) {
  return (at - line.x[k - 1]) / (line.x[k] - line.x[k - 1]);
}

}  // namespace

double Line::At(double at) const {
  const std::size_t k = After(*this, at);
  return k == 0 ? kUnknown : y[k - 1] + PartOf(*this, k, at) * (y[k] - y[k - 1]);
}

double Line::LogAt(double at) const {
  const std::size_t k = After(*this, at);
  if (k == 0 || !(y[k - 1] > 0 && y[k] > 0)) return At(at);
  return y[k - 1] * std::pow(y[k] / y[k - 1], PartOf(*this, k, at));
}

double Line::Area(double low, double high) const {
  double sum = 0, last_x = low, last_y = At(low);
  for (std::size_t k = 0; k < x.size() && x[k] < high; ++k) {
    if (x[k] <= low) continue;
    sum += (x[k] - last_x) * (y[k] + last_y) / 2;
    last_x = x[k];
    last_y = y[k];
  }
  return sum + (high - last_x) * (At(high) + last_y) / 2;
}

Line MakeLine(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&x](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  Line line;
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    double sum = 0;
    for (; last < order.size() && x[order[last]] == x[order[first]]; ++last) sum += y[order[last]];
    line.x.push_back(x[order[first]]);
    line.y.push_back(sum / static_cast<double>(last - first));
    first = last;
  }
  return line;
}

std::pair<std::size_t, std::size_t> NearZero(const std::vector<double>& values, double reach) {
  constexpr std::size_t kFewest = 3;
  std::size_t first = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (std::fabs(values[k]) < std::fabs(values[first])) first = k;
  }
  std::size_t last = first + 1;
  const auto below = [&] { return first > 0 ? std::fabs(values[first - 1]) : kInfinity; };
  const auto above = [&] { return last < values.size() ? std::fabs(values[last]) : kInfinity; };
  while (std::min(below(), above()) <= reach ||
         (last - first < kFewest && last - first < values.size())) {
    if (below() < above()) {
      --first;
    } else {
      ++last;
    }
  }
  return {first, last};
}

Regression Regress(const std::vector<double>& x, const std::vector<double>& y, std::size_t first,
                   std::size_t last) {
  const double count = static_cast<double>(last - first);
  Regression found;
  for (std::size_t k = first; k < last; ++k) {
    found.mean_x += x[k] / count;
    found.mean_y += y[k] / count;
  }
  double xx = 0, xy = 0, rest = 0;
  for (std::size_t k = first; k < last; ++k) {
    xx += (x[k] - found.mean_x) * (x[k] - found.mean_x);
    xy += (x[k] - found.mean_x) * (y[k] - found.mean_y);
  }
  found.slope = xy / xx;
  for (std::size_t k = first; k < last; ++k) {
    const double off = y[k] - found.mean_y - found.slope * (x[k] - found.mean_x);
    rest += off * off;
  }
  found.slope_error = count > 2 ? std::sqrt(rest / (count - 2) / xx) : kUnknown;
  return found;
}

}  // namespace lyrefit
