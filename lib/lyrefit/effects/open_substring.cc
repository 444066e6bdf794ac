#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

// Possible shares of open substrings: all whole numbers of them, of at most four, and one module of
// three substrings in strings of two to twelve modules.
std::vector<double> OpenShares(const DataTraits& traits) {
  constexpr int kMostApart = 4, kLongest = 12, kOfOneModule = 3;
  std::vector<double> shares;
  const int substrings = std::max(SubstringsOf(traits), 2);
  const int apart = std::min(substrings, kMostApart);
  for (int j = 1; j < apart; ++j) shares.push_back(static_cast<double>(j) / substrings);
  if (substrings <= kMostApart) return shares;
  for (int j = kOfOneModule; j <= substrings / 2; j += kOfOneModule) {
    const double share = static_cast<double>(j) / substrings;
    if (static_cast<int>(shares.size()) > kLongest) break;
    if (std::find(shares.begin(), shares.end(), share) == shares.end()) shares.push_back(share);
  }
  return shares;
}

// The shares with which the other cells have a usual open-circuit voltage; all if there is none. A
// curve does not tell a share from the ideality of the cells.
std::vector<double> LikelyShares(const DataTraits& traits) {
  constexpr double kLeast_V = 0.42, kMost_V = 0.8;  // of a cell
  const std::vector<double> shares = OpenShares(traits);
  std::vector<double> likely;
  const double whole =
      traits.open_circuit > 0 ? traits.open_circuit : traits.highest_voltage;  // of all cells
  for (const double share : shares) {
    const double voltage = whole / (1 - share);
    if (voltage > kLeast_V && voltage < kMost_V) likely.push_back(share);
  }
  return likely.empty() ? shares : likely;
}

std::vector<EffectParameter> OpenSubstringParameters() {
  return {
      Parameter("w", "open_share", "part of the cells in substrings that give nothing")
          .Between(0, 0.99)
          .Searched()
          .Only(Whole::kSubstrings),
      Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
          .Unit("V")
          .Between(0.1, 1.2)
          .From(0.5),
      Parameter("nb", "bypass_ideality", "ideality of a bypass diode: Vb falls by nb Vt per e-fold")
          .Between(0.5, 4)
          .From(kUsualBypassIdeality),
  };
}

}  // namespace

Effect OpenSubstring() {
  Effect e;
  e.id = "open_substring";
  e.title = "a substring without current";
  e.where = Where::kDevice;
  e.equation =
      "V = (1 - w) Vcell(I; Iph) per cell, minus nb Vt ln(1 + I / Isb) of every bypass diode of "
      "the open substrings, which drops Vb at Isc";
  e.reference = "iec62446_3 (Annex C)";
  e.sentence =
      "the circuit of a substring or a module is broken, and its bypass diodes carry all current";
  e.needs = "a curve of a module of known cells, bypass diodes and temperature";
  e.acts = "at open circuit: the share of the open substrings is missing, and the end is rounded";
  e.gain_scatter = 0.08;  // `fault_study field`, modules of two to four substrings
  e.confused_with = {"bypass_short", "temperature_or_cells", "shading"};
  e.separate_by =
      "a thermal image: the bypass diodes of the open substrings are hot; a shorted diode is cold";
  e.action = "open the junction box and look for a broken connection of a substring";
  e.prior = {0.005, 0.01, kFaultPrior, {{OfOldAge, 2, kWornPrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format("{} without current; the bypass diode drops {}",
                        PartOfCells(of.readings, of.p[0]), WithUnit(of.Of("Vb"), "V"))};
  };
  e.parameters = OpenSubstringParameters();
  e.cell = [](const auto* p, auto* cell) {
    if (!(ValueOf(p[0])[0] > 0)) return;  // all lanes have the same parameters
    constexpr double kNone = 0;           // light of cells that no current reaches
    cell->groups = cell->substrings = 2;
    cell->group[0] = {1.0 - p[0], 1.0, 0.0, 0};
    cell->group[1] = {p[0], kNone, 0.0, 1};
    cell->substring[1] = {true, cell->substring_cells, 0};
    cell->bypass = p[1];
    cell->bypass_ideality = p[2];
  };
  e.groups = true;
  e.why_not = [](const DataTraits& traits) {
    auto why = NeedsBypassedModule(traits);
    return why ? why : NeedsBypassDiodes(traits);
  };
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    for (const double share : LikelyShares(traits)) {
      probes.push_back({share, 0.4, kUsualBypassIdeality});
    }
    return probes;
  };
  e.starts = [](const CurveShape&, const DataTraits& traits, const auto&) {
    std::vector<ShapeStart> starts;
    for (const double share : LikelyShares(traits)) {
      for (const double drop : {0.25, 0.5}) {
        for (const double ideality : {1.1, 2.0}) {
          starts.push_back({{share, drop, ideality}, {}, 1 - share});
        }
      }
    }
    return starts;
  };
  return e;
}

}  // namespace lyrefit
