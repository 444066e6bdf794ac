#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/law/effect.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/parameter.h"

// An effect's parameters in the units of reports. What one is multiplied by on the way there may
// depend on the effect's other ones: the strength k of k |V|^m on m.
namespace lyrefit {

std::vector<double> ReportedValues(const Effect& effect, const double* p,
                                   const ReadingScale& scale);
std::vector<double> InnerValues(const Effect& effect, const std::vector<double>& reported,
                                const ReadingScale& scale);

// The effect's own number of parameter k that is reported as `value`, the others at `p`.
double InnerValue(const Effect& effect, int k, double value, std::vector<double> p,
                  const ReadingScale& scale);

// Of what is reported at the corners of a box, the extremes of each parameter.
std::vector<ParameterRange> ReportedRanges(const Effect& effect, const ReadingScale& scale,
                                           const double* lower, const double* upper);

// Derivatives of the effect's own numbers by what is reported, at its own numbers `p`.
Eigen::MatrixXd OwnByReported(const Effect& effect, const ReadingScale& scale, const double* p);

// A device's whole parameter vector with those of the effects in the units of reports, and back.
std::vector<double> Reported(const Device& device, std::vector<double> p);
std::vector<double> Inner(const Device& device, std::vector<double> reported);

// What parameter i is multiplied by on its way to a report, the others at `p`.
double FactorOf(const Device& device, const std::vector<double>& p, int i);

}  // namespace lyrefit
