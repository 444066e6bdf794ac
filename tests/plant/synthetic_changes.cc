#include "plant/synthetic_plant.h"

namespace made {
namespace {

using faults::Random;
using faults::field::Bypass;
using faults::field::Cell;
using faults::field::Group;
using faults::field::Module;

template <class Change>
void CellsOf(Module* module, const Change& change) {
  for (Group& group : module->groups) {
    for (Cell& cell : group.chains[0]) change(&cell);
  }
}

void Connector(double least, double most, Random* random, StringRig* rig) {
  rig->lead_ohm += random->Uniform(least, most);
}
void WarmConnector(Random* random, StringRig* rig) { Connector(0.7, 1.0, random, rig); }
void HotConnector(Random* random, StringRig* rig) { Connector(1.5, 2.0, random, rig); }
void BurntConnector(Random* random, StringRig* rig) { Connector(3, 4, random, rig); }

void ShortOne(Random* random, Module* module) {
  Group& group = module->groups[random->Index(3)];
  group.bypass = Bypass::kShorted;
  group.short_ohm = random->LogUniform(2e-3, 2e-2);
}
void ShortDiode(Random* random, StringRig* rig) { ShortOne(random, &rig->modules[3]); }
void ShortTwoDiodes(Random* random, StringRig* rig) {
  ShortOne(random, &rig->modules[5]);
  ShortOne(random, &rig->modules[14]);
}

void OtherTypes(int count, Random* random, StringRig* rig) {
  for (int m = 0; m < count; ++m) {
    rig->modules[7 + m] = DrawPlantModule(true, rig->suns, rig->kelvin, random);
  }
}
void OneOfAnotherType(Random* random, StringRig* rig) { OtherTypes(1, random, rig); }
void ThreeOfAnotherType(Random* random, StringRig* rig) { OtherTypes(3, random, rig); }

void Soil(double least, double most, Random* random, StringRig* rig) {
  const double light = random->Uniform(least, most);
  for (Module& module : rig->modules) {
    CellsOf(&module, [&](Cell* cell) { cell->photocurrent *= light; });
  }
}
void Dust(Random* random, StringRig* rig) { Soil(0.93, 0.95, random, rig); }
void Dirt(Random* random, StringRig* rig) { Soil(0.86, 0.90, random, rig); }

void Shunted(double strength, Random* random, StringRig* rig) {
  constexpr int kHit = 8;
  for (int m = 0; m < kHit; ++m) {
    const double part = strength * (1 - static_cast<double>(m) / kHit);
    CellsOf(&rig->modules[m], [&](Cell* cell) {
      cell->shunt_S += cell->photocurrent / 0.6 * part * random->LogUniform(0.5, 2);
    });
  }
}
void EarlyPid(Random* random, StringRig* rig) { Shunted(0.05, random, rig); }
void LatePid(Random* random, StringRig* rig) { Shunted(0.15, random, rig); }

void RemoveModule(Random*, StringRig* rig) { rig->modules.pop_back(); }
void RemoveTwo(Random*, StringRig* rig) { rig->modules.resize(rig->modules.size() - 2); }

void GrownTree(Random* random, StringRig* rig) {
  for (int m = 0; m < 4; ++m) {
    Group& group = rig->modules[m].groups[0];
    const double light = random->Uniform(0.55, 0.7);
    for (Cell& cell : group.chains[0]) cell.photocurrent *= light;
  }
}

// What one sweep of each campaign cannot tell apart is accepted alike.
constexpr const char* kResistance = "series_resistance|fill_factor";
constexpr const char* kSubstrings = "substrings";
constexpr const char* kLight = "light";
constexpr const char* kKnee = "shunt|mismatch|shunt_or_mismatch|fill_factor|several";

}  // namespace

const std::vector<PlantChange>& PlantChanges() {
  constexpr ChangeOf kDevice = ChangeOf::kDevice;
  static const std::vector<PlantChange> kChanges = {
      {"warm_connector", kResistance, "a connector with 0.7 to 1 ohm more", kDevice, WarmConnector},
      {"hot_connector", kResistance, "a connector with 1.5 to 2 ohm more", kDevice, HotConnector},
      {"burnt_connector", kResistance, "a connector with 3 to 4 ohm more", kDevice, BurntConnector},
      {"short_diode", kSubstrings, "a bypass diode is shorted", kDevice, ShortDiode},
      {"short_diodes", kSubstrings, "two bypass diodes are shorted", kDevice, ShortTwoDiodes},
      {"other_type", kKnee, "a module of less current in place of one", kDevice, OneOfAnotherType},
      {"other_types", kKnee, "three of them", kDevice, ThreeOfAnotherType},
      {"dust", kLight, "5 to 7 % less light on all modules", kDevice, Dust},
      {"dirt", kLight, "10 to 14 % less light on all modules", kDevice, Dirt},
      {"early_pid", kKnee, "shunts from one end of the string", kDevice, EarlyPid},
      {"late_pid", kKnee, "three times as many", kDevice, LatePid},
      {"module_removed", kSubstrings, "19 modules where there were 20", kDevice, RemoveModule},
      {"modules_removed", kSubstrings, "18 modules where there were 20", kDevice, RemoveTwo},
      {"grown_tree", kKnee, "a group of cells of four modules in shade", kDevice, GrownTree},
      {"cleaned", kLight, "the soiled string was cleaned", ChangeOf::kRepair, nullptr,
       "soiled_string"},
      {"exchanged", "exchanged", "exchanged with a string without a fault", ChangeOf::kExchange,
       nullptr, "missing_module"},
      {"exchanged_too", "exchanged", "exchanged with a string without a fault", ChangeOf::kExchange,
       nullptr, "bad_connector"},
      {"renamed", "renamed|new", "has another name", ChangeOf::kName},
      {"gone", "gone", "is not measured any more", ChangeOf::kGone},
      {"new", "new", "was not there", ChangeOf::kNew},
  };
  return kChanges;
}

}  // namespace made
