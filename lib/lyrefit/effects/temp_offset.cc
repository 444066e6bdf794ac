#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect TemperatureOffset() {
  Effect e;
  e.id = "temp_offset";
  e.title = "offset of the temperature sensor";
  e.where = Where::kConditions;
  e.equation = "T -> T + c";
  e.reference = "iec60904_5 (equivalent cell temperature)";
  e.sentence = "the cells are warmer or colder than the sensor says, everywhere alike";
  e.needs = "several temperatures";
  e.acts = "open-circuit voltage against temperature";
  e.confused_with = {"bandgap", "voltage_offset", "second_diode"};
  e.separate_by = "a second thermometer on the cell; four temperatures or more";
  e.action = "fix a second thermometer to the back of a cell and compare";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {"the cells are " + SignedSize(of.Of("c"), "K", "warmer", "colder") + " than shown"};
  };
  e.parameters = {
      Parameter("c", "temperature_offset", "true minus shown").Unit("K").Between(-25, 25)};
  e.conditions = [](const auto* p, const auto&, auto* conditions) {
    conditions->temperature_K = conditions->temperature_K + p[0];
  };
  e.why_not = NeedsTemperatures;
  e.probes = [](const DataTraits&) { return Strengths({1}); };
  return e;
}

}  // namespace lyrefit
