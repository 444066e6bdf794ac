#pragma once

#include <string>
#include <string_view>

namespace lyrefit {

// A label without the power of ten that it states beside its unit, as registers of inverters have
// them: "PV1 voltage (0.1V)", "Ipv1 x0.01 A", "U (V, gain 10)", "current_A scale 0.01".
struct ScaledLabel {
  std::string label;  // "PV1 voltage (V)"
  double scale = 1;   // what a written number is to be multiplied by
};

// A scale of 1 if the label states none.
ScaledLabel TakeScale(std::string_view label);

}  // namespace lyrefit
