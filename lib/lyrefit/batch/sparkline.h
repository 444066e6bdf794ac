#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A curve as small as a stamp, for pages with many of them.

// Currents in a sketch.
constexpr int kSparklinePoints = 24;

// The currents at kSparklinePoints even voltages from 0 to `open_circuit_voltage_V` (to the largest
// voltage where that is not known), each as a byte, in 1/255 of the largest of them, as base64
// (RFC 4648): 32 letters. Currents below 0 are 0; between readings, which may stand in any order,
// they are linear. Empty where there is nothing to draw.
std::string Sparkline(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                   double open_circuit_voltage_V);

// What Sketch wrote, in parts of the largest current; empty where `text` is none.
std::vector<double> ReadSparkline(const std::string& text);

}  // namespace lyrefit
