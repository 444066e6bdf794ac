#include "lyrefit/effects/catalogue_entries.h"
#include "lyrefit/effects/needs.h"

namespace lyrefit {
namespace {

// A distribution in seven kinds of cells: where they lie, in widths, and their part of all. The dim
// ones, which the others drive into reverse, are told apart more finely. Normal, or lopsided: most
// cells a little above the mean and few far below it, as an exponential has them.
constexpr int kKinds = 7;
constexpr double kNormal[kKinds] = {-2.27, -1.54, -0.99, -0.37, 0.31, 1.04, 2.02};
constexpr double kLopsided[kKinds] = {-3.91, -2.06, -0.94, -0.07, 0.50, 0.81, 0.96};
constexpr double kShare[kKinds] = {0.02, 0.06, 0.14, 0.26, 0.26, 0.18, 0.08};

}  // namespace

Effect Scatter() {
  Effect e;
  e.id = "scatter";
  e.title = "cells that are all a little unequal";
  e.where = Where::kDevice;
  e.equation =
      "lights of the cells are normal with width s, or lopsided towards an exponential by q, in "
      "seven kinds; in reverse "
      "I = ... + Iph (-Vj / A)^m";
  e.reference = "Bucciarelli 1979, doi:10.1016/0038-092X(79)90117-9";
  e.sentence = "no two cells deliver the same current, and the weaker ones limit the others";
  e.needs = "a curve of a module";
  e.acts = "between short circuit and the knee";
  e.confused_with = {"mismatch", "weak_cell", "distributed_rs"};
  e.separate_by = "an electroluminescence image";
  e.parameters = {
      {"s", "light_width", "", "standard deviation of the cells' light", 0, 0.3, 0},
      {"A", "soft_voltage", "V", "at which a cell in reverse carries Iph", 0.5, 30, 3.2},
      {"m", "reverse_exponent", "", "of the soft reverse law", 1, 8, 3.4},
      {"q", "lopsidedness", "", "0: normal; 1: few cells far below the others", 0, 1, 0}};
  for (int k = 1; k < e.size(); ++k) e.parameters[k].held = true;
  e.parameters.back().absent_at = 0;
  e.cell = [](const auto* p, auto* cell) {
    cell->kinds = kKinds;
    for (int k = 0; k < kKinds; ++k) {
      cell->kind[k] = {p[0] * 0.0 + kShare[k],
                       1.0 + p[0] * (kNormal[k] + p[3] * (kLopsided[k] - kNormal[k])), 0.0, 0};
    }
    cell->reverse = ReverseLaw::kSoft;
    cell->reverse_voltage = p[1];
    cell->reverse_exponent = p[2];
  };
  e.groups = true;
  e.why_not = NeedsModule;
  e.probes = [](const DataTraits&) {
    std::vector<Probe> probes;
    for (const double width : {0.01, 0.03}) probes.push_back({width, 3.2, 3.4, 0});
    return probes;
  };
  e.starts = [](const CurveShape&, const DataTraits&) {
    std::vector<ShapeStart> starts;
    for (const double lopsided : {0.0, 1.0}) {
      for (const double width : {0.015, 0.04}) {
        for (const double soft : {3.2, 10.0}) {
          starts.push_back({{width, soft, 3.4, lopsided}, {1}});
        }
      }
    }
    return starts;
  };
  return e;
}

}  // namespace lyrefit
