#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect CurrentOffset() {
  Effect e;
  e.id = "current_offset";
  e.title = "offset of the current";
  e.where = Where::kInstrument;
  e.equation = "I -> I + c";
  e.reference = "iec60904_1 (offsets)";
  e.sentence = "the instrument shows a current where none flows";
  e.needs = "a dark curve, or several irradiances";
  e.acts = "everywhere alike";
  e.confused_with = {"sensor_offset", "voltage_offset"};
  e.separate_by = "a reading with open leads; a dark curve; the sensor covered";
  e.action = "zero the current with open leads and measure again";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {"the instrument reads " +
            SignedSize(Scaled(of.Of("c"), 100 / of.readings.scale.current_A), "% of Isc",
                       "too much", "too little")};
  };
  e.parameters = {Parameter("c", "current_offset", "what the instrument adds")
                      .Unit("A")
                      .Between(-0.1, 0.1)
                      .CurrentPower(1)};
  e.instrument = [](const auto* p, const auto&, auto* solved) {
    solved->current = solved->current + p[0];
  };
  e.why_not = NeedsLightLevels;
  e.probes = [](const DataTraits&) { return Strengths({0.001}); };
  return e;
}

}  // namespace lyrefit
