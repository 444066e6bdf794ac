#include "lyrefit/report/thin_marks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lyrefit {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Bin {
  std::size_t lowest = kNone;
  std::size_t highest = kNone;
};

}  // namespace

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
  std::vector<Bin> bins((most - 2) / 2);
  const auto last = static_cast<double>(bins.size() - 1);
  for (const std::size_t i : places) {
    const double at = span > 0 ? (x[i] - begin) / span * static_cast<double>(bins.size()) : 0;
    Bin& bin = bins[static_cast<std::size_t>(std::min(at, last))];
    if (bin.lowest == kNone || y[i] < y[bin.lowest]) bin.lowest = i;
    if (bin.highest == kNone || y[i] > y[bin.highest]) bin.highest = i;
  }
  std::vector<std::size_t> kept = {places.front(), places.back()};
  for (const Bin& bin : bins) {
    if (bin.lowest == kNone) continue;
    kept.push_back(bin.lowest);
    kept.push_back(bin.highest);
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

}  // namespace lyrefit
