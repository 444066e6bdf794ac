#include <fmt/format.h>

#include "lyrefit/effects/odd_cells.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect LeakyCell() {
  Effect e;
  e.id = "leaky_cell";
  e.title = "a leaky cell";
  e.where = Where::kDevice;
  e.equation = "one cell has a conductance g beside that of the others";
  e.reference = "bishop1988";
  e.sentence = "one cell leaks through its edge or a crack, and delivers less than its neighbours";
  e.needs = "a curve of a module of few cells, or a strong leak";
  e.acts = "before the knee";
  e.confused_with = {"weak_cell", "mismatch", "nonohmic_shunt"};
  e.separate_by = "a second irradiance: a leak does not follow the light; a thermal image";
  e.action =
      "look at the module with a thermal camera: the leaking cell is warmer or colder than the "
      "others";
  e.prior = {0.01, 0.01, kFaultPrior};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    const double* p = of.p;
    const std::string each = p[1] > 1.5 ? fmt::format("each of {:.0f} cells", p[1]) : "the cell";
    return {fmt::format("at 0.5 V {} loses {:.2g} % of Isc", each, 100 * (0.5 * p[0]))};
  };
  e.parameters = {
      Parameter("g", "leak", "conductance of the cell beside that of the others")
          .Unit("S")
          .Between(0, 50)
          .CurrentPower(1),
      Parameter("cells", "leaky_cells", "how many they are, all in one substring")
          .Between(1, 24)
          .From(1)
          .FixedByDefault()
          .Only(Whole::kCount)
          .BelowUpper(),
      Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
          .Unit("V")
          .Between(0.1, 1.2)
          .From(0.5)
          .FixedByDefault(),
      kChains,
  };
  e.cell = [](const auto* p, auto* cell) {
    SetOddCells(p[1], p[0] * 0.0, p[0], p[3], cell);
    cell->bypass = p[2];
  };
  e.groups = true;
  e.why_not = NeedsBypassedModule;
  e.probes = [](const DataTraits&) {
    std::vector<Probe> probes;
    for (const double leak : {0.1, 0.3, 1.0, 3.0}) probes.push_back({leak, 1, 0.5, 1});
    return probes;
  };
  e.starts = [](const CurveShape&, const DataTraits&, const auto&) {
    std::vector<ShapeStart> starts;
    for (const double leak : {0.2, 1.0}) {
      starts.push_back({{leak, 1, 0.5, 1}, {}});
      starts.push_back({{leak, 2, 0.5, 1}, {1}});
      starts.push_back({{leak, 1, 0.5, 2}, {}});
    }
    return starts;
  };
  return e;
}

}  // namespace lyrefit
