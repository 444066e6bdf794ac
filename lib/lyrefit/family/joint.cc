#include "lyrefit/family/joint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/family/family_model.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/model/extended_set.h"

namespace lyrefit {
namespace {

constexpr double kAbsent = -25;  // ln(current of a dropped diode at V0 / I0)

void AddSquares(const JointProblem& problem, const FamilyModel& model, const FitPoint& at,
                JointEnd* end) {
  const double* local = at.local.data();
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const FitBlock& block = model.shape().blocks[c];
    std::vector<double> residuals(block.residuals);
    if (!model.Evaluate(static_cast<int>(c), at.p.data(), local, residuals.data(), nullptr,
                        nullptr)) {
      std::fill(residuals.begin(), residuals.end(), HUGE_VAL);
    }
    const std::size_t points = static_cast<std::size_t>(problem.curves[c].residuals());
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      (k < points ? end->squares : end->prior_squares) += residuals[k] * residuals[k];
    }
    local += block.locals;
  }
}

JointEnd EndOf(const JointProblem& problem, const FamilyModel& model, RefineEnd found) {
  JointEnd end;
  AddSquares(problem, model, found, &end);
  end.point = model.Unpack(found);
  end.converged = found.converged;
  end.stopped = found.stopped;
  end.iterations = found.iterations;
  end.projected_gradient = found.projected_gradient;
  end.active = std::move(found.active);
  return end;
}

}  // namespace

int KeyPointResiduals::size() const {
  return static_cast<int>(
      std::count_if(value.begin(), value.end(), [](double one) { return std::isfinite(one); }));
}

int JointCurve::residuals() const {
  return key_points ? key_points->size() : static_cast<int>(voltage_V.size());
}

void FindJointScales(JointProblem* problem) {
  problem->current_scale_A = 0;
  problem->voltage_scale_V = 0;
  for (const JointCurve& curve : problem->curves) {
    for (std::size_t k = 0; k < curve.voltage_V.size(); ++k) {
      problem->current_scale_A = std::max(problem->current_scale_A, std::fabs(curve.current_A[k]));
      problem->voltage_scale_V = std::max(problem->voltage_scale_V, curve.voltage_V[k]);
    }
  }
}

TrueConditions ConditionsAt(const JointProblem& problem, const JointPoint& point, int curve) {
  const JointCurve& at = problem.curves[curve];
  return {
      at.irradiance_W_m2 * (1 + point.local[curve][0]) + point.shared[problem.irradiance_offset()],
      at.temperature_K + point.local[curve][1] + point.shared[problem.temperature_offset()]};
}

const Device& DeviceOf(const JointProblem& problem, int curve) {
  const Translation& at = problem.translation;
  return at.extended ? *problem.curves[curve].extended : at.device;
}

std::vector<double> DeviceAt(const JointProblem& problem, const JointPoint& point, int curve) {
  if (problem.translation.extended) {
    return ExtendedParameters(problem.translation, point.shared.data());
  }
  const TrueConditions at = ConditionsAt(problem, point, curve);
  std::vector<double> device(problem.translation.device.size());
  Translate(problem.translation, point.shared.data(), at.irradiance_W_m2, at.temperature_K,
            device.data());
  return device;
}

JointEnd RefineJointly(const JointProblem& problem, const JointPoint& start,
                       const JointOptions& options) {
  const FamilyModel model(problem);
  RefineEnd found = RefineModel(model, model.Pack(start), HowToRefine(options));
  const Translation& at = problem.translation;
  const int is = at.saturation_current_2;
  if (is >= 0 && found.active[is] && found.p[is] <= 0 && problem.upper[is] > 0) {
    const double pivot = problem.voltage_scale_V / at.device.module_thermal_voltage_V;
    found.p[is] = problem.current_scale_A * std::exp(kAbsent - pivot / found.p[at.n_2]);
  }
  return EndOf(problem, model, std::move(found));
}

JointEnd RefineJointlyPlainly(const JointProblem& problem, const JointPoint& start,
                              const JointOptions& options) {
  const FamilyModel model(problem);
  return EndOf(problem, model, RefineModelPlainly(model, model.Pack(start), HowToRefine(options)));
}

RefineEnd PackedEnd(const JointProblem& problem, const JointEnd& end) {
  const FamilyModel model(problem);
  RefineEnd packed;
  static_cast<FitPoint&>(packed) = model.Pack(end.point);
  packed.mean_square = (end.squares + end.prior_squares) / model.shape().points;
  packed.converged = end.converged;
  packed.active = end.active;
  return packed;
}

RefineOptions HowToRefine(const JointOptions& options) {
  RefineOptions how;
  how.function_tolerance = options.function_tolerance;
  how.stop = options.stop;
  how.trust_radius = 1e6;  // starts are worse than a curve's: a longer step leads astray
  return how;
}

JointSpread FindJointSpread(const JointProblem& problem, const JointEnd& end, double variance) {
  const RefineEnd packed = PackedEnd(problem, end);
  return FindJointSpread(problem, FamilyModel(problem), packed, variance);
}

JointSpread FindJointSpread(const JointProblem& problem, const FitModel& model,
                            const RefineEnd& end, double variance) {
  JointSpread spread;
  static_cast<Spread&>(spread) = FindSpread(model, end, end.active, variance);
  const double nan = std::nan("");
  std::size_t next = 0;
  for (const JointCurve& curve : problem.curves) {
    spread.local_errors.push_back({nan, nan});
    for (const OwnUnknown& own : OwnUnknowns(curve)) {
      const double error = spread.local_error[next++];
      spread.local_errors.back()[own.which] = error;
      const double part = error * error / (own.sd * own.sd);
      const double degrees = std::isnan(error) ? 0 : std::max(0.0, 1 - part);
      spread.local_degrees += std::isfinite(own.sd) ? degrees : 1;
    }
  }
  return spread;
}

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
