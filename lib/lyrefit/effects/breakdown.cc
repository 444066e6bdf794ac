#include <cmath>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Breakdown() {
  Effect e;
  e.id = "breakdown";
  e.title = "reverse breakdown";
  e.where = Where::kDevice;
  e.equation = "I = ... - a Vj (1 - Vj / Vbr)^-3.4";
  e.reference = "bishop1988";
  e.sentence = "in reverse the junction begins to break down: a hot spot where a cell is shaded";
  e.needs = "reverse bias beyond about a third of the breakdown voltage";
  e.acts = "at the most negative voltages";
  e.confused_with = {"nonohmic_shunt"};
  e.separate_by = "reverse bias closer to breakdown, or another irradiance";
  e.action = "look at the module with a thermal camera while one cell is shaded";
  e.fact_sheet = "PVFS 1-19";
  e.prior = {0.02, 0.005, kCellPrior};
  // Internal units: current at the most negative reading, and that voltage as a fraction of Vbr.
  e.parameters = {
      Parameter("a", "breakdown_factor", "conductance of a cell at 0 V")
          .Unit("S")
          .Between(0, 3)
          .Usual(0.05)
          .CurrentPower(1)
          .Convert([](const double* p, const ReadingScale& scale) {
            return std::pow(1 - p[1], 3.4) / scale.reach_V;
          }),
      Parameter("Vbr", "breakdown_voltage", "breakdown voltage of a cell")
          .Unit("V")
          .Between(0.15, 0.97)
          .From(0.6)
          .Convert([](const double* p, const ReadingScale& scale) {
            return -scale.reach_V / (p[1] * p[1]);
          }),
  };
  e.junction = [](const auto* p, const auto& cell, const auto&, const auto& voltage) {
    const auto v = voltage * (1.0 / cell.reach);
    const auto open = 1.0 + v * p[1];
    const auto gap = Larger(open, 0.02);
    return -p[0] * v * exp(3.4 * log((1.0 - p[1]) / gap));
  };
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (traits.lowest_voltage < -1.5) return {};
    return "needs reverse bias of some volt per cell";
  };
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.02, 0.25}, {0.02, 0.5}, {0.02, 0.75}, {0.02, 0.92}};
  };
  return e;
}

}  // namespace lyrefit
