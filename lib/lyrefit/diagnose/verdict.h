#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/measurement.h"

namespace lyrefit {

// Lack of fit of a fit beyond the noise: root mean square in fractions of Isc.
Sized LeftBy(const WeightedData& weighted, const LawFit& fit);

// Whether the lack of fit of the base model exceeds both that of modules without a fault and the
// floor.
bool MissesTooMuch(const Verdict& verdict, const Floors& floors);

// Whether the causes leave more than noise, the floor and the model's usual misfit of modules
// without a fault.
bool LeavesTooMuch(const Verdict& verdict, const Floors& floors);

// What readings of this kind never show: "dirt or slight ageing of all cells alike, ..."
std::string NotShownBy(const DataTraits& traits);

// "number of bypass diodes not given: assumed 60, one for 20 cells", of a string of which nobody states them; else empty.
std::string AssumedDiodes(const DataTraits& traits);

// The conclusion in words: fills `remaining`, `comparison`, `not_shown` and `sentence`. The causes
// are described. `findings`: parameters of the device that are out of range.
// `probability`: a cause with less is said as one of a set.
void DescribeVerdict(const Selection& selection, const Floors& floors,
                     const std::vector<DeviceFinding>& findings, double probability,
                     Verdict* verdict);

// Combines fits, values and metadata into a verdict. `whiteness_after`: p-value of the whiteness
// test of the extended model's residuals.
Verdict Decide(const Measurement& measurement, const Selection& selection, const AtReadings& at,
               const DiagnoseOptions& options, double whiteness_after);

// Text such as "one sweep, beyond open circuit".
std::string KindOfData(const Readings& readings);

// p-value of the Ljung-Box test over 8 lags within each monotone stretch, of whitened residuals.
double Whiteness(const WeightedData& weighted, const LawFit& fit);

// Properties of readings and residuals before any cause is tried.
Evidence DescribeEvidence(const Selection& selection, const AtReadings& at,
                          const ValueFindings& values, const Autocorrelation& autocorrelation);

// The least n that a junction can have. The slack allows for a temperature error of a few kelvin.
// With a rough path it is larger: the module's departure from the model changes n by more than its
// error.
double LeastIdeality(const WeightedData& weighted);

// If n of the extended model is below 1 or above 3: a cause with the temperature or number of cells
// that would make n plausible. Empty if n is plausible. With `shorted`, a shorted bypass group is
// offered as an explanation.
std::vector<Cause> CheckTemperatureAndCells(const Selection& selection, bool shorted);

}  // namespace lyrefit
