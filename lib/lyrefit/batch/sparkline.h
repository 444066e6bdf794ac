// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A curve as a tiny picture (sparkline), for pages with many curves.

// Number of currents in a sparkline.
constexpr int kSparklinePoints = 24;

// The currents at kSparklinePoints even voltages from 0 to `open_circuit_voltage_V`, or to the
// largest voltage if that is unknown. Each current is a byte in 1/255 of the largest of them. The
// result is base64 (RFC 4648) of 32 letters. Currents below 0 become 0. Values are interpolated
// linearly between readings, which may be in any order. Empty without a positive current.
std::string Sparkline(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                      double open_circuit_voltage_V);

// The currents of a text written by Sparkline, relative to the largest; empty if `text` is invalid.
std::vector<double> ReadSparkline(const std::string& text);

}  // namespace lyrefit
