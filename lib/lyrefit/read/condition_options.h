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

// Conditions that the user states for a measurement. They replace those of the file; unset fields
// keep the file's values.
struct ConditionOptions {
  std::optional<int> cells;             // in series
  std::optional<double> temperature_C;  // of the cells
  std::optional<double> irradiance_W_m2;
  std::string technology;  // empty: as the file has it
  bool as_is = false;
};

inline constexpr OptionRow<ConditionOptions> kConditionOptionTable[] = {
    OptionRow<ConditionOptions>("Conditions"),
    {"cells", "N", "cells in series", &ConditionOptions::cells, OptionTrait::kUnchecked},
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

// Sets the stated conditions in `curve` and removes the assumptions about them. Errors, whose
// sentence begins with the option's name: fewer than one cell, a temperature outside -100 .. 150 C,
// an irradiance below zero, a technology that is not known.
Expected<void> ApplyConditions(const ConditionOptions& stated, IvCurve* curve);
// Applies the conditions to every curve of a set and to the set's common assumptions.
Expected<void> ApplyConditions(const ConditionOptions& stated, CurveSet* set);

}  // namespace lyrefit
