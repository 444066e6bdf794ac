#pragma once

#include <string>

#include "lyrefit/family/data_sheet.h"

namespace lyrefit {

// The same as JSON, keys in a fixed order, pvlib's names for parameters. NaN and infinity are null.
std::string DataSheetJson(const DataSheetFit& fit);

}  // namespace lyrefit
