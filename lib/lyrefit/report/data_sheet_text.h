#pragma once

#include <string>

#include "lyrefit/family/data_sheet.h"

namespace lyrefit {

// The device behind a data sheet, and what it gives of what was printed, for a terminal.
std::string DataSheetText(const DataSheetFit& fit);

}  // namespace lyrefit
