#include "lyrefit/report/figure_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/groups.h"

namespace lyrefit {

std::vector<std::size_t> MarksToDraw(const std::vector<double>& x, const std::vector<double>& y,
                                     std::size_t most) {
  const std::size_t count = std::min(x.size(), y.size());
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (count <= most) return places;
  places.erase(
      std::remove_if(places.begin(), places.end(),
                     [&](std::size_t i) { return !std::isfinite(x[i]) || !std::isfinite(y[i]); }),
      places.end());
  if (places.size() <= most) return places;
  const auto by_x = [&x](std::size_t a, std::size_t b) { return x[a] < x[b]; };
  const auto [left, right] = std::minmax_element(places.begin(), places.end(), by_x);
  const double begin = x[*left];
  const double span = x[*right] - begin;
  const std::size_t last_bin = (most - 2) / 4;
  const auto last = static_cast<double>(last_bin);
  std::vector<double> bins;
  bins.reserve(places.size());
  for (const std::size_t i : places) {
    bins.push_back(span > 0 ? std::floor((x[i] - begin) / span * last) : 0);
  }
  std::vector<std::size_t> by_bin;
  GroupRule rule;
  for (const int k : RisingOrder(bins)) {
    by_bin.push_back(places[k]);
    rule.place.push_back(bins[k]);
  }
  const Grouping first = GroupByRule(static_cast<int>(by_bin.size()), rule);
  std::vector<std::size_t> kept = {places.front(), places.back()};
  const auto by_y = [&y](std::size_t a, std::size_t b) { return y[a] < y[b]; };
  // Four points for each bin: the lowest, the highest and two typical ones.
  for (int g = 0; g < GroupCount(first); ++g) {
    const auto from = by_bin.begin() + first[g], to = by_bin.begin() + first[g + 1];
    const auto [lowest, highest] = std::minmax_element(from, to, by_y);
    kept.insert(kept.end(), {*lowest, *highest, from[(to - from) / 3], from[2 * (to - from) / 3]});
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

}  // namespace lyrefit
