#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit::bench {

// Reads data/NAME, such as "rtc_france". Aborts if it cannot be read.
IvCurve LoadCurve(const std::string& name);

// Published bounds of the curve, data/NAME/bounds-KIND.json.
BoundsSpec LoadBounds(const std::string& name, const std::string& kind);

// A model of a curve with the data that benchmarks of it use.
struct Case {
  IvCurve curve;
  Device device;
  PointSet points;
  std::vector<ParameterBounds> bounds;
};
Case MakeCase(const std::string& curve, Model model, const BoundsSpec& bounds = {},
              ConstantSet constants = ConstantSet::kCodata);

// `count` parameter vectors, one after the other, drawn uniformly from the box of a search.
std::vector<double> DrawParameters(const Case& subject, int count);

// The proved optimum of RTC France in ampere, for any box that contains n in [1, 2].
double CertifiedRmse(Model model, Objective objective);

// Whether `rmse` is within 1e-9 (relative) of `certified`.
bool IsHit(double rmse, double certified);

std::string ModelName(Model model);          // "SD"
std::string ObjectiveName(Objective which);  // "measured"

}  // namespace lyrefit::bench
