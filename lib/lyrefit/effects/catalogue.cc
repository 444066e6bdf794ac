#include "lyrefit/effects/catalogue.h"

#include "lyrefit/base/setting_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

const std::vector<Effect>& Entries() {
#define LYREFIT_MAKE_EFFECT(name) name(),
  static const std::vector<Effect> entries = {LYREFIT_EFFECTS(LYREFIT_MAKE_EFFECT)};
#undef LYREFIT_MAKE_EFFECT
  return entries;
}

}  // namespace

const std::vector<const Effect*>& Catalogue() {
  static const std::vector<const Effect*> catalogue = [] {
    std::vector<const Effect*> list;
    for (const Effect& entry : Entries()) list.push_back(&entry);
    return list;
  }();
  return catalogue;
}

std::string GroupOf(const Effect& effect) {
  if (effect.is_wiring) return "wiring";
  return effect.where == Where::kConditions ? "instrument" : ToText(effect.where);
}

const Effect* FindEffect(const std::string& id) {
  for (const Effect* effect : Catalogue()) {
    if (id == effect->id) return effect;
  }
  return nullptr;
}

const std::vector<Inseparable>& InseparableCauses() {
  const auto always = [](const DataTraits&) { return true; };
  const auto one_temperature = [](const DataTraits& t) { return t.temperature_levels < 2; };
  const auto one_light = [](const DataTraits& t) { return t.irradiance_levels < 2 && !t.dark; };
  const auto one_way = [](const DataTraits& t) { return t.single && !t.up_down && !t.only_dark; };
  const auto lit = [](const DataTraits& t) { return !t.only_dark; };
  static const std::vector<Inseparable> causes = {
      {"lead_resistance", "Rs", "resistance of the leads adds to Rs", "four-wire measurement",
       always},
      {"current_gain", "Iph, Is, Rs, Rsh", "a wrong gain of the current scales every current",
       "a second instrument or a calibrated resistor", always},
      {"irradiance_scale", "Iph", "a wrong irradiance, or gain of its sensor, scales Iph",
       "a calibrated reference cell", lit},
      {"temperature", "n, Is", "a wrong temperature is absorbed by n and Is",
       "curves at several temperatures, or a thermometer on the cell", one_temperature},
      {"current_offset", "Iph", "an offset of the current is absorbed by Iph",
       "a dark curve, or a reading with open leads", one_light},
      {"voltage_offset", "Is", "an offset of the voltage is absorbed by Is",
       "a dark curve, or a reading with shorted leads", one_light},
      {"drift", "Rsh", "light that fades during a sweep looks like a lower Rsh",
       "a sweep up and down, or a reference cell beside the module", one_way},
      {"photoshunt", "Rsh", "whether the shunt depends on light shows only at other irradiances",
       "a second irradiance or a dark curve", one_light},
  };
  return causes;
}

Expected<EffectUse> ReadEffectUse(const std::string& text) {
  const std::size_t colon = text.find(':');
  EffectUse use;
  use.effect = FindEffect(text.substr(0, colon));
  if (use.effect == nullptr) {
    return Fail("there is no effect '" + text.substr(0, colon) +
                "'; lyrefit diagnose --explain lists them");
  }
  for (std::size_t at = colon; at != std::string::npos;) {
    const std::size_t next = text.find(',', at + 1);
    const std::string item = text.substr(at + 1, next - at - 1);
    if (item.find(':') != std::string::npos) {
      TRY(const auto range, ReadRange(item));
      use.ranges[range.first] = range.second;
    } else {
      TRY(const auto assignment, ReadAssignment(item));
      use.ranges[assignment.first] = {assignment.second, assignment.second};
    }
    at = next;
  }
  return use;
}

}  // namespace lyrefit
