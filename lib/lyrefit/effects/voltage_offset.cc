#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect VoltageOffset() {
  Effect e;
  e.id = "voltage_offset";
  e.title = "offset of the voltage";
  e.where = Where::kInstrument;
  e.equation = "V -> V + c";
  e.reference = "iec60904_1 (offsets)";
  e.sentence = "the instrument shows a voltage where there is none";
  e.needs = "a dark curve, or several temperatures";
  e.acts = "where the curve is steep; a dark curve misses the origin";
  e.confused_with = {"current_offset", "bandgap", "temp_offset"};
  e.separate_by =
      "a reading with shorted leads; a dark curve through the origin at high resolution";
  e.action = "zero the voltage with shorted leads and measure again";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {"the instrument reads " +
            SignedSize(Scaled(of.Of("c"), 1e3), "mV", "too much", "too little")};
  };
  e.parameters = {Parameter("c", "voltage_offset", "what the instrument adds, whole device")
                      .Unit("V")
                      .Between(-0.1, 0.1)
                      .CellsPower(1)};
  e.conditions = [](const auto* p, const auto&, auto* conditions) {
    conditions->voltage = conditions->voltage - p[0];
  };
  e.why_not = NeedsLightLevels;
  e.probes = [](const DataTraits&) { return Strengths({0.002}); };
  return e;
}

}  // namespace lyrefit
