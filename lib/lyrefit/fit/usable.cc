#include "lyrefit/fit/usable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/largest.h"
#include "lyrefit/curve/find_step.h"
#include "lyrefit/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr double kLargestMisfit = 0.03;  // of Isc

// RMSE of the straight line through the points: what a fit must at least beat.
double StraightLineRmse(const IvCurve& curve) {
  const double n = static_cast<double>(curve.size());
  const auto mean = [&](const std::vector<double>& x) {
    return std::accumulate(x.begin(), x.end(), 0.0) / n;
  };
  const double v0 = mean(curve.voltage_V), i0 = mean(curve.current_A);
  double vv = 0, vi = 0, ii = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double v = curve.voltage_V[k] - v0, i = curve.current_A[k] - i0;
    vv += v * v;
    vi += v * i;
    ii += i * i;
  }
  return std::sqrt(std::max(ii - vi * vi / vv, 0.0) / n);
}

// What a misfit is measured by: Isc, or the largest current of a curve that has none to speak of,
// in the dark or taken far beyond open circuit.
struct Scale {
  double current_A = 0;
  const char* name = "Isc";
};

Scale ScaleOf(const FitReport& report) {
  constexpr double kToSpeakOf = 0.1;
  const double largest = LargestMagnitude(report.curve.current_A);
  const double isc = report.measured.short_circuit_current_A;
  if (isc > kToSpeakOf * largest) return {isc, "Isc"};
  return {largest, "the largest current"};
}

}  // namespace

std::string WhyNotUsable(const FitReport& report, bool interrupted, bool robust) {
  const double rmse =
      (report.polished ? report.rmse.refined : report.rmse.searched).solved_current_A;
  if (!std::isfinite(rmse)) return "the model gives no finite current at these readings";
  // A search that was cut short or not polished says nothing about what the model could do.
  const Scale scale = ScaleOf(report);
  const double misfit = robust ? RobustScale(report.residual_A) : rmse;
  const bool misses = report.polished && !interrupted && misfit > kLargestMisfit * scale.current_A;
  if (misses) {
    const std::string size =
        fmt::format("{} is {:.1f} % of {}", robust ? "the typical residual" : "RMSE",
                    100 * misfit / scale.current_A, scale.name);
    if (const auto step = FindStep(report.curve)) {
      return fmt::format(
          "the curve has a step near {:.3g} V: no diode model describes it ({}); a diagnosis can "
          "name the cause (lyrefit diagnose)",
          step->voltage_V, size);
    }
    return fmt::format("no diode model within the bounds describes this curve: {}; {}", size,
                       report.doubts.empty() ? "a diagnosis may name the cause (lyrefit diagnose)"
                                             : "look first at what is doubtful about its readings");
  }
  if (rmse >= StraightLineRmse(report.curve)) {
    return "a straight line describes these points as well";
  }
  return "";
}

}  // namespace lyrefit
