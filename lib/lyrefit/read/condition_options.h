// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Conditions that the user states for a measurement. Unset fields keep the file's values.
struct ConditionOptions {
  std::optional<int> cells;             // in series
  std::optional<int> bypass_diodes;     // of the whole device; 0: it has none
  std::optional<double> temperature_C;  // of the cells
  std::optional<double> irradiance_W_m2;
  std::string technology;  // empty: as the file has it
  bool as_is = false;
  // Replaces what the file states; else only what it does not state is taken from here.
  bool replaces = true;
};

inline constexpr OptionRow<ConditionOptions> kConditionOptionTable[] = {
    OptionRow<ConditionOptions>("Conditions"),
    {"cells", "N", "cells in series", &ConditionOptions::cells, OptionTrait::kUnchecked},
    {"bypass-diodes", "N", "of the whole device, all modules of a string together; 0: it has none",
     &ConditionOptions::bypass_diodes, OptionTrait::kUnchecked | OptionTrait::kExperimental},
    {"temperature-C", "T", "cell temperature in degrees Celsius", &ConditionOptions::temperature_C,
     OptionTrait::kUnchecked},
    {"irradiance-Wm2", "G", "irradiance in W/m2", &ConditionOptions::irradiance_W_m2,
     OptionTrait::kUnchecked},
    {"technology", "NAME",
     "of the cells: c-Si, HJT, CdTe, CIGS, a-Si, GaAs, perovskite, organic, ...",
     &ConditionOptions::technology},
    {"as-is", "", "take the readings as they are: what would be refused becomes a warning",
     &ConditionOptions::as_is},
};

// Sets the stated conditions in `curve` and removes the assumptions about them. Where the file states
// another value, the assumptions say which of both counts: "20 C given, instead of 49.8 C in line 9".
// Errors, whose sentence begins with the option's name: fewer than one cell, fewer bypass diodes than
// none, a temperature outside -100 .. 150 C, an irradiance outside 0 .. 1e7 W/m2, a technology that is not known.
Expected<void> ApplyConditions(const ConditionOptions& stated, IvCurve* curve);
// Applies the conditions to every curve of a set and to the set's common assumptions.
Expected<void> ApplyConditions(const ConditionOptions& stated, CurveSet* set);

}  // namespace lyrefit
