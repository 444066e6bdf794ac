#include "lyrefit/family/outlier_curves.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/median.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/family/family_search.h"

namespace lyrefit {
namespace {

double CurveSquare(const JointProblem& problem, const JointPoint& point, int c) {
  const RmsePair rmse = CurveRmse(problem, point, c);
  const double one = rmse.Of(problem.objective);
  return one * one * problem.curves[c].weight[0];
}

// Whether ordinary errors of its readings explain a curve under these shared parameters. Sensors of
// a good set differ by a few percent, and such a curve does not belong to another device.
bool ReadingsExplain(const JointProblem& problem, const JointPoint& point, int c, double noise_A,
                     double limit_A, const StopToken& stop) {
  constexpr double kIrradianceSd = 0.02;
  constexpr double kTemperatureSd_K = 2;
  constexpr double kOrdinary = 3;  // standard deviations
  JointProblem alone;
  alone.translation = problem.translation;
  alone.objective = problem.objective;
  alone.curves = {problem.curves[c]};
  alone.lower = alone.upper = point.shared;
  alone.noise_A = noise_A;
  FindJointScales(&alone);
  JointCurve& curve = alone.curves[0];
  curve.irradiance_sd = std::max(curve.irradiance_sd, kIrradianceSd);
  curve.temperature_sd_K = std::max(curve.temperature_sd_K, kTemperatureSd_K);
  JointOptions options;
  options.stop = stop;
  const JointEnd end = RefineJointly(alone, {point.shared, {point.local[c]}}, options);
  const JointLocal& own = end.point.local[0];
  return std::fabs(own[0]) <= kOrdinary * curve.irradiance_sd &&
         std::fabs(own[1]) <= kOrdinary * curve.temperature_sd_K &&
         std::sqrt(CurveSquare(alone, end.point, 0)) <= limit_A;
}

}  // namespace

std::vector<int> FindOutlierCurves(const JointProblem& problem, const JointEnd& end,
                                   const StopToken& stop) {
  constexpr double kSuspicious = 4;  // times the median RMSE
  constexpr double kOutlier = 6;
  constexpr double kVisible = 5e-3;  // of the largest current
  constexpr int kRounds = 6;
  const int curves = static_cast<int>(problem.curves.size());
  if (curves < 4) return {};
  std::vector<double> rmse(curves);
  const auto measure = [&](const JointPoint& point) {
    for (int c = 0; c < curves; ++c) rmse[c] = std::sqrt(CurveSquare(problem, point, c));
    return UpperMedian(rmse);
  };
  double median = measure(end.point);
  const auto largest = [&] { return *std::max_element(rmse.begin(), rmse.end()); };
  const double visible = kVisible * problem.current_scale_A;
  if (!(largest() > kSuspicious * median) && !(median > visible)) return {};
  // Cauchy weights for whole curves.
  JointProblem robust = problem;
  JointPoint point = end.point;
  for (int round = 0; round < kRounds; ++round) {
    for (int c = 0; c < curves; ++c) {
      const double ratio = rmse[c] / std::max(2 * median, 1e-9 * problem.current_scale_A);
      const double factor = 1 / (1 + ratio * ratio);
      for (std::size_t k = 0; k < robust.curves[c].weight.size(); ++k) {
        robust.curves[c].weight[k] = problem.curves[c].weight[k] * factor * factor;
      }
    }
    JointOptions quick;
    quick.function_tolerance = 1e-8;
    quick.stop = stop;
    point = RefineJointly(robust, point, quick).point;
    median = measure(point);
  }
  std::vector<int> outliers;
  for (int c = 0; c < curves; ++c) {
    const double limit = std::max(kOutlier * median, visible);
    const double noise = std::max(median, 1e-9 * problem.current_scale_A);
    const bool far = rmse[c] > limit;
    if (far && !ReadingsExplain(problem, point, c, noise, limit, stop)) outliers.push_back(c);
  }
  // Outliers cannot be more than a third of the curves.
  if (3 * static_cast<int>(outliers.size()) > curves) outliers.clear();
  return outliers;
}

}  // namespace lyrefit
