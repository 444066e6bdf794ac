#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect DistributedRs() {
  Effect e;
  e.id = "distributed_rs";
  e.title = "series resistance spread over the cell";
  e.where = Where::kDevice;
  e.equation = "two half cells, I = (F(Va) + F(Vb)) / 2, Vb = Va + R F(Vb) / 2";
  e.reference = "araujo1986 (distributed series resistance)";
  e.sentence =
      "the current from far parts of the cell passes a resistance of its own: a sheet, a "
      "broken finger";
  e.needs = "little noise near the knee, or several irradiances";
  e.acts = "from the knee to open circuit";
  e.confused_with = {"aged_contacts", "rs_current", "back_contact", "transient"};
  e.separate_by = "curves at several irradiances";
  e.action =
      "re-torque the connectors, or contact the cell anew, and measure again; then look for "
      "interrupted fingers in "
      "an electroluminescence image";
  e.prior = {0.02, 0.02, kCellPrior};
  e.parameters = {Parameter("Rlat", "resistance_lateral", "between the halves of the cells")
                      .Unit("ohm")
                      .Between(0, 2)
                      .Usual(0.1)
                      .CurrentPower(-1)
                      .CellsPower(1)};
  e.cell = [](const auto* p, auto* cell) {
    using S = std::decay_t<decltype(p[0])>;
    cell->two_parts = true;
    cell->far_share = S(0.5);
    cell->far_resistance = 0.5 * p[0];
  };
  e.parts = true;
  e.resistance = true;
  e.why_not = NeedsLight;
  e.probes = [](const DataTraits&) { return Strengths({0.02, 0.1}); };
  return e;
}

}  // namespace lyrefit
