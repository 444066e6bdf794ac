#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect SensorOffset() {
  Effect e;
  e.id = "sensor_offset";
  e.title = "offset of the irradiance sensor";
  e.where = Where::kConditions;
  e.equation = "G -> G + c";
  e.reference = "iec60904_10 (linearity)";
  e.sentence = "the irradiance sensor is wrong by the same amount at every level";
  e.needs = "several irradiances";
  e.acts = "short-circuit current against irradiance misses the origin";
  e.confused_with = {"current_offset", "voltage_offset", "sensor_nonlin"};
  e.separate_by = "the sensor covered; a dark curve";
  e.action = "cover the irradiance sensor and zero it";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {"the light is " + SignedSize(of.Of("c"), "W/m2", "more", "less") + " than shown"};
  };
  e.parameters = {Parameter("c", "irradiance_offset", "true minus shown")
                      .Unit("W/m2")
                      .Between(-0.1, 0.1)
                      .Times(1000)};
  e.conditions = [](const auto* p, const auto&, auto* conditions) {
    conditions->irradiance = conditions->irradiance + p[0];
  };
  e.why_not = NeedsIrradiances;
  e.probes = [](const DataTraits&) { return Strengths({0.002}); };
  return e;
}

}  // namespace lyrefit
