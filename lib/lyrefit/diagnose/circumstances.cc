#include "lyrefit/diagnose/circumstances.h"

#include <map>

#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

// Effects of unlike cells, as a flasher shows them.
std::map<const Effect*, Effect> MakeUnlikeCells() {
  std::map<const Effect*, Effect> all;
  const auto add = [&](const char* id) -> Effect& {
    const Effect* const usual = FindEffect(id);
    Effect& own = all.emplace(usual, *usual).first->second;
    own.action =
        "take an electroluminescence image and look for cracked, inactive or degraded cells; check "
        "that the lamp lights the module evenly";
    own.separate_by =
        "flash the module turned end for end: what the lamp does stays, what the cells do turns "
        "with them; an electroluminescence image; of a bifacial module the other face, since "
        "polarisation (PID-p) is of one";
    return own;
  };
  for (const char* id : {"weak_cell", "mismatch", "scatter"}) add(id);
  add("dim_cells").title = "cells that each give another current";
  for (const char* id : {"shading", "substrings", "covered_edge"}) {
    Effect& own = add(id);
    own.finding = "weak_cell";
    own.title = "substrings that give unlike currents";
    own.sentence =
        "cells of a substring give less current than the others, and its bypass diode conducts";
    own.fact_sheet = "PVFS 1-19";
  }
  Effect& every = all.at(FindEffect("covered_edge"));
  every.title = "cells of every substring that give less";
  every.sentence = "cells of every substring give less current than the others";
  return all;
}

}  // namespace

JudgedSetup SetupOf(const CurveSet& set, const DiagnoseOptions& options) {
  JudgedSetup judged{options.setup, "stated", "--setup"};
  if (judged.setup != Setup::kUnknown) return judged;
  if (set.curves.empty()) return {};
  const IvCurve& curve = set.curves.front();
  judged = {curve.notes.setup, "file", curve.stated_in.setup};
  if (judged.setup == Setup::kUnknown && IsFlash(curve)) {
    judged = {Setup::kFlash, "file", "its times, with the light of each reading"};
  }
  // Simulators of single cells burn steadily; those of modules flash.
  if (judged.setup == Setup::kFlash && curve.cells_known && curve.conditions.cells_in_series == 1 &&
      !IsFlash(curve)) {
    judged.setup = Setup::kLaboratory;
  }
  if (judged.setup == Setup::kUnknown) judged = {};
  return judged;
}

Circumstances CircumstancesOf(const Readings& readings, const std::string& technology,
                              const DiagnoseOptions& options) {
  constexpr double kSlow_s = 0.5;
  return {readings.traits.setup, readings.traits.module,
          readings.scale.times && readings.scale.span_s >= kSlow_s, technology, options.age_years};
}

const Effect* InWordsOf(Setup setup, const Effect* effect) {
  if (setup != Setup::kFlash) return effect;
  static const std::map<const Effect*, Effect> unlike = MakeUnlikeCells();
  const auto own = unlike.find(effect);
  return own != unlike.end() ? &own->second : effect;
}

}  // namespace lyrefit
