#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/law/device.h"

namespace lyrefit {

struct AuditOptions {
  // Folders to look for curves in, after the folder of the rows and its parent.
  std::vector<std::string> curve_folders;
  // Of rows that do not say. Unset: all three sets are tried, and those that fit are named.
  std::optional<ConstantSet> constants;
  Objective objective = Objective::kMeasuredCurrent;  // what the claims are of
};

}  // namespace lyrefit
