#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lyrefit/effects/odd_cells.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

enum { kOpenDeficit, kOpenShare, kOpenSoft, kOpenExponent, kOpenCells, kOpenChains };

// All lanes have the same parameters.
template <class S>
void SetBypassOpen(const S* p, Cell<S>* cell) {
  if (ValueOf(p[kOpenCells])[0] > 0) {
    SetOddCells(p[kOpenCells], p[kOpenDeficit], p[kOpenDeficit] * 0.0, p[kOpenChains], cell);
    cell->substring[0].bypassed = false;
  } else {
    cell->groups = 2;
    cell->group[0] = {1.0 - p[kOpenShare], S(1.0), S(0.0), 0};
    cell->group[1] = {p[kOpenShare], 1.0 - p[kOpenDeficit], S(0.0), 0};
  }
  cell->reverse = ReverseLaw::kSoft;
  cell->reverse_voltage = p[kOpenSoft];
  cell->reverse_exponent = p[kOpenExponent];
}

// In a string of modules a cell breaks down long before it takes the voltage of the string, with or
// without its bypass diode: single cells are tried in modules only.
std::vector<ShapeStart> BypassOpenStarts(const CurveShape& shape, const DataTraits& traits) {
  constexpr int kMostOfAModule = 4;
  const double share = 1.0 / std::max(SubstringsOf(traits), 2);
  const std::vector<int> freed = {kOpenSoft, kOpenExponent};
  std::vector<ShapeStart> starts;
  for (const double deficit : {0.1, 0.4}) {
    starts.push_back({{deficit, share, 3.2, 3.4, 0, 1}, freed});
  }
  const double full = shape.At(0.05);
  if (!(full > 0) || SubstringsOf(traits) > kMostOfAModule) return starts;
  // A single cell: its light from before the knee, or from a tail of the current.
  for (const double place : {0.75, 0.95}) {
    const double deficit = std::clamp(1 - shape.At(place) / full, 0.01, 0.97);
    for (const double chains : {1.0, 2.0}) {
      if (deficit * chains > 0.98) continue;
      for (const auto& [soft, exponent] :
           {std::pair(3.2, 3.4), std::pair(8.0, 3.4), std::pair(15.0, 5.0), std::pair(40.0, 8.0)}) {
        starts.push_back({{deficit, share, soft, exponent, 1, chains}, freed});
      }
    }
  }
  return starts;
}

}  // namespace

Effect BypassOpen() {
  Effect e;
  e.id = "bypass_open";
  e.title = "an open bypass diode";
  e.where = Where::kDevice;
  e.equation =
      "a substring without bypass diode, all or some of its cells under light (1 - d); in reverse "
      "I = ... + Iph (-Vj / A)^m";
  e.reference = "bishop1988";
  e.sentence =
      "a substring, or a cell of it, gets less light and no diode leads the current around it: its "
      "dim cells are driven into reverse";
  e.needs = "a curve of a module whose substring is shaded";
  e.acts = "between short circuit and the knee";
  e.confused_with = {"mismatch", "weak_cell", "scatter"};
  e.separate_by = "cover one substring after the other: a good diode leaves a step";
  e.action = "open the junction box and test the bypass diodes";
  e.fact_sheet = "PVFS 1-15";
  e.is_wiring = true;
  static constexpr char kBesideUnlike[] =
      "an open diode shows only beside cells that give less, and these are rarer than in shade";
  e.prior = {0.003,
             0.006,
             kFaultPrior,
             {{InFlasher, 0.2, kBesideUnlike},
              {ModuleInLaboratory, 0.1, kBesideUnlike},
              {OfOldAge, 2, kWornPrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format("{} under {} of the others' light, and no bypass diode leads around it",
                        PartOfCells(of.readings, of.p[1]), LightLeft(of.p[0], of.Of("d")))};
  };
  e.parameters = {
      Parameter("d", "light_deficit",
                "part of the light that the substring misses, because of its dim cells")
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
      Parameter("cells", "dim_cells", "how many cells of it are dim; 0: all of them")
          .Between(0, 24)
          .FixedByDefault()
          .AbsentAt(0)
          .Only(Whole::kCount),
      kChains,
  };
  e.cell = [](const auto* p, auto* cell) { SetBypassOpen(p, cell); };
  e.groups = true;
  e.why_not = NeedsBypassedModule;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    const double share = 1.0 / std::max(SubstringsOf(traits), 2);
    for (const double deficit : {0.03, 0.1, 0.4}) {
      probes.push_back({deficit, share, 3.2, 3.4, 0, 1});
    }
    return probes;
  };
  e.starts = [](const CurveShape& shape, const DataTraits& traits, const auto&) {
    return BypassOpenStarts(shape, traits);
  };
  return e;
}

}  // namespace lyrefit
