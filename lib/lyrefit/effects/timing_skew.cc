#include "lyrefit/effects/catalogue_entries.h"
#include "lyrefit/effects/needs.h"

namespace lyrefit {

Effect TimingSkew() {
  Effect e;
  e.id = "timing_skew";
  e.title = "voltage and current not read together";
  e.finding = "hysteresis";
  e.where = Where::kInstrument;
  e.equation = "V -> V - ts dV/dt";
  e.reference = "iec60904_1 (simultaneous readings)";
  e.sentence = "current and voltage were read one after the other, so that up and down disagree";
  e.needs = "a sweep up and a sweep down with times";
  e.acts = "between the sweeps up and down, where the curve is steep";
  e.confused_with = {"capacitance", "temp_drift"};
  e.separate_by = "two sweep speeds and two irradiances; a resistor in the place of the device";
  e.action = "repeat the sweep five times slower";
  e.parameters = {Parameter("ts", "skew", "from the reading of the current to that of the voltage")
                      .Unit("s")
                      .Between(-0.05, 0.05)
                      .Usual(0.003)
                      .RatePower(-1)};
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    conditions->voltage = conditions->voltage - p[0] * reading.rate;
  };
  e.why_not = NeedsUpDown;
  e.probes = [](const DataTraits&) { return Strengths({0.0005}); };
  return e;
}

}  // namespace lyrefit
