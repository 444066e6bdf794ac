#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect SecondDiode() {
  Effect e;
  e.id = "second_diode";
  e.title = "second diode (recombination)";
  e.where = Where::kDevice;
  e.equation = "I = ... - Is2 (exp(Vj / 2 Vt) - 1)";
  e.reference = "sah1957";
  e.sentence = "carriers recombine in the junction itself, which softens the knee";
  e.needs = "any curve with little noise; a dark curve shows it far better";
  e.acts = "below the maximum power point";
  e.confused_with = {"nonohmic_shunt", "temp_gradient", "collection"};
  e.separate_by = "a dark curve, or curves at low irradiance";
  e.action = "compare n with the data sheet or an earlier sweep: recombination grows as cells age";
  e.prior = {0.05, 0.02, kCellPrior};
  e.parameters = {
      Parameter("Is2", "saturation_current_2", "saturation current of the diode with n = 2")
          .Unit("A")
          .Between(0, 3)
          .Usual(0.1)
          .CurrentPower(1)
          .Convert(
              [](const double*, const ReadingScale& scale) { return scale.saturation_2_unit; })};
  e.cell = [](const auto* p, auto* cell) {
    cell->diode[cell->diodes++] = {p[0] * cell->saturation_2_unit, 0.5 / cell->thermal_voltage};
  };
  e.diode = 2;
  e.why_not = [](const DataTraits&) -> WhyNot { return {}; };
  e.probes = [](const DataTraits&) { return Strengths({0.02, 0.2}); };
  return e;
}

}  // namespace lyrefit
