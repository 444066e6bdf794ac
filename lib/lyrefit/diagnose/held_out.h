#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Assigns readings to folds that are left out together. With three or more sweeps (curves, or up
// and down sweeps within them) a fold holds whole sweeps, else short contiguous blocks spread over
// the sweep. Returns one fold per reading, 0 .. folds - 1.
std::vector<int> MakeFolds(const Readings& readings, int folds);

// Whether MakeFolds leaves out whole sweeps.
bool LeavesSweepsOut(const Readings& readings);

// Errors on readings that were not fitted, in ampere.
struct HeldOutErrors {
  double before_A = kUnknown;  // of the base model
  double after_A = kUnknown;   // of the whole selection, repeated
  double gain_A2 = kUnknown;   // mean difference of squares over the folds
  double gain_error_A2 = kUnknown;
  int folds = 0;                            // whose fits succeeded
  bool by_sweeps = false;                   // the folds were whole sweeps
  std::map<std::string, double> effects_A;  // of each effect tried, by its id; some may be missing

  // Whether the gain is larger than its standard error.
  bool gained() const { return folds > 1 && gain_A2 > gain_error_A2; }
};

// For every fold, the base model, each effect and the whole selection are fitted without the fold
// and evaluated on it. No folds after a stop request.
HeldOutErrors MeasureHeldOut(const Measurement& measurement, const SelectOptions& options,
                             const Selection& selection, int folds, int threads);

}  // namespace lyrefit
