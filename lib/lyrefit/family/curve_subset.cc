#include "lyrefit/family/curve_subset.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

struct Place {
  double irradiance;   // ln of the ratio to the reference
  double temperature;  // steps of 25 K
};

Place PlaceOf(const Conditions& at) {
  return {std::log(std::max(at.irradiance_W_m2, 1.0) / kReferenceIrradiance_W_m2),
          (at.cell_temperature_K - kReferenceTemperature_K) / 25};
}

double Distance(const Place& a, const Place& b) {
  return std::hypot(a.irradiance - b.irradiance, a.temperature - b.temperature);
}

}  // namespace

std::vector<int> CurveSubset(const std::vector<Conditions>& conditions,
                             const std::vector<int>& among, int count) {
  if (static_cast<int>(among.size()) <= count) return among;
  if (count < 1) return {};
  std::vector<Place> places;
  places.reserve(among.size());
  for (const int c : among) places.push_back(PlaceOf(conditions[c]));
  std::vector<double> nearest(among.size(), std::numeric_limits<double>::max());
  std::vector<int> taken;
  std::size_t next = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (Distance(places[i], {0, 0}) < Distance(places[next], {0, 0})) next = i;
  }
  while (static_cast<int>(taken.size()) < count) {
    taken.push_back(among[next]);
    nearest[next] = -1;
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (nearest[i] >= 0) nearest[i] = std::min(nearest[i], Distance(places[i], places[next]));
      if (nearest[i] > nearest[farthest]) farthest = i;
    }
    next = farthest;
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

}  // namespace lyrefit
