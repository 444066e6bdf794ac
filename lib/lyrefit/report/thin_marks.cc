#include "lyrefit/report/figure_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  // Four points for each bin: the lowest, the highest and two typical ones.
  std::vector<std::vector<std::size_t>> bins((most - 2) / 4 + 1);
  const auto last = static_cast<double>(bins.size() - 1);
  for (const std::size_t i : places) {
    const double at = span > 0 ? (x[i] - begin) / span * last : 0;
    bins[static_cast<std::size_t>(at)].push_back(i);
  }
  std::vector<std::size_t> kept = {places.front(), places.back()};
  const auto by_y = [&y](std::size_t a, std::size_t b) { return y[a] < y[b]; };
  for (const std::vector<std::size_t>& bin : bins) {
    if (bin.empty()) continue;
    const auto [lowest, highest] = std::minmax_element(bin.begin(), bin.end(), by_y);
    kept.insert(kept.end(), {*lowest, *highest, bin[bin.size() / 3], bin[2 * bin.size() / 3]});
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

}  // namespace lyrefit
