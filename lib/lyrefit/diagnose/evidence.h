#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

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
