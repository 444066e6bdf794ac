#include <cmath>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect NonohmicShunt() {
  Effect e;
  e.id = "nonohmic_shunt";
  e.title = "non-ohmic shunt";
  e.where = Where::kDevice;
  e.equation = "I = ... - k sign(Vj) |Vj|^m";
  e.reference = "dongaonkar2010 (space-charge-limited shunts)";
  e.sentence = "a local defect leaks more than in proportion to the voltage, in light and in dark";
  e.needs = "points in reverse or a dark curve; on a lit sweep alone it looks like collection";
  e.acts = "where |V| is large, also in reverse";
  e.confused_with = {"collection", "breakdown", "second_diode"};
  e.separate_by = "a dark curve or points in reverse bias: this part does not scale with light";
  e.action = "take a dark curve, then look at the module with a thermal camera for a leaking spot";
  e.prior = {0.03,
             0.0003,
             "not rare in cells; in all cells of a module alike: thin films",
             {{OfThinFilm, 30, "non-ohmic shunts are in every thin film (dongaonkar2010)"}}};
  // Internal units: the strength is the current at the largest voltage of the readings.
  e.parameters = {
      Parameter("k", "shunt_strength", "current at 1 V of a cell")
          .Unit("A/V^m")
          .Between(0, 3)
          .Usual(0.05)
          .CurrentPower(1)
          .Convert([](const double* p, const ReadingScale& scale) {
            return std::pow(scale.reach_V, -p[1]);
          }),
      Parameter("m", "shunt_exponent", "exponent").Between(1.3, 5).From(2),
  };
  e.junction = [](const auto* p, const auto& cell, const auto&, const auto& voltage) {
    const auto size = abs(voltage) * (1.0 / cell.reach) + 1e-9;
    const auto current = p[0] * exp(p[1] * log(size));
    return Choose(voltage < 0.0, current, -current);
  };
  e.why_not = [](const DataTraits&) -> WhyNot { return {}; };
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.02, 1.5}, {0.02, 2}, {0.02, 3}, {0.02, 4.5}};
  };
  return e;
}

}  // namespace lyrefit
