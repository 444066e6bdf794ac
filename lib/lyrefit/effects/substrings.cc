#include "lyrefit/effects/catalogue_entries.h"
#include "lyrefit/effects/needs.h"

namespace lyrefit {
namespace {

constexpr int kGroups = 4;

}  // namespace

Effect Substrings() {
  Effect e;
  e.id = "substrings";
  e.title = "substrings under a light each";
  e.where = Where::kDevice;
  e.equation =
      "V = sum of w_k max(Vcell(I; x_k Iph), -Vb), a real diode for the maximum, "
      "w_k and x_k of up to four groups beside the brightest";
  e.reference = "Quaschning and Hanitsch 1996, doi:10.1016/0038-092X(96)00006-0";
  e.sentence = "parts of the module stand under different light, and their bypass diodes conduct";
  e.needs = "a curve of a module; the number of bypass diodes helps";
  e.acts = "at steps of the current, at fixed voltages";
  e.confused_with = {"shading", "irr_step"};
  e.separate_by = "repeat the sweep: shading stays at the same voltages, a cloud does not";
  static const char* const kNames[kGroups][4] = {{"d1", "light_deficit_1", "w1", "share_1"},
                                                 {"d2", "light_deficit_2", "w2", "share_2"},
                                                 {"d3", "light_deficit_3", "w3", "share_3"},
                                                 {"d4", "light_deficit_4", "w4", "share_4"}};
  for (const auto& names : kNames) {
    EffectParameter deficit = {names[0], names[1], "", "part of the light that the group misses",
                               0,        0.999,    0};
    EffectParameter share = {names[2], names[3], "", "part of the cells in it; 0: no such group",
                             0,        0.99,     0};
    share.absent_at = 0;
    deficit.held = share.held = true;
    e.parameters.push_back(deficit);
    e.parameters.push_back(share);
  }
  e.parameters.push_back(
      {"Vb", "bypass_voltage", "V", "drop of a bypass diode at Isc", 0.1, 1.2, 0.5});
  e.cell = [](const auto* p, auto* cell) {
    int kinds = 1;
    auto rest = 1.0 - p[1] * 0.0;
    for (int k = 0; k < kGroups; ++k) {
      const auto& share = p[2 * k + 1];
      if (!(ValueOf(share)[0] > 0)) continue;  // all lanes have the same parameters
      cell->kind[kinds] = {share, 1.0 - p[2 * k], 0.0, kinds};
      cell->part[kinds] = {true, cell->substring_cells, 0};
      rest = rest - share;
      ++kinds;
    }
    cell->kind[0] = {rest, 1.0, 0.0, 0};
    cell->part[0] = {false, cell->substring_cells, 0};  // the brightest are never in reverse
    cell->kinds = cell->parts = kinds;
    cell->bypass = p[2 * kGroups];
  };
  e.groups = true;
  e.found_by = FoundBy::kRequest;
  e.why_not = NeedsBypassedModule;
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.3, 1.0 / 3, 0, 0, 0, 0, 0, 0, 0.5},
                              {0.3, 1.0 / 3, 0.6, 1.0 / 3, 0, 0, 0, 0, 0.5}};
  };
  return e;
}

}  // namespace lyrefit
