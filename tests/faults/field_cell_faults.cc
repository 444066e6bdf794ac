// Faults of single cells and of parts of every group, and groups that give nothing.
#include <algorithm>
#include <cmath>

#include "faults/field_case.h"

namespace faults::field {
namespace {

double Share(const Module& module) { return 1.0 / static_cast<double>(module.groups.size()); }

// Snow or dirt on the lower edge: some cells of every group are dim, and a few more or fewer from
// group to group. In a half-cut module the edge is that of one half.
void CoveredEdge(Random* random, Rig* rig, Truth* truth) {
  const int usual = 1 + random->Index(5);
  for (Group& group : rig->module.groups) {
    const double light = random->Uniform(0.25, 0.8);
    auto& chain = group.chains[0];
    const int most = static_cast<int>(chain.size()) - 1;
    const int cells = std::clamp(usual + random->Index(3) - 1, 1, most);
    for (int c = 0; c < cells; ++c) chain[c].photocurrent *= light;
    const double chains = static_cast<double>(group.chains.size());
    const double left = (light + chains - 1) / chains;
    truth->figures.push_back({"light", left});
    truth->figures.push_back({"share", Share(rig->module)});
  }
  truth->accepted = {"covered_edge", "substrings", "shading"};
}

// Leaves or droppings: two to five single cells with a light each, in one or several groups.
void DimCells(Random* random, Rig* rig, Truth* truth) {
  auto& groups = rig->module.groups;
  const int count = 2 + random->Index(4);
  const bool together = random->Chance(0.4);
  int group = random->Index(static_cast<int>(groups.size()));
  for (int k = 0; k < count; ++k) {
    if (!together) group = random->Index(static_cast<int>(groups.size()));
    auto& chain = groups[group].chains[0];
    Cell& cell = chain[static_cast<std::size_t>(k) * chain.size() / count];
    const double light = random->Uniform(0.15, 0.9);
    cell.photocurrent *= light;
    const double chains = static_cast<double>(groups[group].chains.size());
    truth->figures.push_back({"light", (light + chains - 1) / chains});
  }
  truth->accepted = {"dim_cells", "weak_cell", "substrings", "shading"};
}

// Potential-induced degradation: the cells leak more towards one end of the string, by a power or
// an exponential of their place, no two alike, and recombine more.
void GradedShunt(Random* random, Rig* rig, Truth* truth) {
  const bool power = random->Chance(0.5);
  const double steep = power ? random->Uniform(1, 4) : random->Uniform(2, 7);
  const double most = random->LogUniform(0.1, 3);  // of the photocurrent, at 0.6 V
  const double cells = rig->module.CellsInSeries();
  double at = 0, sum = 0;
  for (Group& group : rig->module.groups) {
    for (std::size_t c = 0; c < group.chains[0].size(); ++c, ++at) {
      const double place = (at + 0.5) / cells;
      const double part = power ? std::pow(place, steep) : std::exp(steep * (place - 1));
      for (auto& chain : group.chains) {
        Cell& cell = chain[c];
        const double leak = most * part * std::exp(0.3 * random->Normal());
        cell.shunt_S += leak * cell.photocurrent / 0.6;
        cell.recombination_A *= 1 + 3 * part;
        sum += leak * cell.photocurrent / 0.6;
      }
    }
  }
  truth->accepted = {"graded_shunt", "leaky_cell"};
  truth->figures = {{"leak", sum / cells}};
}

// Cuts every chain of a module of three groups into a quarter, a half and a quarter.
void CutUnlike(Module* module) {
  auto& groups = module->groups;
  for (std::size_t k = 0; k < groups[0].chains.size(); ++k) {
    std::vector<Cell> all;
    for (const Group& group : groups) {
      all.insert(all.end(), group.chains[k].begin(), group.chains[k].end());
    }
    const auto quarter = static_cast<std::ptrdiff_t>(all.size() / 4);
    groups[0].chains[k].assign(all.begin(), all.begin() + quarter);
    groups[1].chains[k].assign(all.begin() + quarter, all.end() - quarter);
    groups[2].chains[k].assign(all.end() - quarter, all.end());
  }
}

// Shade on one or two groups, or one dim cell, in a module whose middle group is twice as large.
void UnlikeGroups(Random* random, Rig* rig, Truth* truth) {
  auto& groups = rig->module.groups;
  if (groups.size() == 3 && rig->module.CellsInSeries() % 4 == 0) CutUnlike(&rig->module);
  const int dim_groups = random->Chance(0.3) ? 2 : 1;
  const int first = random->Index(static_cast<int>(groups.size()));
  const bool one_cell = random->Chance(0.3);
  for (int g = 0; g < dim_groups; ++g) {
    Group& group = groups[(first + g) % groups.size()];
    const double light = random->Uniform(0.1, 0.9);
    for (auto& chain : group.chains) {
      const std::size_t cells = one_cell ? 1 : chain.size();
      for (std::size_t c = 0; c < cells; ++c) chain[c].photocurrent *= light;
    }
    truth->figures.push_back({"light", light});
  }
  truth->accepted = {"substrings", "shading", "covered_edge"};
  if (one_cell) truth->accepted.insert(truth->accepted.end(), {"weak_cell", "dim_cells"});
}

// Cells of half the area, in two chains in parallel.
void CutInHalves(Module* module) {
  for (Group& group : module->groups) {
    if (group.chains.size() > 1) continue;
    for (Cell& cell : group.chains[0]) {
      cell.photocurrent /= 2;
      cell.diffusion_A /= 2;
      cell.recombination_A /= 2;
      cell.shunt_S /= 2;
      cell.series_ohm *= 2;
      cell.reverse_A /= 2;
    }
    group.chains.push_back(group.chains[0]);
  }
}

// A dim cell in each half of a group of a half-cut module, or a dim part of each half.
void BothHalves(Random* random, Rig* rig, Truth* truth) {
  CutInHalves(&rig->module);
  Group* group = &rig->module.groups[random->Index(static_cast<int>(rig->module.groups.size()))];
  const bool one_cell = random->Chance(0.6);
  double sum = 0;
  for (auto& chain : group->chains) {
    const double light = random->Uniform(0.1, 0.9), part = random->Uniform(0.1, 1);
    const double count = one_cell ? 1 : std::ceil(part * static_cast<double>(chain.size()));
    for (std::size_t c = 0; c < count; ++c) chain[c].photocurrent *= light;
    if (one_cell && random->Chance(0.5)) chain.back().photocurrent *= random->Uniform(light, 1);
    sum += light / 2;
  }
  truth->accepted = {"dim_cells", "weak_cell", "substrings", "shading", "covered_edge"};
  truth->figures = {{"light", sum}, {"share", Share(rig->module)}};
}

// A broken ribbon: no cell of the group carries current, so that its diode carries all.
void OpenGroup(Random* random, Rig* rig, Truth* truth) {
  auto& groups = rig->module.groups;
  const int count = groups.size() > 2 && random->Chance(0.25) ? 2 : 1;
  for (int g = 0; g < count; ++g) groups[g].broken = true;
  truth->accepted = {"open_substring", "bypass_short", "temperature_or_cells"};
  truth->figures = {{"share", count * Share(rig->module)}};
}

}  // namespace

const std::vector<Fault>& CellFaults() {
  static const std::vector<Fault> kFaults = {
      {"covered_edge", CoveredEdge}, {"open_group", OpenGroup},       {"dim_cells", DimCells},
      {"graded_shunt", GradedShunt}, {"unlike_groups", UnlikeGroups}, {"both_halves", BothHalves}};
  return kFaults;
}

}  // namespace faults::field
