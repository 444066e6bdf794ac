// Effects of shade, damage and snow on a module.
#include <algorithm>
#include <cmath>

#include "faults/field_case.h"

namespace faults::field {
namespace {

Group* AnyGroup(Random* random, Module* module) {
  return &module->groups[random->Index(static_cast<int>(module->groups.size()))];
}

double Share(const Module& module) { return 1.0 / static_cast<double>(module.groups.size()); }

// Light of a group, relative to full light, if `dim_chains` of its parallel chains have `light`.
double LeftOfGroup(const Group& group, double light, std::size_t dim_chains) {
  const double chains = static_cast<double>(group.chains.size());
  return (dim_chains * light + chains - dim_chains) / chains;
}

// Dims all cells of the group or a large part of them; in half-cut modules possibly only one half.
// Returns the relative light of the group.
double Shade(double light, Random* random, Group* group) {
  const std::size_t dim = random->Chance(0.5) ? 1 : group->chains.size();
  const double part = random->Chance(0.6) ? 1 : random->Uniform(0.3, 1);
  for (std::size_t k = 0; k < dim; ++k) {
    const int cells = static_cast<int>(std::ceil(part * group->chains[k].size()));
    for (int c = 0; c < cells; ++c) group->chains[k][c].photocurrent *= light;
  }
  return LeftOfGroup(*group, light, dim);
}

void Substrings(Random* random, Rig* rig, Truth* truth) {
  auto& groups = rig->module.groups;
  const double share = Share(rig->module);
  truth->accepted = {"substrings", "shading"};
  const double first = Shade(random->Uniform(0.05, 0.95), random, &groups[0]);
  truth->figures = {{"light", first}, {"share", share}};
  if (groups.size() < 3 || random->Chance(0.5)) return;
  const double second = Shade(random->Uniform(0.05, 0.95), random, &groups[1]);
  truth->figures.push_back({"light", second});
  truth->figures.push_back({"share", share});
  truth->accepted = {"substrings", "shading"};
}

double DimCells(double light, int count, Random* random, Group* group) {
  auto& chain = group->chains[random->Index(static_cast<int>(group->chains.size()))];
  const int first = random->Index(static_cast<int>(chain.size()) - count);
  for (int c = first; c < first + count; ++c) chain[c].photocurrent *= light;
  return LeftOfGroup(*group, light, 1);
}

void WeakCell(Random* random, Rig* rig, Truth* truth) {
  const int count = random->Chance(0.7) ? 1 : 2 + random->Index(2);
  Group* group = AnyGroup(random, &rig->module);
  const double light = DimCells(random->Uniform(0.10, 0.93), count, random, group);
  truth->accepted = {"weak_cell"};
  // Several dim cells of one substring also count as shade on part of the substring.
  if (count > 1) truth->accepted.insert(truth->accepted.end(), {"shading", "substrings"});
  truth->figures = {{"light", light}};
}

void LeakyCell(Random* random, Rig* rig, Truth* truth) {
  auto& chain = AnyGroup(random, &rig->module)->chains[0];
  Cell& cell = chain[random->Index(static_cast<int>(chain.size()))];
  cell.shunt_S = cell.photocurrent / 0.6 * random->LogUniform(0.3, 4);
  truth->accepted = {"leaky_cell"};
  truth->figures = {{"leak", cell.shunt_S}};
}

// The scatter is symmetric, or skewed: most cells slightly above the mean and few far below.
void Scatter(Random* random, Rig* rig, Truth* truth) {
  const double width = random->Uniform(0.01, 0.04);
  const bool lopsided = random->Chance(0.5);
  double sum = 0, squares = 0;
  int count = 0;
  for (Group& group : rig->module.groups) {
    for (auto& chain : group.chains) {
      for (Cell& cell : chain) {
        const double z = lopsided ? 1 + std::log(random->Unit()) : random->Normal();
        const double factor = std::max(0.8, 1 + width * z);
        cell.photocurrent *= factor;
        sum += factor;
        squares += factor * factor;
        ++count;
      }
    }
  }
  const double mean = sum / count;
  truth->accepted = {"scatter", "mismatch"};
  truth->figures = {{"width", std::sqrt(squares / count - mean * mean) / mean}};
}

// One curve cannot distinguish a bypassed third of the cells from a wrong cell count.
void BypassShort(Random* random, Rig* rig, Truth* truth) {
  Group* group = AnyGroup(random, &rig->module);
  group->bypass = Bypass::kShorted;
  group->short_ohm = random->LogUniform(1e-3, 2e-2);
  truth->accepted = {"bypass_short", "temperature_or_cells"};
  truth->figures = {{"share", Share(rig->module)}};
}

void BypassOpen(Random* random, Rig* rig, Truth* truth) {
  Group* group = AnyGroup(random, &rig->module);
  group->bypass = Bypass::kOpen;
  const double light = DimCells(random->Uniform(0.10, 0.90), 1, random, group);
  truth->accepted = {"bypass_open", "weak_cell"};
  truth->figures = {{"light", light}};
}

// The loss rises from group to group and, within each group, from cell to cell.
void Snow(Random* random, Rig* rig, Truth* truth) {
  const double thinnest = random->Uniform(0.3, 1);
  double light = thinnest;
  for (Group& group : rig->module.groups) {
    const double slope = random->Uniform(0, 0.15);
    for (auto& chain : group.chains) {
      for (std::size_t c = 0; c < chain.size(); ++c) {
        const double place = static_cast<double>(c) / chain.size();
        chain[c].photocurrent *= light * (1 - slope * place);
      }
    }
    light *= random->Uniform(0.25, 0.95);
  }
  truth->accepted = {"substrings", "shading"};
}

}  // namespace

const std::vector<Fault>& DeviceFaults() {
  static const std::vector<Fault> kFaults = {
      {"substrings", Substrings},
      {"weak_cell", WeakCell},
      {"leaky_cell", LeakyCell},
      {"scatter", Scatter},
      {"bypass_short", BypassShort},
      {"bypass_open", BypassOpen},
      {"snow", Snow},
  };
  return kFaults;
}

}  // namespace faults::field
