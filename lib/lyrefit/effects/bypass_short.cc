#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect BypassShort() {
  Effect e;
  e.id = "bypass_short";
  e.title = "a shorted bypass diode";
  e.where = Where::kDevice;
  e.equation = "a substring gives no voltage: fewer cells than stated";
  e.reference = "iec62446_3 (Annex C)";
  e.sentence = "a bypass diode leads all current around its substring";
  e.needs = "a curve of a module of known cells, bypass diodes and temperature";
  e.acts = "at open circuit: the share of a substring is missing";
  e.confused_with = {"temperature_or_cells"};
  e.separate_by = "open-circuit voltage in the dark of the junction box, substring by substring";
  e.action = "open the junction box and test the bypass diodes";
  e.fact_sheet = "PVFS 1-15";
  e.is_wiring = true;
  e.found_by = FoundBy::kValues;
  e.why_not = NeedsModule;
  e.prior = {0.01, 0.01, kFaultPrior, {{OfOldAge, 2, kWornPrior}}};
  return e;
}

}  // namespace lyrefit
