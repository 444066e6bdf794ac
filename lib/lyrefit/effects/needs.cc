#include "lyrefit/effects/needs.h"

#include <string_view>

#include "lyrefit/curve/technology.h"

namespace lyrefit {

WhyNot NeedsLight(const DataTraits& traits) {
  if (traits.only_dark) return "needs a lit curve";
  return {};
}

WhyNot NeedsOneLitCondition(const DataTraits& traits) {
  if (auto why = NeedsLight(traits)) return why;
  if (!traits.single) return "acts during one sweep; each curve of a set has its own";
  return {};
}

WhyNot NeedsModule(const DataTraits& traits) {
  if (auto why = NeedsOneLitCondition(traits)) return why;
  if (!traits.module) return "needs cells in series";
  return {};
}

WhyNot NeedsManyCells(const DataTraits& traits) {
  constexpr int kLeast = 6;
  if (auto why = NeedsModule(traits)) return why;
  if (traits.cells < kLeast) return "needs six cells in series or more";
  return {};
}

WhyNot NeedsBypassedModule(const DataTraits& traits) {
  const bool stated = traits.bypass_known && traits.substrings > 0;
  if (auto why = stated ? NeedsModule(traits) : NeedsManyCells(traits)) return why;
  if (traits.lowest_voltage < -1) {
    return "bypass diodes let no module so far into reverse: these cells have none";
  }
  return {};
}

WhyNot NeedsBypassDiodes(const DataTraits& traits) {
  if (auto why = NeedsModule(traits)) return why;
  if (traits.bypass_known && traits.substrings == 0) return "needs bypass diodes";
  return {};
}

WhyNot NeedsUpDown(const DataTraits& traits) {
  if (!traits.up_down) return "needs a sweep up and a sweep down";
  return {};
}

WhyNot NeedsLightLevels(const DataTraits& traits) {
  if (traits.dark || traits.irradiance_levels > 1) return {};
  return "needs a second level of light, or a dark curve";
}

WhyNot NeedsIrradiances(const DataTraits& traits) {
  if (traits.irradiance_levels < 2) return "needs curves under several irradiances";
  return {};
}

WhyNot NeedsTemperatures(const DataTraits& traits) {
  if (traits.temperature_levels < 2) return "needs curves at several temperatures";
  return {};
}

bool InFlasher(const Circumstances& at) { return at.setup == Setup::kFlash; }
bool InInverter(const Circumstances& at) { return at.setup == Setup::kInverter; }
bool SlowOutdoors(const Circumstances& at) { return at.setup == Setup::kOutdoor && at.slow; }
bool ModuleInLaboratory(const Circumstances& at) {
  return at.setup == Setup::kLaboratory && at.module;
}
bool AsNew(const Circumstances& at) { return at.age_years && *at.age_years < 1; }
bool OfOldAge(const Circumstances& at) { return at.age_years && *at.age_years > 10; }
bool OfThinFilm(const Circumstances& at) { return at.module && IsThinFilm(at.technology); }
bool Heterojunction(const Circumstances& at) {
  const Technology* const known = FindTechnology(at.technology);
  return known != nullptr && known->name == std::string_view("HJT");
}

std::vector<Probe> Strengths(const std::vector<double>& values) {
  std::vector<Probe> probes;
  probes.reserve(values.size());
  for (const double value : values) probes.push_back({value});
  return probes;
}

}  // namespace lyrefit
