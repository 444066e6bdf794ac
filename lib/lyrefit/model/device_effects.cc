#include "lyrefit/model/device_effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/model/effect_ranges.h"
#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/make_readings.h"

namespace lyrefit {
namespace {

// Readings of one curve at its own temperature. Irradiances are relative to their mean, so
// parameters are those at the curve's own conditions.
Expected<Readings> ReadingsOf(const IvCurve& curve) {
  auto readings = SetReadings(SetOfOne(curve), curve.conditions.cell_temperature_K);
  if (!readings) return readings;
  double light = 0;
  for (const Reading& r : readings->points) light += r.irradiance;
  light /= static_cast<double>(readings->points.size());
  for (Reading& r : readings->points) r.irradiance = light > 0 ? r.irradiance / light : 1;
  return readings;
}

Expected<void> CheckTogether(const std::vector<EffectUse>& uses, int base_size) {
  int size = base_size;
  for (std::size_t a = 0; a < uses.size(); ++a) {
    size += uses[a].effect->size();
    for (std::size_t b = 0; b < a; ++b) {
      if (uses[a].effect == uses[b].effect)
        return tl::unexpected(Unfit(*uses[a].effect, "is there twice"));
      if (Exclude(*uses[a].effect, *uses[b].effect)) {
        return tl::unexpected(
            Unfit(*uses[a].effect, fmt::format("cannot stand beside {}: each divides the cells in "
                                               "its own way",
                                               uses[b].effect->id)));
      }
    }
  }
  if (size > kMostParameters) {
    return Fail(fmt::format("{} parameters are too many for one law, expected {} at most", size,
                            kMostParameters));
  }
  return {};
}

// Error if the lower bounds of an effect's cell shares (parameters named share...) sum to 1 or
// more.
Expected<void> CheckShares(const DeviceEffects& device_effects) {
  int at = 0;
  for (const EffectUse& use : device_effects.uses) {
    double least = 0;
    for (const EffectParameter& info : use.effect->parameters) {
      const bool share = std::string(info.name).find("share") != std::string::npos;
      if (share) least += device_effects.bounds[at].lower;
      ++at;
    }
    if (least > 1 - 1e-9) {
      return tl::unexpected(Unfit(*use.effect, fmt::format("shares of {:g} in all leave no cell "
                                                           "for the rest, expected less than 1",
                                                           least)));
    }
  }
  return {};
}

Expected<void> CheckLayout(const StringLayout& layout, const Conditions& conditions,
                           const std::vector<EffectUse>& uses) {
  if (layout.cells_in_series != conditions.cells_in_series) {
    return Fail(fmt::format("the strings are laid out of {} cells in series, the device has {}",
                            layout.cells_in_series, conditions.cells_in_series));
  }
  for (const EffectUse& use : uses) {
    if (!use.effect->groups) continue;
    return tl::unexpected(Unfit(*use.effect, "divides the cells, which are laid out already"));
  }
  return {};
}

}  // namespace

Expected<Device> Extend(const Device& base, Model model, ConstantSet constants,
                        const IvCurve& curve, const std::vector<EffectUse>& uses, bool force,
                        std::shared_ptr<const StringLayout> layout) {
  if (layout != nullptr) {
    TRY(CheckLayout(*layout, curve.conditions, uses));
  }
  TRY(auto readings, ReadingsOf(curve));
  DeviceEffects device_effects;
  device_effects.readings = std::move(readings);
  device_effects.law.model = model;
  device_effects.law.constants = constants;
  device_effects.law.layout = std::move(layout);
  return AddEffects(base, std::move(device_effects), uses, force);
}

bool OneOfSeveral(const DeviceEffects& device_effects, int k) {
  int first = 0;
  for (const EffectUse& use : device_effects.uses) {
    const auto bounds = device_effects.bounds.begin() + first;
    const int size = use.effect->size();
    first += size;
    if (k >= first) continue;
    return std::count_if(bounds, bounds + size,
                         [](const ParameterBounds& b) { return b.lower < b.upper; }) > 1;
  }
  return false;
}

Expected<Device> AddEffects(const Device& base, DeviceEffects device_effects,
                            const std::vector<EffectUse>& uses, bool force) {
  TRY(CheckTogether(uses, base.size()));
  device_effects.blocks = BlocksOf(device_effects.readings);
  device_effects.uses = uses;
  for (const EffectUse& use : uses) {
    const Effect& effect = *use.effect;
    if (effect.parameters.empty()) {
      return tl::unexpected(
          Unfit(effect, "has no parameters: it is found in the values, not fitted"));
    }
    const auto why_not = effect.WhyNot(device_effects.readings.traits);
    if (why_not && !force) {
      return tl::unexpected(Unfit(effect, *why_not + " (--force fits it all the same)"));
    }
    device_effects.law.effects.push_back(&effect);
    TRY(AddUse(use, &device_effects));
  }
  TRY(CheckShares(device_effects));
  Device device = base;
  AddInfos(uses, &device.parameters);
  device.effects = std::make_shared<const DeviceEffects>(std::move(device_effects));
  return device;
}

void AddInfos(const std::vector<EffectUse>& uses, std::vector<ParameterInfo>* infos) {
  for (const EffectUse& use : uses) {
    for (const EffectParameter& info : use.effect->parameters) {
      infos->push_back({fmt::format("{}.{}", use.effect->id, info.symbol),
                        fmt::format("{}_{}", use.effect->id, info.name), info.unit, info.doc,
                        ParameterKind::kPlain, 0.1 * (info.upper - info.lower)});
    }
  }
}

std::vector<std::vector<double>> EffectStarts(const DeviceEffects& device_effects) {
  const int base = device_effects.law.base_size();
  std::vector<std::vector<double>> probes = {device_effects.usual};
  for (std::size_t e = 0; e < device_effects.uses.size(); ++e) {
    const Effect& effect = *device_effects.uses[e].effect;
    if (effect.probes == nullptr) continue;
    const int first = device_effects.law.Offset(static_cast<int>(e)) - base;
    for (const Probe& probe : effect.probes(device_effects.readings.traits)) {
      std::vector<double> p = device_effects.usual;
      for (int k = 0; k < effect.size(); ++k) {
        const ParameterBounds& bounds = device_effects.bounds[first + k];
        p[first + k] = std::min(std::max(probe[k], bounds.lower), bounds.upper);
      }
      probes.push_back(p);
    }
  }
  return probes;
}

namespace {

bool InAmpere(const Law& law, const Readings& readings, const std::vector<ReadingBlock>& blocks,
              const double* p, double* current_A, double* jacobian, const std::vector<char>* fixed,
              LawWorkspace* kept) {
  LawWorkspace fresh(blocks);
  if (kept == nullptr) kept = &fresh;
  if (!EvaluateLaw(law, readings, p, kept, current_A, jacobian, fixed)) return false;
  const std::size_t count = readings.points.size();
  for (std::size_t k = 0; k < count; ++k) current_A[k] *= readings.scale.current_A;
  for (std::size_t k = 0; jacobian != nullptr && k < count * law.size(); ++k) {
    jacobian[k] *= readings.scale.current_A;
  }
  return true;
}

// Readings of the same measurement at other voltages.
Readings AtVoltages(const Readings& readings, const std::vector<double>& voltage_V) {
  Readings other = readings;
  const Reading usual = readings.points.front();
  double light = 0;
  for (const Reading& r : readings.points) light += r.irradiance;
  light /= static_cast<double>(readings.points.size());
  const int count = static_cast<int>(voltage_V.size());
  other.points.assign(count, usual);
  for (int k = 0; k < count; ++k) {
    Reading& r = other.points[k];
    r.voltage = voltage_V[k] / readings.scale.cells;
    r.irradiance = light;
    r.x = count > 1 ? static_cast<double>(k) / (count - 1) - 0.5 : 0;
    const bool rises = k > 0 ? voltage_V[k] >= voltage_V[k - 1] : true;
    r.rate = rises ? 1 : -1;
    r.current = 0;
  }
  return other;
}

}  // namespace

bool ExtendedCurrents(const Device& device, const double* p, double* current_A, double* jacobian,
                      const std::vector<char>* fixed, LawWorkspace* kept) {
  const DeviceEffects& device_effects = *device.effects;
  return InAmpere(device_effects.law, device_effects.readings, device_effects.blocks, p, current_A,
                  jacobian, fixed, kept);
}

std::vector<double> ExtendedCurrents(const Device& device, const double* p,
                                     const std::vector<double>& voltage_V) {
  const DeviceEffects& device_effects = *device.effects;
  const Readings readings = AtVoltages(device_effects.readings, voltage_V);
  std::vector<double> current_A(voltage_V.size());
  if (!InAmpere(device_effects.law, readings, BlocksOf(readings), p, current_A.data(), nullptr,
                nullptr, nullptr)) {
    std::fill(current_A.begin(), current_A.end(), kUnknown);
  }
  return current_A;
}

}  // namespace lyrefit
