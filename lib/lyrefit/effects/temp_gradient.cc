#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect TemperatureGradient() {
  Effect e;
  e.id = "temp_gradient";
  e.title = "cells warmer than the sensor, in proportion to light";
  e.where = Where::kConditions;
  e.equation = "T -> T + c G / (1000 W/m2)";
  e.reference = "king2004 (back-of-module to cell difference)";
  e.sentence = "the light heats the cells above the place where the temperature is read";
  e.needs = "several irradiances, or a dark curve";
  e.acts = "open-circuit voltage at high irradiance";
  e.confused_with = {"second_diode", "back_contact", "bandgap"};
  e.separate_by = "flashes of different length; a thermometer on the cell; a dark curve";
  e.action = "fix a thermometer to the back of a cell in the middle of the module";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {"the cells are " + SignedSize(of.Of("c"), "K", "warmer", "colder") +
            " than shown at 1000 W/m2"};
  };
  e.parameters = {
      Parameter("c", "temperature_gradient", "warmer at 1000 W/m2").Unit("K").Between(-5, 25)};
  e.conditions = [](const auto* p, const auto&, auto* conditions) {
    conditions->temperature_K = conditions->temperature_K + p[0] * conditions->irradiance;
  };
  e.why_not = NeedsLightLevels;
  e.probes = [](const DataTraits&) { return Strengths({0.5}); };
  return e;
}

}  // namespace lyrefit
