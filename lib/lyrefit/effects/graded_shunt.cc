#include <fmt/format.h>

#include <array>

#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

// Places along the string from 0 to 1 and the shares of cells that they stand for: nodes and
// weights of Gauss and Legendre. The sum differs from that of all cells by less than 1 mV per cell.
struct ShuntPlace {
  double place, share;
};
constexpr std::array<ShuntPlace, 10> kShuntPlaces = {{{0.013046735741414184, 0.03333567215434387},
                                                      {0.06746831665550773, 0.07472567457529027},
                                                      {0.16029521585048778, 0.10954318125799109},
                                                      {0.2833023029353764, 0.13463335965499812},
                                                      {0.4255628305091844, 0.14776211235737646},
                                                      {0.5744371694908156, 0.14776211235737646},
                                                      {0.7166976970646236, 0.13463335965499812},
                                                      {0.8397047841495122, 0.10954318125799109},
                                                      {0.9325316833444923, 0.07472567457529027},
                                                      {0.9869532642585859, 0.03333567215434387}}};

template <class S>
void SetGradedShunt(const S* p, Cell<S>* cell) {
  cell->groups = 0;
  const S steep = p[1];
  const S scale = p[0] * steep / (exp(steep) - 1.0 - steep);
  for (const ShuntPlace& at : kShuntPlaces) {
    cell->group[cell->groups++] = {S(at.share), S(1.0), scale * (exp(steep * at.place) - 1.0), 0};
  }
}

}  // namespace

Effect GradedShunt() {
  Effect e;
  e.id = "graded_shunt";
  e.title = "shunts that grow along the string";
  e.where = Where::kDevice;
  e.equation =
      "cells have conductances g s (exp(s x) - 1) / (exp(s) - 1 - s) beside the common one, x from "
      "0 to 1 along the string";
  e.reference = "luo2017";
  e.sentence =
      "cells leak, more and more towards one end of the string: potential-induced degradation";
  e.needs = "a curve of a module or a string";
  e.acts = "between short circuit and the knee, which it rounds";
  e.confused_with = {"leaky_cell", "nonohmic_shunt", "mismatch"};
  e.separate_by =
      "an electroluminescence image, or a sweep at low light, where leaks take most of the voltage";
  e.fact_sheet = "PVFS 1-10";
  e.action =
      "measure the insulation and look at the string by night with an electroluminescence camera";
  e.prior = {0.02, 0.02, kFaultPrior, {{AsNew, 0.1, kInfantPrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format(
        "at 0.5 V the cells lose {:.2g} % of Isc on average, most at one end of the string",
        100 * (0.5 * of.p[0]))};
  };
  e.parameters = {
      Parameter("g", "mean_leak", "mean conductance of the cells beside that of the device")
          .Unit("S")
          .Between(0, 20)
          .CurrentPower(1),
      Parameter("s", "steepness", "exponent of the growth; small: in proportion to the place")
          .Between(0.2, 8)
          .From(4),
  };
  e.cell = [](const auto* p, auto* cell) { SetGradedShunt(p, cell); };
  e.groups = true;
  e.hides = [](const double*, const DataTraits&) { return true; };  // what leaks alike in all cells
  e.why_not = NeedsManyCells;
  e.probes = [](const DataTraits&) {
    std::vector<Probe> probes;
    for (const double steep : {2.0, 4.0, 7.0}) {
      for (const double leak : {0.05, 0.3}) probes.push_back({leak, steep});
    }
    return probes;
  };
  e.starts = [](const CurveShape&, const DataTraits&, const auto&) {
    std::vector<ShapeStart> starts;
    for (const double steep : {2.0, 4.0, 7.0}) {
      for (const double leak : {0.05, 0.3, 1.0}) starts.push_back({{leak, steep}, {}});
    }
    return starts;
  };
  return e;
}

}  // namespace lyrefit
