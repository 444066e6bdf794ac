#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/effects/odd_cells.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

constexpr int kMostDim = 5, kDimSubstrings = 3;
enum { kDimFirst = kMostDim, kDimSecond, kDimSoft, kDimExponent, kDimBypass, kDimChains };

// The substring, from 0, of dim cell `k`: the first n1 are in the first one, the next n2 in the
// second, the others in the third. All lanes have the same parameters.
template <class S>
int SubstringOfDim(const S* p, int k) {
  const int first = static_cast<int>(std::lround(ValueOf(p[kDimFirst])[0]));
  const int second = static_cast<int>(std::lround(ValueOf(p[kDimSecond])[0]));
  return k < first ? 0 : k < first + second ? 1 : 2;
}

// Substrings with dim cells have one group for each of them, one for their mates and, in half-cut
// modules, one for the chain beside. Other substrings form one group and are never in reverse.
template <class S>
void SetDimCells(const S* p, Cell<S>* cell) {
  const double one = 1 / cell->cells;
  const double mates = std::min(cell->substring_cells, cell->cells) * one;
  const int substrings = std::max(static_cast<int>(std::lround(1 / mates)), 1);
  const bool paired = ValueOf(p[kDimChains])[0] > 1.5;
  int dim[kDimSubstrings] = {}, number[kDimSubstrings] = {};
  for (int k = 0; k < kMostDim; ++k) {
    const int at = std::min(SubstringOfDim(p, k), substrings - 1);
    if (ValueOf(p[k])[0] > 0) ++dim[at];
  }
  double elsewhere = 1;
  cell->groups = cell->substrings = 0;
  for (int s = 0; s < kDimSubstrings; ++s) {
    if (dim[s] == 0) continue;
    number[s] = cell->substrings++;
    cell->substring[number[s]] = {substrings > 1, mates * cell->cells, 0, paired};
    cell->group[cell->groups++] = {S(mates - dim[s] * one), S(1.0), S(0.0), number[s]};
    if (paired) cell->group[cell->groups++] = {S(one), S(1.0), S(0.0), number[s], true};
    elsewhere -= mates;
  }
  constexpr double kDark = 1e-3;
  for (int k = 0; k < kMostDim; ++k) {
    if (!(ValueOf(p[k])[0] > 0)) continue;
    const int at = std::min(SubstringOfDim(p, k), substrings - 1);
    const S light = 1.0 - p[k] * p[kDimChains];
    cell->group[cell->groups++] = {S(one), Choose(ValueOf(light) < kDark, S(kDark), light), S(0.0),
                                   number[at]};
  }
  if (elsewhere > 0.5 * one) {
    cell->group[cell->groups++] = {S(elsewhere), S(1.0), S(0.0), cell->substrings};
    cell->substring[cell->substrings++] = {false, mates * cell->cells, 0};
  }
  cell->bypass = p[kDimBypass];
  cell->reverse = ReverseLaw::kSoft;
  cell->reverse_voltage = p[kDimSoft];
  cell->reverse_exponent = p[kDimExponent];
}

// Starts from the plateaus: a cell for each below the first, in the places that give a curve near
// the measured one.
std::vector<ShapeStart> DimCellsStarts(const CurveShape& shape, const DataTraits& traits) {
  constexpr std::size_t kMostGuesses = 10;
  std::vector<ShapeStart> starts;
  const std::vector<double> deficits = PlateauDeficits(shape, kMostDim);
  for (const DimPlaces& guess :
       GuessDimPlaces(shape, traits, deficits, kDimSubstrings, kMostGuesses)) {
    ShapeStart start{
        {0, 0, 0, 0, 0, 0, 0, guess.soft_voltage, guess.exponent, 0.5, double(guess.chains)},
        {kDimSoft, kDimExponent, kDimBypass}};
    int at = 0;
    for (int place = 0; place < kDimSubstrings; ++place) {
      for (std::size_t k = 0; k < deficits.size(); ++k) {
        if (guess.places[k] != place) continue;
        start.freed.push_back(at);
        start.p[at++] = deficits[k];
        if (place < 2) ++start.p[kDimFirst + place];
      }
    }
    starts.push_back(std::move(start));
  }
  return starts;
}

std::vector<EffectParameter> DimCellsParameters() {
  static const char* const kNames[kMostDim][2] = {{"d1", "light_deficit_1"},
                                                  {"d2", "light_deficit_2"},
                                                  {"d3", "light_deficit_3"},
                                                  {"d4", "light_deficit_4"},
                                                  {"d5", "light_deficit_5"}};
  std::vector<EffectParameter> parameters;
  for (const auto& [symbol, name] : kNames) {
    parameters.push_back(Parameter(symbol, name,
                                   "part of its substring's light that is missing because of the "
                                   "cell: in half-cut modules half of what the cell misses; 0: no "
                                   "such cell")
                             .Between(0, 0.999)
                             .Scatter(kCellScatter)
                             .FixedByDefault()
                             .AbsentAt(0));
  }
  const auto count = [](const char* symbol, const char* name, const char* doc) {
    return Parameter(symbol, name, doc)
        .Between(0, kMostDim)
        .FixedByDefault()
        .AbsentAt(0)
        .Only(Whole::kCount);
  };
  parameters.push_back(count("n1", "in_first", "how many of them are in one substring"));
  parameters.push_back(
      count("n2", "in_second", "how many of them are in a second; the others are in a third"));
  parameters.push_back(Parameter("A", "soft_voltage", "at which a cell in reverse carries Iph")
                           .Unit("V")
                           .Between(0.5, 60)
                           .From(3.2)
                           .FixedByDefault());
  parameters.push_back(Parameter("m", "reverse_exponent", "of the soft reverse law")
                           .Between(1, 8)
                           .From(3.4)
                           .FixedByDefault());
  parameters.push_back(Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
                           .Unit("V")
                           .Between(0.1, 1.2)
                           .From(0.5)
                           .FixedByDefault());
  parameters.push_back(kChains);
  return parameters;
}

Phrases DimCellsInWords(const FittedEffect& of) {
  const double chains = of.p[kDimChains];
  Phrases lights;
  for (int k = 0; k < kMostDim; ++k) {
    const Sized deficit = of.Of(fmt::format("d{}", k + 1));
    if (std::isfinite(deficit.value)) lights.push_back(LightLeft(deficit.value, deficit, chains));
  }
  return {fmt::format("{} cells have {} of the others' {}", lights.size(), fmt::join(lights, ", "),
                      of.light())};
}

}  // namespace

Effect DimCells() {
  Effect e;
  e.id = "dim_cells";
  e.title = "cells under a light each";
  e.finding = "weak_cell";
  e.elaborate = true;
  e.where = Where::kDevice;
  e.equation =
      "single cells of one or more substrings under light (1 - d_k); in reverse "
      "I = ... + Iph (-Vj / A)^m";
  e.reference = "bishop1988";
  e.sentence =
      "several cells deliver less than their neighbours, each another current, and are driven into "
      "reverse: hot spots";
  e.needs =
      "a curve of a module whose dim cells conduct in reverse, or lie in different substrings";
  e.acts = "at a staircase between short circuit and the knee";
  e.confused_with = {"weak_cell", "substrings", "scatter"};
  e.separate_by = "cover one cell after the other, or a thermal image under load";
  e.action = "look at the module with a thermal camera: several cells are covered, dark or broken";
  e.prior = {0.01, 0.01, kFaultPrior};
  e.in_words = DimCellsInWords;
  e.parameters = DimCellsParameters();
  e.cell = [](const auto* p, auto* cell) { SetDimCells(p, cell); };
  e.groups = true;
  e.why_not = NeedsBypassedModule;
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.3, 0.15, 0, 0, 0, 1, 1, 3.2, 3.4, 0.5, 1},
                              {0.6, 0.3, 0, 0, 0, 2, 0, 3.2, 3.4, 0.5, 1}};
  };
  e.starts = [](const CurveShape& shape, const DataTraits& traits, const auto&) {
    return DimCellsStarts(shape, traits);
  };
  return e;
}

}  // namespace lyrefit
