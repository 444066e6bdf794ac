#include "lyrefit/fit/diode_order.h"

#include <algorithm>
#include <utility>

#include "lyrefit/law/extension.h"

namespace lyrefit {

namespace {

bool SkyChanges(const Device& device) {
  if (device.extension == nullptr) return false;
  const std::vector<const Effect*>& effects = device.extension->law.effects;
  return std::any_of(effects.begin(), effects.end(),
                     [](const Effect* effect) { return static_cast<bool>(effect->sky); });
}

}  // namespace

void OrderDiodes(const Device& device, const std::vector<ParameterBounds>& bounds,
                 std::vector<double>* p, std::vector<bool>* held) {
  if (SkyChanges(device)) return;
  const int diodes = DiodeCount(device);
  const auto same = [&](int a, int b) {
    return bounds[a].lower == bounds[b].lower && bounds[a].upper == bounds[b].upper;
  };
  for (int pass = 0; pass < diodes; ++pass) {
    for (int d = 0; d + 1 < diodes; ++d) {
      const int is = SaturationCurrentIndex(d), next_is = SaturationCurrentIndex(d + 1);
      const int n = IdealityIndex(d), next_n = IdealityIndex(d + 1);
      if (!same(is, next_is) || !same(n, next_n)) continue;
      const bool first_gone = (*p)[is] <= 0, second_gone = (*p)[next_is] <= 0;
      const bool swap = first_gone != second_gone ? first_gone : (*p)[next_n] < (*p)[n];
      if (!swap) continue;
      for (const auto& [a, b] : {std::pair(is, next_is), std::pair(n, next_n)}) {
        std::swap((*p)[a], (*p)[b]);
        if (held == nullptr) continue;
        const bool first = (*held)[a];
        (*held)[a] = (*held)[b];
        (*held)[b] = first;
      }
    }
  }
}

}  // namespace lyrefit
