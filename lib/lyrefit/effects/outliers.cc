#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Outliers() {
  Effect e;
  e.id = "outliers";
  e.title = "single wrong readings";
  e.where = Where::kInstrument;
  e.equation = "one reading is wrong by itself";
  e.reference = "grubbs1969";
  e.sentence = "single readings lie far off: a glitch of the instrument";
  e.needs = "any curve";
  e.acts = "at single readings";
  e.confused_with = {"transient"};
  e.separate_by = "repeat the sweep";
  e.action = "repeat the sweep";
  e.found_by = FoundBy::kSingleReading;
  e.why_not = [](const DataTraits&) -> WhyNot { return {}; };
  return e;
}

}  // namespace lyrefit
