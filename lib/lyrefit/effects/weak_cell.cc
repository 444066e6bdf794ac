#include <algorithm>

#include "lyrefit/effects/catalogue_entries.h"
#include "lyrefit/effects/needs.h"
#include "lyrefit/effects/odd_cells.h"

namespace lyrefit {
namespace {

enum { kDeficit, kCells, kLeak, kBypass, kFactor, kBreakdown, kExponent, kSoft, kSideBySide };

std::vector<EffectParameter> WeakCellParameters() {
  return {
      Parameter("d", "light_deficit",
                "part of the substring's light that is missing because of them: in half-cut "
                "modules half of what the cells themselves miss, at most 0.5")
          .Between(0, 0.999)
          .Scatter(kCellScatter),
      Parameter("cells", "weak_cells", "how many they are, all in one substring")
          .Between(1, 24)
          .From(1)
          .FixedByDefault()
          .Only(Whole::kCount),
      Parameter("g", "leak", "conductance of each beside that of the others")
          .Unit("S")
          .Between(0, 5)
          .CurrentPower(1)
          .FixedByDefault(),
      Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
          .Unit("V")
          .Between(0.1, 1.2)
          .From(0.5)
          .FixedByDefault(),
      Parameter("a", "breakdown_factor", "of reverse breakdown")
          .Between(0, 10)
          .From(0.1)
          .FixedByDefault(),
      // At its upper bound (no breakdown), or with an exponent near 1, the law describes a leak.
      Parameter("Vbr", "breakdown_voltage", "of a cell, its size")
          .Unit("V")
          .Between(3, 60)
          .From(15)
          .FixedByDefault()
          .BelowUpper(),
      Parameter("m", "breakdown_exponent", "of reverse breakdown")
          .Between(1.5, 8)
          .From(3.4)
          .FixedByDefault()
          .AboveLower(),
      Parameter("A", "soft_voltage", "at which a cell in reverse carries Iph; 0: Bishop's law")
          .Unit("V")
          .Between(0, 30)
          .FixedByDefault()
          .AbsentAt(0),
      kChains,
  };
}

// `asked`: the fit was requested by name, which adds starts.
std::vector<ShapeStart> WeakCellStarts(const CurveShape& shape, bool asked) {
  std::vector<ShapeStart> starts;
  // Cells that hardly conduct in reverse form a separate local optimum.
  std::vector<double> soft = {3.2};
  if (asked) soft.push_back(10);
  const double full = shape.At(0.05);
  if (!(full > 0)) return starts;
  std::vector<double> deficits = {0.06, 0.2, 0.45, 0.75};
  // Light from a plateau before the knee, or from a tail towards Voc if the cell conducts in
  // reverse.
  for (const double place : {0.75, 0.95}) {
    deficits.push_back(std::clamp(1 - shape.At(place) / full, 0.01, 0.97));
  }
  for (const double deficit : deficits) {
    for (const double chains : {1.0, 2.0}) {
      if (deficit * chains > 0.97) continue;
      for (const double voltage : soft) {
        starts.push_back(
            {{deficit, 1, 0, 0.5, 0.1, 15, 3.4, voltage, chains}, {kBypass, kExponent, kSoft}});
      }
      starts.push_back(
          {{deficit, 1, 0, 0.5, 0.1, 15, 3.4, 0, chains}, {kBypass, kFactor, kBreakdown}});
      starts.push_back({{deficit, 1, 0, 0.5, 0, 15, 3.4, 0, chains}, {kBypass}});
    }
  }
  return starts;
}

}  // namespace

Effect WeakCell() {
  Effect e;
  e.id = "weak_cell";
  e.title = "weak cells";
  e.where = Where::kDevice;
  e.equation =
      "one or a few cells of a substring under light (1 - d), with a conductance g of their own; "
      "in reverse I = ... - Gsh a Vj (1 + Vj / Vbr)^-m, or ... + Iph (-Vj / A)^m";
  e.reference = "bishop1988";
  e.sentence = "a cell delivers less than its neighbours and is driven into reverse: a hot spot";
  e.needs = "a curve of a module whose weak cell conducts in reverse before its bypass diode does";
  e.acts = "between short circuit and the knee";
  e.confused_with = {"mismatch", "shading", "nonohmic_shunt"};
  e.separate_by = "cover one cell after the other, or a thermal image under load";
  e.action = "look at the module with a thermal camera: one cell is covered, dark or broken";
  e.fact_sheet = "PVFS 1-19";
  e.parameters = WeakCellParameters();
  e.cell = [](const auto* p, auto* cell) {
    SetOddCells(p[kCells], p[kDeficit], p[kLeak], p[kSideBySide], cell);
    cell->bypass = p[3];
    const bool soft = ValueOf(p[kSoft])[0] > 0;  // all lanes have the same parameters
    cell->reverse = soft ? ReverseLaw::kSoft : ReverseLaw::kBishop;
    cell->reverse_strength = p[kFactor];
    cell->reverse_voltage = soft ? p[kSoft] : p[kBreakdown];
    cell->reverse_exponent = p[kExponent];
  };
  e.groups = true;
  e.why_not = NeedsBypassedModule;
  e.probes = [](const DataTraits&) {
    std::vector<Probe> probes;
    for (const double deficit : {0.05, 0.15, 0.4, 0.8}) {
      probes.push_back({deficit, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1});
    }
    return probes;
  };
  e.starts = [](const CurveShape& shape, const DataTraits&, const auto& asked) {
    return WeakCellStarts(shape, !asked.empty());
  };
  return e;
}

}  // namespace lyrefit
