#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/weighted_data.h"
#include "lyrefit/estimate/fit/fit_report.h"

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

// Parameters of effect `index` of a fit in reporting units, with symmetric 95 % intervals cut at
// the bounds.
std::vector<CauseParameter> DescribeParameters(const WeightedData& weighted, const LawFit& fit,
                                               int index);

// One trial for each of the `known` effects, whether fitted or not.
std::vector<Trial> DescribeTrials(const Readings& readings, const Selection& selection,
                                  const std::vector<const Effect*>& known,
                                  const std::vector<const Effect*>& candidates,
                                  const HeldOutErrors& held_out, const DiagnoseOptions& options);

// A cause without size and place. `evidence`: "fit" or "values".
Cause MakeCause(const Effect& effect, const char* evidence, double probability);

// A size whose interval does not go below 0.
Sized NotBelowZero(const Sized& size);

// The causes found, their equivalents and the readings at which they act.
std::vector<Cause> DescribeCauses(const Selection& selection, const AtReadings& at,
                                  const ValueFindings& values);

// The findings of the effects that were tried with the base model alone, most probable first.
std::vector<Alternative> TriedAlone(const Selection& selection);

// Fills what the device would give more without the causes, all together, and whether that is a
// lower limit. The causes are described.
void DescribeRecoverable(const Selection& selection, Verdict* verdict);

// Significant effects that are too small to be named: the best one, with its equivalents.
std::vector<Cause> DescribeBelow(const Selection& selection);

// Base parameters and maximum power of the device, with and without the causes.
std::vector<ParameterShift> DescribeShifts(const Selection& selection);

// Size of effect number `index` of a fit for a technician: in the effect's own words
// (Effect::in_words), else the largest change of the current. `strength`: its parameters as reported,
// whose intervals are repeated.
std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index,
                                 const std::vector<CauseParameter>& strength);

// The extended law as a FitReport: base parameters in pvlib's units, then those of the causes. With
// `search`, the modified lyrebird optimizer searches the box of the whole law, and its best
// candidate is polished as well. A random search of the same budget is run for comparison.
FitReport ExtendedReport(const CurveSet& set, const Selection& selection, const AtReadings& at,
                         bool search, std::uint64_t seed, const Observer& observer);

}  // namespace lyrefit
