#include <fmt/format.h>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Mismatch() {
  Effect e;
  e.id = "mismatch";
  e.title = "unequal cells in series";
  e.where = Where::kDevice;
  e.equation = "V = (1 - w) Vcell(I; Iph) + w Vcell(I; (1 - d) Iph), per cell, no bypass conducts";
  e.reference = "bishop1988";
  e.sentence = "some cells deliver less current than the others, and no bypass diode helps";
  e.needs = "a curve of a module";
  e.acts = "between short circuit and the knee";
  e.confused_with = {"shading", "transient", "nonohmic_shunt"};
  e.separate_by = "cover one cell after the other, or an electroluminescence image";
  e.action = "take an electroluminescence image and look for the dark cells";
  e.prior = {0.02, 0.02, kFaultPrior};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format("{:.3g} cells deliver {} less than the others",
                        of.p[1] * of.readings.traits.cells, PercentWithRange(of.Of("d"), 1))};
  };
  e.parameters = {
      Parameter("d", "current_deficit", "part of the current that the weaker cells miss")
          .Between(0, 0.9),
      Parameter("w", "weaker_share", "part of the cells that is weaker")
          .Between(0.005, 0.95)
          .From(0.3),
  };
  e.cell = [](const auto* p, auto* cell) {
    cell->groups = 2;
    cell->group[0] = {1.0 - p[1], 1.0, 0.0, 0};
    cell->group[1] = {p[1], 1.0 - p[0], 0.0, 0};
  };
  e.groups = true;
  e.why_not = NeedsModule;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    for (const double share : {1.0 / traits.cells, 0.1, 0.3, 0.6}) {
      for (const double deficit : {0.01, 0.03, 0.06, 0.12}) probes.push_back({deficit, share});
    }
    return probes;
  };
  return e;
}

}  // namespace lyrefit
