#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/report/json.h"

namespace lyrefit {

// A file and what came of it: its fit, or why there is none.
struct FittedFile {
  std::string file;
  Expected<FitReport> report;
};

// One row a file, in their order: file, name, model, objective, cells_in_series, temperature_C,
// irradiance_Wm2, points; the parameters under their symbols and units (Iph_A, Is1_A, n1, Rs_ohm,
// ...), each followed by its standard error (Iph_A_se), as many as the largest model has; the RMSEs
// of the search and of the answer by both definitions; usable, warnings and error. What is not
// known is empty. Numbers read back to the same bits.
std::string FitsCsv(const std::vector<FittedFile>& fits);

// An array of what JsonReport writes, each with its "file"; {"file", "error"} where there is none.
std::string FitsJson(const std::vector<FittedFile>& fits, JsonPoints points = JsonPoints::kAll);

}  // namespace lyrefit
