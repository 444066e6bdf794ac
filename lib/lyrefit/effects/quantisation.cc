#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Quantisation() {
  Effect e;
  e.id = "quantisation";
  e.title = "coarse resolution";
  e.where = Where::kInstrument;
  e.equation = "I -> q round(I / q)";
  e.reference = "iec60904_1 (resolution)";
  e.sentence = "the instrument rounds so coarsely that steps show";
  e.needs = "any curve; the values themselves give it away";
  e.acts = "everywhere: values lie on a grid";
  e.confused_with = {};
  e.separate_by = "a smaller range or a finer instrument";
  e.action = "repeat the sweep in a smaller range of the current";
  e.prior.factors = {{InInverter, 0, kRegistersPrior}};
  e.found_by = FoundBy::kValues;
  e.why_not = [](const DataTraits&) -> WhyNot { return {}; };
  return e;
}

}  // namespace lyrefit
