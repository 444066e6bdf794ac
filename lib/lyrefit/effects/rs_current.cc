#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect RsCurrent() {
  Effect e;
  e.id = "rs_current";
  e.title = "series resistance that depends on current";
  e.where = Where::kDevice;
  e.equation = "V = Vj - I Rs - Rs1 I |I|";
  e.reference = "fong2013 (series resistance as a function of current)";
  e.sentence = "the series resistance changes with the current";
  e.needs = "little noise near the knee, or several irradiances";
  e.acts = "from the knee to open circuit";
  e.confused_with = {"distributed_rs", "back_contact", "transient"};
  e.separate_by = "curves at several irradiances";
  e.action = "re-torque the connectors, or contact the cell anew, and measure again";
  e.prior = {0.01, 0.01, kCellPrior};
  e.parameters = {Parameter("Rs1", "resistance_per_current", "change of Rs with current")
                      .Unit("ohm/A")
                      .Between(-0.2, 0.2)
                      .Usual(0.01)
                      .CurrentPower(-2)
                      .CellsPower(1)};
  e.series = [](const auto* p, const auto& cell, const auto& current) {
    const auto size = abs(current);
    // Resistance does not fall below 0: where Rs + 2 Rs1 |I| would, the tangent replaces the law.
    const auto most = -0.5 * cell.resistance / p[0];
    const auto drop = (2.0 * size - most) * (p[0] * most);
    const auto beyond = 2.0 * size * p[0] + cell.resistance < 0.0;
    return Choose(beyond, Choose(current < 0.0, -drop, drop), current * size * p[0]);
  };
  e.why_not = NeedsLight;
  e.resistance = true;
  e.probes = [](const DataTraits&) { return Strengths({0.01, -0.005}); };
  return e;
}

}  // namespace lyrefit
