#include <cmath>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Photoshunt() {
  Effect e;
  e.id = "photoshunt";
  e.title = "shunt that grows with light";
  e.where = Where::kDevice;
  e.equation =
      "Gsh -> Gsh + Gph G / (1000 W/m2), or 1 / Gsh exponential in G between the same ends";
  e.reference = "desoto2006 (linear); mermoud2010 (exponential)";
  e.sentence =
      "the slope at short circuit grows with the light: the shunt conducts better when lit";
  e.needs = "several irradiances, or a dark curve";
  e.acts = "at short circuit, in proportion to light";
  e.confused_with = {"collection"};
  e.separate_by = "a wide range of irradiance with little noise near the knee";
  e.action =
      "take a sweep at a fifth of the light: it belongs to the cells, and nothing repairs it";
  e.prior = {0.02, 0.005, kCellPrior};
  e.parameters = {
      Parameter("Gph", "photoconductance", "conductance that 1000 W/m2 adds")
          .Unit("S")
          .Between(0, 3)
          .Usual(0.05)
          .CurrentPower(1)
          .CellsPower(-1),
      Parameter("law", "law", "0 linear, 1 exponential").Between(0, 1).Searched(),
  };
  e.cell = [](const auto* p, auto* cell) {
    const auto linear = cell->conductance + p[0] * cell->irradiance;
    // PVsyst's law, with Rdark = 1 / Gsh: Rsh = base + (Rdark - base) exp(-5.5 g).
    const double fade = std::exp(-5.5);
    const auto dark = 1.0 / (cell->conductance + 1e-6);
    const auto lit = 1.0 / (cell->conductance + p[0] + 1e-6);
    const auto base = (lit - dark * fade) / (1.0 - fade);
    const auto exponential = 1.0 / (base + (dark - base) * exp(-5.5 * cell->irradiance));
    cell->conductance = Choose(ValueOf(p[1]) < 0.5, linear, exponential);
  };
  e.why_not = NeedsLightLevels;
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.02, 0}, {0.3, 0}, {0.02, 1}, {0.3, 1}};
  };
  return e;
}

}  // namespace lyrefit
