#pragma once

#include <string>
#include <vector>

#include "faults/device.h"

namespace faults {

enum class Kind { kForward, kReverse, kUpDown, kDark, kIrradiances, kConditions };
constexpr int kKinds = 6;
const char* Name(Kind kind);  // "fwd", "rev", "updown", "dark", "famG", "famGT"
std::vector<Kind> KindsCalled(const std::string& name);  // "all" or one name

// Settings of a reading and the values that the sensors show.
struct Setting {
  double voltage = 0;  // V at the terminals of the whole device
  double time_s = 0;
  int sweep = 0;
  int curve = 0;
  double suns = 1;
  double kelvin = kReferenceK;
};

struct Plan {
  Kind kind = Kind::kForward;
  bool even = true;    // equal voltage steps
  bool times = false;  // the measurement has times
  std::vector<Setting> settings;

  double X(double time_s) const;  // time scaled to -1/2 .. 1/2
  double Rate() const;            // mean |dV/dt| of the whole device, V/s
};

Plan DrawPlan(Kind kind, const Device& device, Random* random);

}  // namespace faults
