#pragma once

#include <optional>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// What somebody says of a measurement beside its file, which it goes before; unset: as the file has
// it.
struct ConditionOptions {
  std::optional<int> cells;             // in series
  std::optional<double> temperature_C;  // of the cells
  std::optional<double> irradiance_W_m2;
  bool as_is = false;
};

inline constexpr OptionRow<ConditionOptions> kConditionOptionTable[] = {
    OptionRow<ConditionOptions>("Conditions"),
    {"cells", "N", "cells in series", &ConditionOptions::cells, OptionTrait::kUnchecked},
    {"temperature-C", "T", "cell temperature in degrees Celsius", &ConditionOptions::temperature_C,
     OptionTrait::kUnchecked},
    {"irradiance-Wm2", "G", "irradiance in W/m2", &ConditionOptions::irradiance_W_m2,
     OptionTrait::kUnchecked},
    {"as-is", "", "take the readings as they are: what would be refused becomes a warning",
     &ConditionOptions::as_is},
};

// Puts them into `curve`, where they replace what was assumed. The error, whose sentence begins with
// the name of the option: fewer than one cell, a temperature outside -100 .. 150 C, an irradiance
// below zero.
Expected<void> ApplyConditions(const ConditionOptions& stated, IvCurve* curve);
// The same for every curve of a set, and for what is assumed of all of them.
Expected<void> ApplyConditions(const ConditionOptions& stated, CurveSet* set);

}  // namespace lyrefit
