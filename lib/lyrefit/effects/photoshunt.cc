#include "lyrefit/effects/catalogue_entries.h"
#include "lyrefit/effects/needs.h"

namespace lyrefit {

Effect Photoshunt() {
  Effect e;
  e.id = "photoshunt";
  e.title = "shunt that grows with light";
  e.where = "device";
  e.equation = "Gsh -> Gsh + Gph G / (1000 W/m2)";
  e.reference = "De Soto, Klein and Beckman 2006 (the limit Gsh = Gph G), "
                "doi:10.1016/j.solener.2005.06.010";
  e.sentence = "the slope at short circuit grows with the light: the shunt conducts better when lit";
  e.needs = "several irradiances, or a dark curve";
  e.acts = "at short circuit, in proportion to light";
  e.confused_with = {"collection"};
  e.separate_by = "a wide range of irradiance with little noise near the knee";
  e.parameters = {{"Gph", "photoconductance", "S", "conductance that 1000 W/m2 adds", 0, 3, 0, false,
                   1, 1, -1}};
  e.cell = [](const auto* p, auto* cell) {
    cell->conductance = cell->conductance + p[0] * cell->irradiance;
  };
  e.why_not = NeedsLightLevels;
  e.probes = [](const DataTraits&) { return Strengths({0.02, 0.3}); };
  return e;
}

}  // namespace lyrefit
