#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/effect.h"
#include "lyrefit/model/parameter.h"

// Conversion of an effect's parameters between internal and reporting units. The factor of one
// parameter may depend on others: that of the strength k of k |V|^m depends on m.
namespace lyrefit {

std::vector<double> ReportedValues(const Effect& effect, const double* p,
                                   const ReadingScale& scale);
std::vector<double> InternalValues(const Effect& effect, const std::vector<double>& reported,
                                   const ReadingScale& scale);

// Internal value of parameter k whose reported value is `value`, with the others at `p` (internal).
double InternalValue(const Effect& effect, int k, double value, std::vector<double> p,
                     const ReadingScale& scale);

// Minimum and maximum of each reported parameter over the corners of the box [lower, upper].
std::vector<ParameterRange> ReportedRanges(const Effect& effect, const ReadingScale& scale,
                                           const double* lower, const double* upper);

// Jacobian of the internal by the reported values, at internal values `p`; size x size.
Eigen::MatrixXd InternalByReported(const Effect& effect, const ReadingScale& scale,
                                   const double* p);

// The effects of a model and the position of their first parameter; the parameters of all effects
// are contiguous. Null: no effects, so that both units are equal.
struct EffectSpan {
  const DeviceEffects* effects = nullptr;
  int first = 0;

  bool Has(int i) const { return effects != nullptr && i >= first; }
};
EffectSpan SpanOf(const Device& device);

// The parameter vector of a model with the effects' parameters converted to reporting units, and
// back. Empty vectors stay empty.
std::vector<double> Reported(const EffectSpan& span, std::vector<double> p);
std::vector<double> Internal(const EffectSpan& span, std::vector<double> reported);
std::vector<double> Reported(const Device& device, std::vector<double> p);
std::vector<double> Internal(const Device& device, std::vector<double> reported);

// Bounds `own` of parameter i in reporting units, with the other parameters at `p` (internal).
ParameterBounds ReportedBounds(const EffectSpan& span, const ParameterBounds& own,
                               std::vector<double> p, int i);

}  // namespace lyrefit
