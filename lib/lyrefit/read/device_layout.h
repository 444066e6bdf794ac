// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// How a device is built, by the sheet of its module or the plan of its plant. Unset: not stated.
struct DeviceLayout {
  std::optional<int> module_cells;       // cells in series in a module
  std::optional<int> module_diodes;      // bypass diodes of a module
  std::optional<int> modules_in_series;  // modules in series; a curve's own number counts before it
  std::string source;                    // where that stands: "module.json"
};

// Reads cells_in_series, bypass_diodes and modules_in_series of a module's sheet: JSON, or a file of
// ReadModuleSheet, which states cells alone. Errors: those of reading, a number below 1, in JSON a
// key that no sheet has.
Expected<DeviceLayout> ReadDeviceLayout(const std::string& file);

// Whether a file is a module's sheet in JSON and not a curve: an object all of whose keys are those of
// a sheet.
bool IsModuleSheet(const std::string& file);

// Fills in the cells in series and bypass diodes that the curve does not state, with an assumption:
// "1200 cells and 60 bypass diodes: 20 modules of 60 cells, module.json". Of stated cells the modules in
// series follow where nobody states these; bypass diodes of other modules than the cells make are left.
void FillLayout(const DeviceLayout& layout, IvCurve* curve);

}  // namespace lyrefit
