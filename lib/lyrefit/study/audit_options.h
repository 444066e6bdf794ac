#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/law/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Checks published parameter rows against the curves they are said to fit: does the claimed RMSE
// come out of the printed digits, and if not, which plain mistake brings it back?

// How a table of published parameters is checked.
struct AuditOptions {
  // Folders to look for curves in, after the folder of the rows and its parent.
  std::vector<std::string> curve_folders;
  // Of rows that do not say. Unset: all three sets are tried, and those that fit are named.
  std::optional<ConstantSet> constants;
  Objective objective = Objective::kMeasuredCurrent;  // what the claims are of
};

inline constexpr OptionRow<AuditOptions> kAuditOptionTable[] = {
    {"curves", "DIR", "a folder to look for the devices' curves in; may be repeated",
     &AuditOptions::curve_folders},
    {"constants", "NAME", "values of k and q of rows that do not say",
     EnumOption<&AuditOptions::constants>(), OptionTrait::kNone, ": any"},
    {"objective", "NAME", "which RMSE the claims are of", EnumOption<&AuditOptions::objective>()},
};

}  // namespace lyrefit
