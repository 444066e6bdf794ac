#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/effects/odd_cells.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

// Possible shares of shaded substrings: j of k. If the number k of bypass diodes is unknown, 2 and
// 3 are tried, of a string all usual ones.
std::vector<double> Shares(const DataTraits& traits) {
  constexpr double kSame = 1e-9;
  std::vector<int> numbers = {2, 3};
  if (traits.substrings > 1) numbers = {traits.substrings};
  if (traits.substrings > 1 && !traits.bypass_known) numbers = UsualSubstrings(traits.cells);
  std::vector<double> shares;
  for (const int k : numbers) {
    for (int j = 1; j < k; ++j) {
      const double share = static_cast<double>(j) / k;
      const bool there = std::any_of(shares.begin(), shares.end(), [&](double other) {
        return std::fabs(other - share) < kSame;
      });
      if (!there) shares.push_back(share);
    }
  }
  return shares;
}

std::vector<ShapeStart> ShadingStarts(const CurveShape& shape, const DataTraits& traits) {
  constexpr double kMiddle = 0.36, kEnd = 0.3;  // of each plateau's voltage range
  std::vector<ShapeStart> starts;
  std::vector<double> shares = Shares(traits);
  if (!UnlikeShares(shape, traits, kStepPlaced).empty()) {
    for (const double quarters : {0.25, 0.5, 0.75}) {
      if (std::find(shares.begin(), shares.end(), quarters) == shares.end()) {
        shares.push_back(quarters);
      }
    }
  }
  for (const double share : shares) {
    const double full = shape.At(kMiddle * (1 - share));
    if (!(full > 0)) continue;
    const double light = shape.At(1 - share + kEnd * share) / full;
    const double depth = std::clamp(1 - light, 0.01, 0.98);
    starts.push_back({{depth, share, 0.5, 1}, {}});
    starts.push_back({{depth, share, 0.5, 0.3}, {3}});
  }
  return starts;
}

std::vector<EffectParameter> ShadingParameters() {
  return {
      Parameter("d", "shading_depth", "part of the light that the shaded cells miss")
          .Between(0, 0.999)
          .Scatter(kSubstringScatter),
      Parameter("w", "shaded_share", "part of the cells that is shaded")
          .Between(0.01, 0.99)
          .From(0.3)
          .Searched()
          .Only(Whole::kSubstrings),
      Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
          .Unit("V")
          .Between(0.1, 1.2)
          .From(0.5),
      Parameter("c", "covered_part",
                "part of the cells of a shaded substring that the shade covers")
          .Between(0.03, 1)
          .From(1)
          .FixedByDefault()
          .AbsentAt(1),
  };
}

}  // namespace

Effect Shading() {
  Effect e;
  e.id = "shading";
  e.title = "partial shading";
  e.where = Where::kDevice;
  e.equation =
      "V = (1 - w) Vcell(I; Iph) + w Vcell(I - Ib; (1 - d) Iph) per cell, "
      "Ib of the bypass diode, which drops Vb at Isc";
  e.reference = "quaschning1996";
  e.sentence = "part of the module gets less light, and its bypass diodes conduct";
  e.needs = "a curve of a module; the number of bypass diodes helps";
  e.acts = "at a step of the current, at a fixed voltage";
  e.confused_with = {"irr_step", "transient", "mismatch"};
  e.separate_by =
      "repeat the sweep: shading stays at the same voltage, a cloud does not; a leaking bypass "
      "diode "
      "does too, and is found in the junction box, in the dark";
  e.action = "look for shade, snow or dirt on the darker part and clear it";
  e.fact_sheet = "PVFS 3-3";
  e.prior = {0.1,
             0.1,
             kShadePrior,
             {{InFlasher, 0.2, kUnlikePrior}, {ModuleInLaboratory, 0.1, kRoomPrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format("{} under {} of the others' {}{}", PartOfCells(of.readings, of.p[1]),
                        LightLeft(of.p[0], of.Of("d")), of.light(), CoveredPart(of.p[3]))};
  };
  e.parameters = ShadingParameters();
  e.cell = [](const auto* p, auto* cell) {
    cell->groups = cell->substrings = 2;
    cell->group[0] = {1.0 - p[1], 1.0, 0.0, 0};
    cell->group[1] = {p[1] * p[3], 1.0 - p[0], 0.0, 1};
    if (ValueOf(p[3])[0] < 1) {  // all lanes have the same parameters
      cell->group[2] = {p[1] * (1.0 - p[3]), 1.0, 0.0, 1};
      cell->groups = 3;
    }
    cell->substring[1] = {true, cell->substring_cells, 0};
    cell->bypass = p[2];
  };
  e.groups = true;
  // Of two substrings the brighter one may be covered as well.
  e.hides = [](const double*, const DataTraits& traits) { return SubstringsOf(traits) == 2; };
  e.light_missing = [](const double* p, const DataTraits& traits) {
    return SubstringsOf(traits) == 2 ? p[0] : kUnknown;
  };
  e.slight_is = "scatter";
  e.why_not = NeedsBypassDiodes;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    for (const double share : Shares(traits)) {
      for (const double depth : {0.01, 0.02, 0.035, 0.06, 0.12, 0.25, 0.45, 0.65, 0.85}) {
        probes.push_back({depth, share, 0.5, 1});
      }
    }
    return probes;
  };
  e.starts = [](const CurveShape& shape, const DataTraits& traits, const auto&) {
    return ShadingStarts(shape, traits);
  };
  return e;
}

}  // namespace lyrefit
