#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "trend/made_sweeps.h"

namespace lyrefit {

inline const char* const kSweepsHead =
    "date,irradiance_Wm2,temperature_C,cells_in_series,bypass_diodes,voltage_V,current_A\n";

inline std::string ListText(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.5f}", text.empty() ? "" : " ", value);
  return text;
}

// A sweep as a row under kSweepsHead.
inline std::string SweepRow(const TimedSweep& sweep) {
  const Conditions& at = sweep.curve.conditions;
  return fmt::format("{},{:.2f},{:.3f},{},{},{},{}\n", DateTimeText(sweep.time_s),
                     at.irradiance_W_m2, at.cell_temperature_K - kZeroCelsius_K, at.cells_in_series,
                     sweep.curve.notes.bypass_diodes.value_or(0), ListText(sweep.curve.voltage_V),
                     ListText(sweep.curve.current_A));
}

inline std::string SweepsText(const std::vector<TimedSweep>& sweeps) {
  std::string text = kSweepsHead;
  for (const TimedSweep& sweep : sweeps) text += SweepRow(sweep);
  return text;
}

}  // namespace lyrefit
