#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect VoltageBins() {
  Effect e;
  e.id = "voltage_bins";
  e.title = "voltages in coarse bins";
  e.where = Where::kInstrument;
  e.equation = "V -> b round(V / b)";
  e.reference = "iec60904_1 (resolution)";
  e.sentence = "the voltage is rounded so coarsely that the steep part of the curve is blurred";
  e.needs = "any curve whose voltages were read, not set; the values themselves give it away";
  e.acts = "where the curve is steep: a bin times the slope";
  e.confused_with = {"quantisation"};
  e.separate_by = "a smaller range of the voltage or a finer instrument";
  e.action = "repeat the sweep in a smaller range of the voltage";
  e.prior.factors = {{InInverter, 0, kRegistersPrior}};
  e.found_by = FoundBy::kValues;
  e.why_not = [](const DataTraits&) -> WhyNot { return {}; };
  return e;
}

}  // namespace lyrefit
