#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect UnknownStructure() {
  Effect e;
  e.id = "unknown_structure";
  e.title = "something that no known cause explains";
  e.where = Where::kNowhere;
  e.equation = "residuals that are not noise";
  e.reference = "";
  e.sentence = "the model misses in a systematic way, and no cause of the catalogue explains how";
  e.needs = "any curve";
  e.acts = "see the residuals";
  e.confused_with = {};
  e.separate_by = "repeat the measurement, up and down, and compare the residuals";
  e.action = "repeat the sweep, up and down, and look at the module with a thermal camera";
  e.found_by = FoundBy::kWaves;
  e.why_not = [](const DataTraits&) -> WhyNot { return {}; };
  return e;
}

}  // namespace lyrefit
