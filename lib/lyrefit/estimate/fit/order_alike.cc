#include "lyrefit/estimate/fit/order_alike.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

#include "lyrefit/model/device_effects.h"

namespace lyrefit {
namespace {

bool ConditionsChange(const Device& device) {
  if (device.effects == nullptr) return false;
  const std::vector<const Effect*>& effects = device.effects->law.effects;
  return std::any_of(effects.begin(), effects.end(),
                     [](const Effect* effect) { return static_cast<bool>(effect->conditions); });
}

// Indices of parameters that are exchanged together with those of another set.
using AlikeSet = std::vector<int>;

struct Ordering {
  const std::vector<ParameterBounds>& bounds;
  std::vector<double>* p;
  std::vector<bool>* active;

  // Sorts the sets. `wrong`: whether two neighbours are in the wrong order.
  void Sort(const std::vector<AlikeSet>& sets,
            const std::function<bool(const AlikeSet&, const AlikeSet&)>& wrong) const {
    for (std::size_t pass = 0; pass < sets.size(); ++pass) {
      for (std::size_t k = 0; k + 1 < sets.size(); ++k) {
        if (Same(sets[k], sets[k + 1]) && wrong(sets[k], sets[k + 1])) Swap(sets[k], sets[k + 1]);
      }
    }
  }

  bool Same(const AlikeSet& a, const AlikeSet& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), [this](int i, int j) {
      return bounds[i].lower == bounds[j].lower && bounds[i].upper == bounds[j].upper;
    });
  }

  void Swap(const AlikeSet& a, const AlikeSet& b) const {
    for (std::size_t k = 0; k < a.size(); ++k) {
      std::swap((*p)[a[k]], (*p)[b[k]]);
      if (active == nullptr) continue;
      const bool first = (*active)[a[k]];
      (*active)[a[k]] = (*active)[b[k]];
      (*active)[b[k]] = first;
    }
  }
};

bool IsAbsent(const Effect& effect, const AlikeSet& set, const double* p, int first) {
  return std::any_of(set.begin(), set.end(),
                     [&](int i) { return p[i] == effect.parameters[i - first].absent_at; });
}

}  // namespace

void OrderAlike(const Device& device, const std::vector<ParameterBounds>& bounds,
                std::vector<double>* p, std::vector<bool>* active) {
  const Ordering ordering{bounds, p, active};
  if (!ConditionsChange(device)) {
    std::vector<AlikeSet> diodes;
    diodes.reserve(DiodeCount(device));
    for (int d = 0; d < DiodeCount(device); ++d) {
      diodes.push_back({SaturationCurrentIndex(d), IdealityIndex(d)});
    }
    ordering.Sort(diodes, [p](const AlikeSet& a, const AlikeSet& b) {
      const bool first_gone = (*p)[a[0]] <= 0, second_gone = (*p)[b[0]] <= 0;
      return first_gone != second_gone ? first_gone : (*p)[b[1]] < (*p)[a[1]];
    });
  }
  if (device.effects == nullptr) return;
  int first = device.size();
  for (const Effect* effect : device.effects->law.effects) first -= effect->size();
  for (const Effect* effect : device.effects->law.effects) {
    std::vector<AlikeSet> groups = effect->alike;
    for (AlikeSet& group : groups) {
      for (int& i : group) i += first;
    }
    ordering.Sort(groups, [&](const AlikeSet& a, const AlikeSet& b) {
      const bool gone = IsAbsent(*effect, a, p->data(), first);
      if (gone != IsAbsent(*effect, b, p->data(), first)) return gone;
      return (*p)[b[0]] < (*p)[a[0]];
    });
    first += effect->size();
  }
}

}  // namespace lyrefit
