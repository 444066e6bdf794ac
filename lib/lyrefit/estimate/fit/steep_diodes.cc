#include "lyrefit/estimate/fit/steep_diodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/model/term.h"

namespace lyrefit {

double SteepestIdeality(const IvCurve& curve, const Device& device, const ParameterBounds& rs) {
  double voltage = 0, current = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    voltage = std::max(voltage, curve.voltage_V[k]);
    current = std::max(current, std::fabs(curve.current_A[k]));
  }
  const double most = current > 0 ? std::min(rs.upper, voltage / current) : rs.upper;
  double junction_V = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    for (const double r : {rs.lower, most}) {
      junction_V = std::max(junction_V, curve.voltage_V[k] + r * curve.current_A[k]);
    }
  }
  return junction_V / (kLargestExponent * device.module_thermal_voltage_V);
}

double LeaveOutSteps(const IvCurve& curve, const Device& device, const std::vector<double>& fixed,
                     std::vector<ParameterBounds>* bounds) {
  const double steepest = SteepestIdeality(curve, device, (*bounds)[kRs]);
  double raised = kUnknown;
  for (int d = 0; d < DiodeCount(device); ++d) {
    ParameterBounds& n = (*bounds)[IdealityIndex(d)];
    if (!(n.lower < steepest && steepest < n.upper)) continue;
    if (!std::isnan(fixed[IdealityIndex(d)])) continue;
    raised = n.lower = steepest;
    n.search_lower = std::max(n.search_lower, steepest);
    n.search_upper = std::max(n.search_upper, steepest);
  }
  return raised;
}

std::string StepsLeftOut(double steepest_n) {
  return fmt::format(
      "n begins at {:.4g}, above the lower end of its bounds. For smaller n the exponential of a "
      "diode would overflow, so fit and compare do not search there. certify takes the bounds as "
      "they are",
      steepest_n);
}

}  // namespace lyrefit
