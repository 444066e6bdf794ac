#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "lyrefit/effects/odd_cells.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

constexpr int kGroups = 4;
enum { kDrop = 2 * kGroups, kCovered, kParameters };

using ShareList = std::vector<double>;

// Adds a start with the light of each group from the middle of its plateau. The brightest group
// (the rest) has the first plateau, the others follow in the given order. `shares`: by position
// among the parameters; `order`: positions.
void AddStart(const CurveShape& shape, const ShareList& shares, const std::vector<int>& order,
              std::vector<ShapeStart>* starts) {
  constexpr double kMiddle = 0.36;  // of a plateau, before its final knee
  constexpr double kBright = 0.02;  // of Voc: tracers take few points on the first plateau
  const double full = shape.At(kBright);
  if (!(full > 0)) return;
  ShapeStart start{Probe(kParameters, 0.0), {}};
  double begin = 1 - std::accumulate(shares.begin(), shares.end(), 0.0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int group = order[k];
    const double share = shares[group];
    const double light = shape.At(begin + kMiddle * share) / full;
    start.p[2 * group] = std::clamp(1 - light, 0.01 * static_cast<double>(k + 1), 0.98);
    start.p[2 * group + 1] = share;
    start.freed.push_back(2 * group);
    begin += share;
  }
  start.p[kDrop] = 0.5;
  start.p[kCovered] = 1;
  starts->push_back(start);
  if (order.size() == std::size_t{kGroups}) return;
  start.p[kCovered] = 0.3;
  start.freed.push_back(kCovered);
  starts->push_back(std::move(start));
}

std::vector<int> InOrder(std::size_t count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// Adds a start with a light for each of `substrings` equal substrings. For more than five, only
// four groups differ from the brightest.
void AddEqual(const CurveShape& shape, int substrings, std::vector<ShapeStart>* starts) {
  const int groups = std::min(substrings - 1, kGroups);
  AddStart(shape, ShareList(groups, 1.0 / substrings), InOrder(groups), starts);
}

// Adds starts for all divisions of the substrings into `groups` groups and the brightest one, with
// at least one substring each.
void AddShares(const CurveShape& shape, int substrings, std::size_t groups, ShareList* shares,
               std::vector<ShapeStart>* starts) {
  if (shares->size() == groups) {
    AddStart(shape, *shares, InOrder(groups), starts);
    return;
  }
  const double one = 1.0 / substrings;
  const double taken = std::accumulate(shares->begin(), shares->end(), 0.0);
  const double others = static_cast<double>(groups - shares->size()) * one;
  for (int k = 1; taken + k * one + others < 1 + 1e-9; ++k) {
    shares->push_back(k * one);
    AddShares(shape, substrings, groups, shares, starts);
    shares->pop_back();
  }
}

// Starts of a requested fit: the requested number of groups, with shares fixed or to be found.
std::vector<ShapeStart> AskedStarts(const CurveShape& shape, const DataTraits& traits,
                                    const std::vector<ParameterBounds>& asked) {
  std::vector<ShapeStart> starts;
  ShareList shares;
  bool told = true;
  for (int k = 0; k < kGroups; ++k) {
    const ParameterBounds& share = asked[2 * k + 1];
    if (!(share.upper > 0)) break;
    told = told && share.lower == share.upper;
    shares.push_back(share.lower);
  }
  if (shares.empty()) {
    AddEqual(shape, std::max(SubstringsOf(traits), 2), &starts);
  } else if (told) {
    std::vector<int> order = InOrder(shares.size());
    do {
      AddStart(shape, shares, order, &starts);
    } while (std::adjacent_find(shares.begin(), shares.end(), std::not_equal_to<>()) !=
                 shares.end() &&
             std::next_permutation(order.begin(), order.end()));
  } else {
    ShareList some;
    const int substrings = std::max(SubstringsOf(traits), static_cast<int>(shares.size()) + 1);
    AddShares(shape, substrings, shares.size(), &some, &starts);
  }
  return starts;
}

std::vector<EffectParameter> SubstringParameters() {
  static const char* const kNames[kGroups][4] = {{"d1", "light_deficit_1", "w1", "share_1"},
                                                 {"d2", "light_deficit_2", "w2", "share_2"},
                                                 {"d3", "light_deficit_3", "w3", "share_3"},
                                                 {"d4", "light_deficit_4", "w4", "share_4"}};
  std::vector<EffectParameter> parameters;
  for (const auto& [deficit, deficit_name, share, share_name] : kNames) {
    parameters.push_back(Parameter(deficit, deficit_name, "part of the light that the group misses")
                             .Between(0, 0.999)
                             .Scatter(kSubstringScatter)
                             .FixedByDefault());
    parameters.push_back(Parameter(share, share_name, "part of the cells in it; 0: no such group")
                             .Between(0, 0.99)
                             .AbsentAt(0)
                             .FixedByDefault()
                             .Only(Whole::kSubstrings));
  }
  parameters.push_back(Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
                           .Unit("V")
                           .Between(0.1, 1.2)
                           .From(0.5));
  parameters.push_back(Parameter("c", "covered_part",
                                 "part of the cells of a darker group that have its light; the "
                                 "others have the brightest's. Of up to three groups")
                           .Between(0.03, 1)
                           .From(1)
                           .FixedByDefault()
                           .AbsentAt(1));
  return parameters;
}

template <class S>
void SetSubstrings(const S* p, Cell<S>* cell) {
  // All lanes have the same parameters.
  const auto there = [&](int k) { return ValueOf(p[2 * k + 1])[0] > 0; };
  int given = 0;
  for (int k = 0; k < kGroups; ++k) given += there(k) ? 1 : 0;
  const bool partly = given < kGroups && ValueOf(p[kCovered])[0] < 1;
  int groups = 1, substrings = 1;
  auto rest = 1.0 - p[1] * 0.0;
  for (int k = 0; k < kGroups; ++k) {
    if (!there(k)) continue;
    const auto& share = p[2 * k + 1];
    const auto dark = partly ? share * p[kCovered] : share;
    cell->group[groups++] = {dark, 1.0 - p[2 * k], 0.0, substrings};
    if (partly) cell->group[groups++] = {share - dark, 1.0, 0.0, substrings};
    cell->substring[substrings++] = {true, cell->substring_cells, 0};
    rest = rest - share;
  }
  cell->group[0] = {rest, 1.0, 0.0, 0};
  cell->substring[0] = {false, cell->substring_cells, 0};  // the brightest are never in reverse
  cell->groups = groups;
  cell->substrings = substrings;
  cell->bypass = p[kDrop];
}

// Whether lights fall from substring to substring down to a single brightest one, which may be
// covered as well.
bool LeavesOneBright(const double* p, const DataTraits& traits) {
  double rest = 1;
  int dark = 0;
  for (int k = 0; k < kGroups; ++k) {
    rest -= p[2 * k + 1];
    dark += p[2 * k + 1] > 0 ? 1 : 0;
  }
  constexpr double kRounding = 0.01;
  return dark > 1 && rest < 1.0 / std::max(SubstringsOf(traits), 2) + kRounding;
}

std::vector<ShapeStart> SubstringStarts(const CurveShape& shape, const DataTraits& traits,
                                        const std::vector<ParameterBounds>& asked) {
  if (!asked.empty()) return AskedStarts(shape, traits, asked);
  std::vector<ShapeStart> starts;
  const int known = traits.substrings;
  for (int k = 3; k <= 4; ++k) {  // with two substrings this is shading
    if (known == k || (known == 0 && k == 3)) AddEqual(shape, k, &starts);
  }
  for (const ThreeShares& shares : UnlikeShares(shape, traits, kStepPlaced)) {
    AddStart(shape, {shares[1], shares[2]}, InOrder(2), &starts);
  }
  return starts;
}

Phrases SubstringsInWords(const FittedEffect& of) {
  Phrases words;
  const double* p = of.p;
  for (int k = 0; k < kGroups; ++k) {
    if (!(p[2 * k + 1] > 0)) continue;
    words.push_back(fmt::format("{} under {} of the brightest's {}{}",
                                PartOfCells(of.readings, p[2 * k + 1]),
                                LightLeft(p[2 * k], of.Of(fmt::format("d{}", k + 1))), of.light(),
                                CoveredPart(p[kCovered])));
  }
  return words;
}

}  // namespace

Effect Substrings() {
  Effect e;
  e.id = "substrings";
  e.finding = "shading";
  e.title = "substrings under a light each";
  e.where = Where::kDevice;
  e.equation =
      "V = sum of w_k max(Vcell(I; x_k Iph), -Vb), a real diode for the maximum, "
      "w_k and x_k of up to four groups beside the brightest";
  e.reference = "quaschning1996";
  e.sentence = "parts of the module stand under different light, and their bypass diodes conduct";
  e.needs = "a curve of a module; the number of bypass diodes helps";
  e.acts = "at steps of the current, at fixed voltages";
  e.confused_with = {"shading", "irr_step"};
  e.separate_by = "repeat the sweep: shading stays at the same voltage, a cloud does not";
  e.action = "look for shade, snow or dirt on the darker parts and clear it";
  e.fact_sheet = "PVFS 3-3";
  e.prior = {0.08,
             0.08,
             kShadePrior,
             {{InFlasher, 0.25, kUnlikePrior}, {ModuleInLaboratory, 0.1, kRoomPrior}}};
  e.in_words = SubstringsInWords;
  e.parameters = SubstringParameters();
  for (int k = 0; k < kGroups; ++k) e.alike.push_back({2 * k, 2 * k + 1});
  e.cell = [](const auto* p, auto* cell) { SetSubstrings(p, cell); };
  e.groups = true;
  e.light_missing = [](const double* p, const DataTraits& traits) {
    if (!LeavesOneBright(p, traits)) return kUnknown;
    double missing = 0;
    for (int k = 0; k < kGroups; ++k) {
      if (p[2 * k + 1] > 0) missing = std::max(missing, p[2 * k]);
    }
    return missing;
  };
  e.slight_is = "scatter";
  e.hides = LeavesOneBright;
  e.starts = SubstringStarts;
  e.why_not = [](const DataTraits& traits) {
    auto why = NeedsBypassedModule(traits);
    return why ? why : NeedsBypassDiodes(traits);
  };
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.3, 1.0 / 3, 0, 0, 0, 0, 0, 0, 0.5, 1},
                              {0.3, 1.0 / 3, 0.6, 1.0 / 3, 0, 0, 0, 0, 0.5, 1}};
  };
  return e;
}

}  // namespace lyrefit
