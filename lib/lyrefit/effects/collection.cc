#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Collection() {
  Effect e;
  e.id = "collection";
  e.title = "voltage-dependent collection";
  e.where = Where::kDevice;
  e.equation = "I = ... - Iph chi / (Vbi - Vj),  Vbi = 0.9 V a junction";
  e.reference = "merten1998; mermoud2010";
  e.sentence = "the weaker the field in the cell, the more of the light's current is lost";
  e.needs = "several irradiances or a dark curve; on one lit sweep it looks like a shunt";
  e.acts = "between short circuit and the knee, in proportion to light";
  e.confused_with = {"nonohmic_shunt", "photoshunt", "second_diode"};
  e.separate_by = "a dark curve (this part scales with light) or a wide range of irradiance";
  e.action =
      "take a dark curve or a second irradiance: it belongs to the cells, and nothing repairs it";
  e.prior = {0.02, 0.005, kCellPrior};
  e.parameters = {Parameter("chi", "d2mutau", "loss parameter of a cell")
                      .Unit("V")
                      .Between(0, 0.3)
                      .Usual(0.02)};
  e.junction = [](const auto* p, const auto&, const auto& photocurrent, const auto& voltage) {
    constexpr double kBuiltIn = 0.9;
    constexpr double kClosest = 0.03;  // closer to it the tangent replaces the pole
    const auto gap = kBuiltIn - voltage;
    const auto within = Larger(gap, kClosest);
    return -(1.0 / within + (within - gap) * (1 / (kClosest * kClosest))) * (photocurrent * p[0]);
  };
  e.why_not = NeedsLight;
  e.probes = [](const DataTraits&) { return Strengths({0.005, 0.05}); };
  return e;
}

}  // namespace lyrefit
