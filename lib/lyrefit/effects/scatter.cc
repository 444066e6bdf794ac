#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lyrefit/base/distributions.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

// Cell groups of the effect: more take longer and change little.
constexpr int kScatterGroups = 8;
// Substrings whose dimmest cell has a light of its own.
constexpr int kScatterOwn = 3;

enum {
  kScatterWidth,
  kScatterSoft,
  kScatterExponent,
  kScatterLopsided,
  kScatterDimmest,  // of the first substring; those of the others follow
  kScatterBypass = kScatterDimmest + kScatterOwn
};

// The dimmest cells, one group each, and all others as one group. Their lights are the mean order
// statistics of a distribution (Blom 1958), as deviations from the mean in standard deviations. The
// distribution is normal, or lopsided: an exponential one with most cells a little above the mean
// and few far below it.
struct Dimmest {
  int count = 0;
  std::array<double, kScatterGroups> normal{}, lopsided{};
  double normal_rest = 0, lopsided_rest = 0;
};
Dimmest DimmestOf(int cells, int most) {
  Dimmest dimmest;
  dimmest.count = std::clamp(cells / 2, 0, most);
  for (int k = 0; k < dimmest.count; ++k) {
    const double below = (k + 0.625) / (cells + 0.25);
    dimmest.normal[k] = -NormalAbove(below);
    dimmest.lopsided[k] = 1 + std::log(below);
    dimmest.normal_rest -= dimmest.normal[k] / (cells - dimmest.count);
    dimmest.lopsided_rest -= dimmest.lopsided[k] / (cells - dimmest.count);
  }
  return dimmest;
}

// Distributes the dimmest cells over the substrings in turn. The last substring is never in
// reverse.
template <class S>
void SetScatter(const S* p, Cell<S>* cell) {
  const int cells = static_cast<int>(std::lround(cell->cells));
  const int substrings = std::clamp(static_cast<int>(std::lround(cells / cell->substring_cells)), 1,
                                    kScatterGroups / 2);
  const Dimmest dimmest = DimmestOf(cells, kScatterGroups - substrings);
  const auto light = [&](double normal, double lopsided, const S& beyond) {
    return 1.0 + p[kScatterWidth] * (normal + p[kScatterLopsided] * (lopsided - normal) + beyond);
  };
  cell->substrings = substrings;
  cell->groups = 0;
  for (int g = 0; g < substrings; ++g) {
    double others = 1.0 / substrings;
    for (int k = g; k < dimmest.count; k += substrings) {
      const S beyond = k < kScatterOwn ? S(-p[kScatterDimmest + k]) : S(0.0);
      cell->group[cell->groups++] = {
          S(1.0 / cells), light(dimmest.normal[k], dimmest.lopsided[k], beyond), S(0.0), g};
      others -= 1.0 / cells;
    }
    cell->group[cell->groups++] = {
        S(others), light(dimmest.normal_rest, dimmest.lopsided_rest, S(0.0)), S(0.0), g};
    cell->substring[g] = {g + 1 < substrings, cell->substring_cells, 0};
  }
  cell->bypass = p[kScatterBypass];
  cell->reverse = ReverseLaw::kSoft;
  cell->reverse_voltage = p[kScatterSoft];
  cell->reverse_exponent = p[kScatterExponent];
}

// Where the dimmest cell of a substring lies, whose usual scatter is that of order statistics.
EffectParameter DimmestBeyond(const char* symbol, const char* name, const char* meaning) {
  constexpr double kUsual = 0.5;
  return Parameter(symbol, name, meaning)
      .Between(-2.5, 2.5)
      .Usual(kUsual)
      .FixedByDefault()
      .AbsentAt(0)
      .BelowUpper();  // farther below it is a weak cell
}

std::vector<EffectParameter> ScatterParameters() {
  return {
      Parameter("s", "light_width", "standard deviation of the cells' light").Between(0, 0.08),
      Parameter("A", "soft_voltage", "at which a cell in reverse carries Iph")
          .Unit("V")
          .Between(0.5, 30)
          .From(3.2)
          .FixedByDefault(),
      Parameter("m", "reverse_exponent", "of the soft reverse law")
          .Between(1, 8)
          .From(3.4)
          .FixedByDefault(),
      Parameter("q", "lopsidedness", "0: normal; 1: few cells far below the others")
          .Between(0, 1)
          .FixedByDefault()
          .AbsentAt(0),
      DimmestBeyond("t", "dimmest_beyond",
                    "widths that the dimmest cell lies below its usual place"),
      DimmestBeyond("t2", "second_dimmest_beyond", "likewise, of the second substring"),
      DimmestBeyond("t3", "third_dimmest_beyond", "likewise, of the third substring"),
      Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
          .Unit("V")
          .Between(0.1, 1.2)
          .From(0.5)
          .FixedByDefault(),
  };
}

std::vector<ShapeStart> ScatterStarts(const CurveShape& shape) {
  std::vector<ShapeStart> starts;
  constexpr double kLeastHalfway = 0.85;
  if (shape.At(0.5) < kLeastHalfway * shape.At(0.05)) return starts;  // no small scatter
  // The dimmest cell determines where the current bends. Positions on either side of its place are
  // separate local optima, and so are cells that conduct in reverse and cells that do not.
  for (const double lopsided : {0.0, 1.0}) {
    for (const double width : {0.015, 0.04}) {
      const auto start = [&](double soft, double exponent, double beyond) {
        return Probe{width, soft, exponent, lopsided, beyond, 0, 0, 0.5};
      };
      starts.push_back({start(3.2, 3.4, 0), {kScatterSoft}});
      starts.push_back({start(10, 3.4, 0), {kScatterSoft}});
      starts.push_back({start(30, 8, 0), {}});
      for (const double beyond : {-1.0, 0.0, 1.0}) {
        starts.push_back({start(15, 3.4, beyond), {kScatterSoft, kScatterDimmest}});
      }
      for (const double beyond : {-1.0, 1.0}) {
        starts.push_back({start(30, 8, beyond), {kScatterDimmest}});
      }
      std::vector<int> own = {kScatterBypass};
      for (int k = 0; k < kScatterOwn; ++k) own.push_back(kScatterDimmest + k);
      starts.push_back({start(30, 8, 0), own});
    }
  }
  return starts;
}

}  // namespace

Effect Scatter() {
  Effect e;
  e.id = "scatter";
  e.title = "cells that are all a little unequal";
  e.where = Where::kDevice;
  e.equation =
      "lights of the cells have width s, normal or lopsided towards an exponential by q; the "
      "dimmest of each substring, t widths beyond its place, and others lie in the substrings in "
      "turn; in reverse "
      "I = ... + Iph (-Vj / A)^m";
  e.reference = "bucciarelli1979";
  e.sentence = "no two cells deliver the same current, and the weaker ones limit the others";
  e.needs = "a curve of a module";
  e.acts = "between short circuit and the knee";
  e.confused_with = {"mismatch", "weak_cell", "distributed_rs"};
  e.separate_by = "an electroluminescence image";
  e.action = "clean the module and measure again";
  e.fact_sheet = "PVFS 1-20";
  e.prior = {0.005, 0.003, kFaultPrior};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format("the light of the cells differs by {}, one standard deviation",
                        PercentWithRange(of.Of("s"), 1))};
  };
  e.parameters = ScatterParameters();
  e.cell = [](const auto* p, auto* cell) { SetScatter(p, cell); };
  e.groups = true;
  e.why_not = NeedsManyCells;
  e.probes = [](const DataTraits&) {
    std::vector<Probe> probes;
    for (const double width : {0.01, 0.03}) probes.push_back({width, 3.2, 3.4, 0, 0, 0, 0, 0.5});
    return probes;
  };
  e.starts = [](const CurveShape& shape, const DataTraits&, const auto&) {
    return ScatterStarts(shape);
  };
  return e;
}

}  // namespace lyrefit
