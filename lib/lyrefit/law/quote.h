#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/law/device_effects.h"
#include "lyrefit/law/effect.h"
#include "lyrefit/law/parameter.h"

// Conversion of an effect's parameters between internal and reporting units. The factor of one
// parameter may depend on others: that of the strength k of k |V|^m depends on m.
namespace lyrefit {

std::vector<double> ReportedValues(const Effect& effect, const double* p,
                                   const ReadingScale& scale);
std::vector<double> InnerValues(const Effect& effect, const std::vector<double>& reported,
                                const ReadingScale& scale);

// Internal value of parameter k whose reported value is `value`, with the others at `p` (internal).
double InnerValue(const Effect& effect, int k, double value, std::vector<double> p,
                  const ReadingScale& scale);

// Minimum and maximum of each reported parameter over the corners of the box [lower, upper].
std::vector<ParameterRange> ReportedRanges(const Effect& effect, const ReadingScale& scale,
                                           const double* lower, const double* upper);

// Jacobian of the internal by the reported values, at internal values `p`; size x size.
Eigen::MatrixXd OwnByReported(const Effect& effect, const ReadingScale& scale, const double* p);

// The parameter vector of a device with the effects' parameters converted to reporting units, and
// back.
std::vector<double> Reported(const Device& device, std::vector<double> p);
std::vector<double> Inner(const Device& device, std::vector<double> reported);

// Factor from the internal to the reported value of parameter i, with the others at `p`.
double FactorOf(const Device& device, const std::vector<double>& p, int i);

}  // namespace lyrefit
