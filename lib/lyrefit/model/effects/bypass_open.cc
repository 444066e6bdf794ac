#include <algorithm>

#include "lyrefit/model/effects/catalogue_entries.h"
#include "lyrefit/model/effects/covered.h"
#include "lyrefit/model/effects/needs.h"

namespace lyrefit {

Effect BypassOpen() {
  Effect e;
  e.id = "bypass_open";
  e.title = "an open bypass diode";
  e.where = Where::kDevice;
  e.equation =
      "a substring under light (1 - d) without bypass diode; its cells in reverse "
      "I = ... + Iph (-Vj / A)^m";
  e.reference = "Bishop 1988, doi:10.1016/0379-6787(88)90059-2";
  e.sentence =
      "a substring gets less light and no diode leads the current around it: its cells are driven "
      "into reverse";
  e.needs = "a curve of a module whose substring is shaded";
  e.acts = "between short circuit and the knee";
  e.confused_with = {"mismatch", "weak_cell", "scatter"};
  e.separate_by = "cover one substring after the other: a good diode leaves a step";
  e.action = "open the junction box and test the bypass diodes";
  e.fact_sheet = "PVFS 1-15";
  e.is_wiring = true;
  e.parameters = {
      Parameter("d", "light_deficit", "part of the light that the substring misses")
          .Between(0, 0.999)
          .Scatter(kSubstringScatter),
      Parameter("w", "shaded_share", "part of the cells in it")
          .Between(0.01, 0.99)
          .From(1.0 / 3)
          .Searched()
          .Only(Whole::kSubstrings),
      Parameter("A", "soft_voltage", "at which a cell in reverse carries Iph")
          .Unit("V")
          .Between(0.5, 60)
          .From(3.2)
          .FixedByDefault(),
      Parameter("m", "reverse_exponent", "of the soft reverse law")
          .Between(1, 8)
          .From(3.4)
          .FixedByDefault(),
  };
  e.cell = [](const auto* p, auto* cell) {
    cell->groups = 2;
    cell->group[0] = {1.0 - p[1], 1.0, 0.0, 0};
    cell->group[1] = {p[1], 1.0 - p[0], 0.0, 0};
    cell->reverse = ReverseLaw::kSoft;
    cell->reverse_voltage = p[2];
    cell->reverse_exponent = p[3];
  };
  e.groups = true;
  e.covered = SecondIsShare;
  e.why_not = NeedsBypassedModule;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    const double share = 1.0 / std::max(SubstringsOf(traits), 2);
    for (const double deficit : {0.03, 0.1, 0.4}) probes.push_back({deficit, share, 3.2, 3.4});
    return probes;
  };
  e.starts = [](const CurveShape&, const DataTraits& traits, const auto&) {
    std::vector<ShapeStart> starts;
    const double share = 1.0 / std::max(SubstringsOf(traits), 2);
    for (const double deficit : {0.1, 0.4}) {
      starts.push_back({{deficit, share, 3.2, 3.4}, {2, 3}});
    }
    return starts;
  };
  return e;
}

}  // namespace lyrefit
