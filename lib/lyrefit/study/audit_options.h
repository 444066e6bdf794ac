// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Checks published parameter rows against the curves they are said to fit. It computes whether the
// claimed RMSE follows from the printed digits, and otherwise which simple mistake explains it.

// How a table of published parameters is checked.
struct AuditOptions {
  // Folders that are searched for curves, after the folder of the rows and its parent.
  std::vector<std::string> curve_folders;
  // Constants k and q of rows that state none. Unset: all three sets are tried, and the matching
  // ones are reported.
  std::optional<ConstantSet> constants;
  Objective objective = Objective::kMeasuredCurrent;  // objective of the claimed RMSEs
};

inline constexpr OptionRow<AuditOptions> kAuditOptionTable[] = {
    {"curves", "DIR", "a folder to look for the devices' curves in; may be repeated",
     &AuditOptions::curve_folders},
    {"constants", "NAME", "values of k and q of rows that do not say",
     EnumOption<&AuditOptions::constants>(), OptionTrait::kNone, ": any"},
    {"objective", "NAME", "which RMSE the claims are of", EnumOption<&AuditOptions::objective>()},
};

}  // namespace lyrefit
