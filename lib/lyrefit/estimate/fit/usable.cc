#include "lyrefit/estimate/fit/usable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/median.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/curve/beyond_voc.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/estimate/fit/statistics.h"
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

namespace {

// Residuals of the least-squares line through the points, the baseline of any fit.
std::vector<double> StraightLineResiduals(const IvCurve& curve) {
  const double n = static_cast<double>(curve.size());
  const auto mean = [&](const std::vector<double>& x) {
    return std::accumulate(x.begin(), x.end(), 0.0) / n;
  };
  const double v0 = mean(curve.voltage_V), i0 = mean(curve.current_A);
  double vv = 0, vi = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double v = curve.voltage_V[k] - v0;
    vv += v * v;
    vi += v * (curve.current_A[k] - i0);
  }
  std::vector<double> residuals;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    residuals.push_back(i0 + vi / vv * (curve.voltage_V[k] - v0) - curve.current_A[k]);
  }
  return residuals;
}

double Typical(const std::vector<double>& residuals, bool robust) {
  if (robust) return RobustScale(residuals, UpperMedian);
  double squares = 0;
  for (const double one : residuals) squares += one * one;
  return std::sqrt(squares / static_cast<double>(residuals.size()));
}

// Whether a line describes the curve as well as parameters with `misfit`: by the F-test, since a
// line is a diode model without its diode. Without spare readings BIC decides. An interrupted or
// unpolished fit does not show what the model can reach, so only its misfit is compared with that
// of the line.
bool LineDoesAsWell(const IvCurve& curve, const InformationCriteria& of_model, double misfit,
                    bool robust, bool at_its_end) {
  constexpr double kRounding = 1e-11;  // of the largest current: smaller residuals are rounding
  constexpr double kLevel = 0.05;
  constexpr int kLineParameters = 2;
  const double line = Typical(StraightLineResiduals(curve), robust);
  if (!at_its_end) return misfit >= line;
  const double smallest = kRounding * LargestMagnitude(curve.current_A);
  const double of_fit = std::pow(std::max(misfit, smallest), 2);
  const double of_line = std::pow(std::max(line, smallest), 2);
  const int extra = of_model.parameters - kLineParameters;
  const int spare = of_model.points - of_model.parameters;
  if (extra > 0 && spare > 0) return !(FTestPValue(of_line, of_fit, extra, spare) < kLevel);
  return FindInformation(of_line, of_model.points, kLineParameters).bic <=
         FindInformation(of_fit, of_model.points, of_model.parameters).bic;
}

// Scale of the misfit: Isc, or the largest current of a curve without photocurrent.
struct Scale {
  double current_A = 0;
  const char* name = "Isc";
};

Scale ScaleOf(const IvCurve& curve, const KeyPoints& measured) {
  const double isc = measured.short_circuit_current_A;
  if (isc > 0 && !IsDark(curve)) return {isc, "Isc"};
  return {LargestMagnitude(curve.current_A), "the largest current"};
}

}  // namespace

std::string WhyNotUsable(const IvCurve& curve, const ModelResults& results,
                         const UsabilityFacts& facts) {
  if (!std::isfinite(facts.rmse_A)) return "the model gives no finite current at these readings";
  if (IsNight(curve)) {
    return fmt::format("night: {:.3g} W/m2 are stated, and no current is above the noise",
                       curve.conditions.irradiance_W_m2);
  }
  const Scale scale = ScaleOf(curve, results.measured);
  const double misfit = facts.robust ? RobustScale(results.residual_A, UpperMedian) : facts.rmse_A;
  if (LineDoesAsWell(curve, facts.criteria, misfit, facts.robust, facts.at_its_end)) {
    return "a straight line describes these points as well";
  }
  if (!facts.at_its_end || !(misfit > kLargestMisfit * scale.current_A)) return "";
  const std::string size =
      fmt::format("{} is {:.1f} % of {}", facts.robust ? "the typical residual" : "RMSE",
                  100 * misfit / scale.current_A, scale.name);
  if (const auto step = FindStep(curve)) {
    return fmt::format(
        "the curve has a step near {:.3g} V: no diode model describes it ({}); a diagnosis can "
        "name the cause (lyrefit diagnose)",
        step->voltage_V, size);
  }
  return fmt::format("no diode model within the bounds describes this curve: {}; {}", size,
                     facts.doubtful ? "look first at what is doubtful about its readings"
                                    : "a diagnosis may name the cause (lyrefit diagnose)");
}

}  // namespace lyrefit
