#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

// "one sweep from -0.1 V to 0.6 V, beyond open circuit", in words.
std::string KindOfData(const Readings& readings);

// p-value of Ljung and Box's test over 8 lags inside each stretch, of whitened residuals.
double Whiteness(const WeightedData& weighted, const LawFit& fit);

// Everything that was seen before a cause was thought of.
Evidence DescribeEvidence(const Selection& selection, const AtReadings& at,
                          const ValueFindings& values, const Autocorrelation& autocorrelation);

// n below 1 or beyond 3 in the extended model: what temperature or number of cells would be
// plausible. Nothing where n is. With `shorted`, a bypass group without voltage is thought of.
std::vector<Cause> CheckTemperatureAndCells(const Selection& selection, bool shorted);

}  // namespace lyrefit
