#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect SensorNonlinearity() {
  Effect e;
  e.id = "sensor_nonlin";
  e.title = "irradiance sensor not linear";
  e.where = Where::kConditions;
  e.equation = "g -> g (1 + c (g - 1)), g = G / (1000 W/m2)";
  e.reference = "iec60904_10 (linearity)";
  e.sentence = "the irradiance sensor is right at 1000 W/m2 and wrong in proportion away from it";
  e.needs = "three irradiances or more";
  e.acts = "short-circuit current against irradiance is bent";
  e.confused_with = {"sensor_offset", "current_offset"};
  e.separate_by = "a second sensor; two-lamp linearity test";
  e.action = "have the irradiance sensor calibrated";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {"the light is " + SignedSize(Scaled(of.Of("c"), 100), "%", "more", "less") +
            " than shown for each 1000 W/m2"};
  };
  e.parameters = {
      Parameter("c", "nonlinearity", "relative error per 1000 W/m2").Between(-0.4, 0.4)};
  e.conditions = [](const auto* p, const auto&, auto* conditions) {
    conditions->irradiance = conditions->irradiance * (1.0 + p[0] * (conditions->irradiance - 1.0));
  };
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (traits.irradiance_levels > 2) return {};
    return "needs curves under three irradiances or more";
  };
  e.probes = [](const DataTraits&) { return Strengths({0.005}); };
  return e;
}

}  // namespace lyrefit
