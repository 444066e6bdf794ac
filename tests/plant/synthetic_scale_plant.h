#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "faults/field_draw.h"
#include "faults/field_tracer.h"

namespace made {

// A plant of WriteScalePlants before its curves are simulated.

constexpr double kZeroCelsius = 273.15;

// Types of modules: the plan's are 0 to 2, wrong ones any other.
constexpr faults::field::ModuleType kTypes[] = {{3, 60, 3, 9.6, 0.655},   {11, 72, 3, 9.1, 0.640},
                                                {19, 60, 3, 10.4, 0.690}, {27, 72, 3, 8.3, 0.625},
                                                {35, 54, 3, 8.8, 0.670},  {43, 60, 3, 8.6, 0.635}};
constexpr int kPlannedTypes = 3;

// How a string is planned, built and measured.
struct ScaleString {
  std::string id;
  int type = 0, modules = 0, strings = 1;  // planned
  int built_type = 0, built_modules = 0, built_strings = 1;
  int reversed = 0;
  int shorted_modules = 0, shorted_substrings = 0, open_substrings = 0;
  int shaded = 0;            // substrings in the shade of a pole
  bool degraded = false;     // shunts by potential
  double clean = 1;          // light that the glass passes
  double lead_ohm = 0;       // of each string
  double light_reading = 1;  // shown by the sensor over true
  double kelvin_reading = 0;
  std::string fault;  // empty: none
  double suns = 1, kelvin = 298;
  faults::field::Readings readings;
  double power = 0;  // largest, W
};

struct ScalePlant {
  std::vector<ScaleString> strings;
  double current_class = 1, voltage_class = 1;  // of its modules against their data sheet
};

// Draws plant `number`: how its strings are planned, built and measured.
ScalePlant DrawScalePlant(std::uint64_t seed, int number);

}  // namespace made
