#include "plant/synthetic_plant.h"

namespace made {
namespace {

using faults::Random;
using faults::field::Bypass;
using faults::field::Cell;
using faults::field::Cloud;
using faults::field::Group;
using faults::field::Module;

Module* AnyModule(Random* random, StringRig* rig) {
  return &rig->modules[random->Index(static_cast<int>(rig->modules.size()))];
}

template <class Change>
void EachCell(Group* group, const Change& change) {
  for (auto& chain : group->chains) {
    for (Cell& cell : chain) change(&cell);
  }
}

void Dim(double light, Group* group) {
  EachCell(group, [&](Cell* cell) { cell->photocurrent *= light; });
}

void SoiledString(Random* random, StringRig* rig) {
  const double light = random->Uniform(0.88, 0.92);
  for (Module& module : rig->modules) {
    for (Group& group : module.groups) Dim(light, &group);
  }
}

void SoiledEdge(Random* random, StringRig* rig) {
  for (Module& module : rig->modules) Dim(random->Uniform(0.82, 0.94), &module.groups[0]);
}

void PoleShadow(Random* random, StringRig* rig) {
  Module* module = AnyModule(random, rig);
  Dim(random->Uniform(0.25, 0.45), &module->groups[0]);
  Dim(random->Uniform(0.45, 0.7), &module->groups[1]);
}

void RowShadow(Random* random, StringRig* rig) {
  const int count = 5 + random->Index(3);
  for (int m = 0; m < count; ++m) {
    Dim(random->Uniform(0.5, 0.6), &rig->modules[m].groups[0]);
  }
}

void ShortedDiodes(Random* random, StringRig* rig) {
  for (const int m : {random->Index(10), 10 + random->Index(10)}) {
    Group& group = rig->modules[m].groups[random->Index(3)];
    group.bypass = Bypass::kShorted;
    group.short_ohm = random->LogUniform(2e-3, 2e-2);
  }
}

void MissingModule(Random*, StringRig* rig) { rig->modules.pop_back(); }

void BadConnector(Random* random, StringRig* rig) { rig->lead_ohm += random->Uniform(2, 3); }

// Potential-induced degradation is strongest at the end of the string with the lowest potential to
// earth.
void Degraded(Random* random, StringRig* rig) {
  constexpr int kHit = 9;
  for (int m = 0; m < kHit; ++m) {
    const double strength = 1 - static_cast<double>(m) / kHit;
    for (Group& group : rig->modules[m].groups) {
      EachCell(&group, [&](Cell* cell) {
        cell->shunt_S += cell->photocurrent / 0.6 * 0.15 * strength * random->LogUniform(0.5, 2);
      });
    }
  }
}

void CrackedCell(Random* random, StringRig* rig) {
  auto& chain = AnyModule(random, rig)->groups[random->Index(3)].chains[0];
  chain[random->Index(static_cast<int>(chain.size()))].photocurrent *= random->Uniform(0.5, 0.65);
}

void CloudStep(Random* random, StringRig* rig) {
  rig->sky.cloud = Cloud::kStep;
  rig->sky.at = random->Uniform(0.35, 0.75);
  rig->sky.size = -random->Uniform(0.04, 0.10);
}

void CloudDip(Random* random, StringRig* rig) {
  rig->sky.cloud = Cloud::kDip;
  rig->sky.at = random->Uniform(0.35, 0.75);
  rig->sky.width = random->Uniform(0.06, 0.12);
  rig->sky.size = random->Uniform(0.05, 0.12);
}

void OpenDiode(Random* random, StringRig* rig) {
  Group& group = AnyModule(random, rig)->groups[random->Index(3)];
  group.bypass = Bypass::kOpen;
  auto& chain = group.chains[0];
  chain[random->Index(static_cast<int>(chain.size()))].photocurrent *= random->Uniform(0.5, 0.7);
}

// One curve cannot distinguish bypassed cells from a wrong cell count or a higher temperature, nor
// uniform soiling from a light sensor that reads high.
constexpr const char* kLessVoltage =
    "bypass_short|temperature_or_cells|temp_offset|voltage_offset|Voc-";
constexpr const char* kLessCurrent = "soiling|sensor_offset|Isc/G-";
constexpr const char* kDimGroups = "substrings|shading|weak_cell|scatter|mismatch";

}  // namespace

const std::vector<PlantFault>& PlantFaults() {
  static const std::vector<PlantFault> kFaults = {
      {"soiled_string", kLessCurrent, "neighbours", "dirt on every module alike", SoiledString},
      {"soiled_edge", kDimGroups, "curve", "dirt along the lower edge of every module", SoiledEdge},
      {"pole_shadow", kDimGroups, "curve", "two groups of cells of one module in shade",
       PoleShadow},
      {"row_shadow", kDimGroups, "curve", "the row in front shades a group of several modules",
       RowShadow},
      {"shorted_diodes", kLessVoltage, "neighbours", "a bypass diode of two modules is shorted",
       ShortedDiodes},
      {"missing_module", kLessVoltage, "neighbours", "19 modules where 20 are stated",
       MissingModule},
      {"bad_connector", "series_resistance|Rs+|FF-", "neighbours",
       "a connector with two to three ohm", BadConnector},
      {"degraded", "shunt|Rsh-|nonohmic_shunt|photoshunt|leaky_cell|graded_shunt|FF-", "neighbours",
       "potential-induced degradation from one end of the string", Degraded},
      {"cracked_cell", "weak_cell|substrings|shading", "curve",
       "one cell has lost a part of itself", CrackedCell},
      {"cloud_step", "irr_step|transient|drift", "curve", "the light changes during the sweep",
       CloudStep, /*of_sweep=*/true},
      {"cloud_dip", "transient|irr_step|drift", "curve", "a small cloud passes during the sweep",
       CloudDip, /*of_sweep=*/true},
      {"open_diode", "bypass_open|weak_cell|breakdown|substrings|shading", "curve",
       "a dim cell in a group whose bypass diode is open", OpenDiode},
  };
  return kFaults;
}

}  // namespace made
