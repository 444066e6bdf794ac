#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

// A fit's effect `index` in a person's units, with symmetric 95 % intervals cut at the bounds.
std::vector<CauseParameter> DescribeParameters(const WeightedData& weighted, const LawFit& fit,
                                               int index);

// One trial for each of the `known` effects, fitted or not.
std::vector<Trial> DescribeTrials(const Readings& readings, const Selection& selection,
                                  const std::vector<const Effect*>& known,
                                  const std::vector<const Effect*>& candidates,
                                  const DiagnoseOptions& options);

// A cause still without size and place. `evidence`: "fit" or "values".
Cause MakeCause(const Effect& effect, const char* evidence, double corrected_p);

// The causes found, what cannot be told from them and at which readings they act.
std::vector<Cause> DescribeCauses(const Selection& selection, const AtReadings& at,
                                  const ValueFindings& values);

// What is there but not worth a name: the likeliest, with those that are as good.
std::vector<Cause> DescribeBelow(const Selection& selection);

// "k = 0.085 A/V^2 (0.08 to 0.09)"
std::string StrengthText(const CauseParameter& parameter);

// Base parameters with and without the causes, and the maximum power of the device.
std::vector<ParameterShift> DescribeShifts(const Selection& selection);

// RMSE in ampere over the used readings, also those behind averages.
double RmseOf(const WeightedData& weighted, const std::vector<double>& current);

}  // namespace lyrefit
