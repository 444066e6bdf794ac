#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/effects/odd_cells.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

constexpr int kMostEdges = 4;
enum { kEdgeDrop = 2 * kMostEdges, kEdgeFirstShare, kEdgeSoft, kEdgeParameters };

constexpr double kEdgeExponent = 3.4;
constexpr double kBlockingEdge_V = 60;  // soft voltage of cells that hardly conduct in reverse

int EdgesOf(double cells, double substring_cells) {
  return std::clamp(static_cast<int>(std::lround(cells / substring_cells)), 2, kMostEdges);
}

// Each substring is a group of covered cells and a group of uncovered ones, which share a bypass
// diode.
template <class S>
void SetCoveredEdge(const S* p, Cell<S>* cell) {
  const int substrings = EdgesOf(cell->cells, cell->substring_cells);
  // All lanes have the same parameters.
  const bool alike = !(ValueOf(p[kEdgeFirstShare])[0] > 0);
  const S first = alike ? S(1.0 / substrings) : p[kEdgeFirstShare];
  const S other = (1.0 - first) * (1.0 / (substrings - 1));
  cell->substrings = substrings;
  cell->groups = 0;
  for (int k = 0; k < substrings; ++k) {
    const S share = k == 0 ? first : other;
    const S dark = share * p[2 * k + 1];
    cell->group[cell->groups++] = {dark, 1.0 - p[2 * k], S(0.0), k};
    if (ValueOf(p[2 * k + 1])[0] < 1) {
      cell->group[cell->groups++] = {share - dark, S(1.0), S(0.0), k};
    }
    cell->substring[k] = {true, cell->cells * ValueOf(share)[0], 0};
  }
  cell->bypass = p[kEdgeDrop];
  if (!(ValueOf(p[kEdgeSoft])[0] < kBlockingEdge_V)) return;
  cell->reverse = ReverseLaw::kSoft;
  cell->reverse_voltage = p[kEdgeSoft];
  cell->reverse_exponent = S(kEdgeExponent);
}

// Substrings, the brightest first: share of the cells and position among the parameters.
struct EdgeOrder {
  std::vector<double> shares;
  std::vector<int> number;
  double first_share = 0;  // value of w
};

EdgeOrder OrderOfAlike(int substrings) {
  EdgeOrder order;
  order.shares.assign(substrings, 1.0 / substrings);
  for (int k = substrings; k-- > 0;) order.number.push_back(k);
  return order;
}

// The largest substring has the first parameters.
EdgeOrder OrderOf(const ThreeShares& shares) {
  EdgeOrder order;
  order.shares.assign(shares.begin(), shares.end());
  order.first_share = *std::max_element(shares.begin(), shares.end());
  int next = 0;
  for (const double share : shares) order.number.push_back(share == order.first_share ? 0 : ++next);
  return order;
}

// A start with the light of every substring from the middle of its plateau. `shown`: part of the
// full light that the curve shows.
ShapeStart EdgeStart(const CurveShape& shape, const EdgeOrder& order, double shown, double covered,
                     double soft) {
  constexpr double kMiddle = 0.36;  // of a plateau, before its final knee
  ShapeStart start{Probe(kEdgeParameters, 0.0), {}};
  for (int k = 0; k < kMostEdges; ++k) start.p[2 * k + 1] = covered;
  double begin = 0;
  for (std::size_t k = 0; k < order.shares.size(); ++k) {
    const double light = shape.At(begin + kMiddle * order.shares[k]) / shape.At(0.02);
    const int at = 2 * order.number[k];
    start.p[at] = std::clamp(1 - shown * light, 0.01, 0.98);
    start.freed.insert(start.freed.end(), {at, at + 1});
    begin += order.shares[k];
  }
  start.p[kEdgeDrop] = 0.5;
  start.p[kEdgeFirstShare] = order.first_share;
  start.p[kEdgeSoft] = soft;
  if (soft < kBlockingEdge_V) start.freed.push_back(kEdgeSoft);
  return start;
}

std::vector<ShapeStart> CoveredEdgeStarts(const CurveShape& shape, const DataTraits& traits) {
  std::vector<ShapeStart> starts;
  if (!(shape.At(0.02) > 0)) return starts;
  const EdgeOrder alike = OrderOfAlike(std::clamp(SubstringsOf(traits), 2, kMostEdges));
  for (const double soft : {kBlockingEdge_V, 7.0}) {
    for (const double shown : {0.9, 0.6}) {
      for (const double covered : {0.06, 0.15, 0.4}) {
        starts.push_back(EdgeStart(shape, alike, shown, covered, soft));
      }
    }
  }
  for (const ThreeShares& shares : UnlikeShares(shape, traits)) {
    for (const double covered : {0.06, 0.4}) {
      for (const double soft : {kBlockingEdge_V, 7.0}) {
        starts.push_back(EdgeStart(shape, OrderOf(shares), 0.9, covered, soft));
      }
    }
  }
  return starts;
}

std::vector<EffectParameter> CoveredEdgeParameters() {
  static const char* const kNames[kMostEdges][4] = {
      {"d1", "light_deficit_1", "c1", "covered_part_1"},
      {"d2", "light_deficit_2", "c2", "covered_part_2"},
      {"d3", "light_deficit_3", "c3", "covered_part_3"},
      {"d4", "light_deficit_4", "c4", "covered_part_4"}};
  std::vector<EffectParameter> parameters;
  for (const auto& [deficit, deficit_name, part, part_name] : kNames) {
    parameters.push_back(
        Parameter(deficit, deficit_name, "part of the full light that its covered cells miss")
            .Between(0, 0.999)
            .Scatter(kSubstringScatter)
            .AbsentAt(0)
            .FixedByDefault());
    parameters.push_back(Parameter(part, part_name, "part of its cells that is covered")
                             .Between(0.02, 1)
                             .From(0.1)
                             .FixedByDefault());
  }
  parameters.push_back(Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
                           .Unit("V")
                           .Between(0.1, 1.2)
                           .From(0.5));
  parameters.push_back(Parameter("w", "first_share",
                                 "part of the cells in the first substring, the others are alike; "
                                 "0: all alike")
                           .Between(0, 0.9)
                           .FixedByDefault()
                           .AbsentAt(0));
  parameters.push_back(
      Parameter("A", "soft_voltage", "at which a cell in reverse carries Iph; 60: hardly at any")
          .Unit("V")
          .Between(1.5, kBlockingEdge_V)
          .From(kBlockingEdge_V)
          .FixedByDefault()
          .AbsentAt(kBlockingEdge_V));
  return parameters;
}

Phrases CoveredEdgeInWords(const FittedEffect& of) {
  Phrases words;
  const int substrings = std::clamp(SubstringsOf(of.readings.traits), 2, kMostEdges);
  words.reserve(substrings);
  for (int k = 0; k < substrings; ++k) {
    words.push_back(fmt::format(
        "{:.0f} % of a substring's cells have {} of the others' {}", 100 * of.p[2 * k + 1],
        LightLeft(of.p[2 * k], of.Of(fmt::format("d{}", k + 1))), of.light()));
  }
  return words;
}

}  // namespace

Effect CoveredEdge() {
  Effect e;
  e.id = "covered_edge";
  e.title = "every substring partly covered";
  e.finding = "shading";
  e.elaborate = true;
  e.hides = [](const double*, const DataTraits&) {
    return true;
  };  // light is relative to the brightest
  e.where = Where::kDevice;
  e.equation =
      "V = sum over substrings k of (1 - c_k) Vcell(I; Iph) + c_k Vcell(I; (1 - d_k) Iph), each "
      "with a bypass diode that drops Vb at Isc; Iph of an uncovered cell; in reverse "
      "I = ... + Iph (-Vj / A)^3.4";
  e.reference = "quaschning1996";
  e.sentence =
      "something covers a part of every substring, as snow or dirt at an edge does: the module "
      "gives less than its light everywhere";
  e.needs = "a curve of a module of two to four bypass diodes";
  e.acts = "at a knee that is sharper than that of any diode, and at steps of the current";
  e.confused_with = {"substrings", "shading", "mismatch"};
  e.separate_by = "clean the module, or compare the short-circuit current with the light";
  e.fact_sheet = "PVFS 3-3";
  e.action = "look for snow, dirt or a shadow along an edge of the module and clear it";
  e.prior = {0.08,
             0.08,
             kShadePrior,
             {{InFlasher, 0.05, kUnlikePrior}, {ModuleInLaboratory, 0.02, kRoomPrior}}};
  e.in_words = CoveredEdgeInWords;
  e.parameters = CoveredEdgeParameters();
  e.cell = [](const auto* p, auto* cell) { SetCoveredEdge(p, cell); };
  e.groups = true;
  e.light_missing = [](const double* p, const DataTraits&) {
    double missing = 0;
    for (int k = 0; k < kMostEdges; ++k) missing = std::max(missing, p[2 * k]);
    return missing;
  };
  e.slight_is = "scatter";
  e.starts = [](const CurveShape& shape, const DataTraits& traits, const auto&) {
    return CoveredEdgeStarts(shape, traits);
  };
  e.why_not = [](const DataTraits& traits) {
    auto why = NeedsBypassedModule(traits);
    if (!why) why = NeedsBypassDiodes(traits);
    if (why) return why;
    const int substrings = SubstringsOf(traits);
    if (substrings < 2 || substrings > kMostEdges) why = "needs two to four bypass diodes";
    return why;
  };
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.3, 0.2, 0.3, 0.2, 0.3, 0.2, 0.3, 0.2, 0.5, 0, kBlockingEdge_V},
                              {0.3, 0.2, 0.5, 0.2, 0.5, 0.2, 0.5, 0.2, 0.5, 0, kBlockingEdge_V}};
  };
  return e;
}

}  // namespace lyrefit
