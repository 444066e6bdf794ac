#include "lyrefit/fit/quoted_model.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/law/quote.h"
#include "lyrefit/refine/other_optima.h"

namespace lyrefit {
namespace {

ModelShape QuotedShape(const RefineProblem& problem, ModelShape shape) {
  const DeviceEffects& device_effects = *problem.device.effects;
  for (std::size_t e = 0; e < device_effects.uses.size(); ++e) {
    const int first = device_effects.law.Offset(static_cast<int>(e));
    const std::vector<ParameterRange> ranges =
        ReportedRanges(*device_effects.uses[e].effect, device_effects.readings.scale,
                       problem.lower.data() + first, problem.upper.data() + first);
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      FitParameter& parameter = shape.parameters[first + k];
      parameter.lower = ranges[k].low;
      parameter.upper = ranges[k].high;
      parameter.step = parameter.fixed() ? 1 : 0.1 * (parameter.upper - parameter.lower);
    }
  }
  return shape;
}

// Cheap solver options for hundreds of refits.
RefineOptions BrieflySmall(const StopToken& stop) {
  RefineOptions how;
  how.small = true;
  how.let_in = false;
  how.max_rounds = 10;
  how.max_iterations = how.first_iterations = 200;
  how.stop = stop;
  return how;
}

}  // namespace

QuotedModel::QuotedModel(const RefineProblem& problem)
    : FitModel(QuotedShape(problem, CurveModel(problem).shape())),
      problem_(problem),
      own_(problem) {}

bool QuotedModel::Evaluate(int block, const double* p, const double* local, double* residuals,
                           double* slopes, double* local_slopes) const {
  const int count = problem_.device.size();
  const std::vector<double> own = Inner(problem_.device, std::vector<double>(p, p + count));
  if (!own_.Evaluate(block, own.data(), local, residuals, slopes, local_slopes)) return false;
  if (slopes == nullptr) return true;
  const DeviceEffects& device_effects = *problem_.device.effects;
  for (std::size_t e = 0; e < device_effects.uses.size(); ++e) {
    const int first = device_effects.law.Offset(static_cast<int>(e));
    const int size = device_effects.uses[e].effect->size();
    const Eigen::MatrixXd chain = OwnByReported(*device_effects.uses[e].effect,
                                                device_effects.readings.scale, own.data() + first);
    for (std::size_t r = 0; r < problem_.voltage_V.size(); ++r) {
      Eigen::Map<Eigen::RowVectorXd> row(slopes + r * count + first, size);
      row = (row * chain).eval();
    }
  }
  return true;
}

double QuotedModel::MeanSquare(const FitPoint& point) const {
  return lyrefit::MeanSquare(problem_, Inner(problem_.device, point.p));
}

ProfileSide FindQuotedSide(const RefineProblem& problem, const RefineEnd& best,
                           const ProfileQuery& query, const StopToken& stop) {
  const QuotedModel model(problem);
  QuotedModel held(problem);
  RefineEnd quoted = best;
  quoted.p = Reported(problem.device, best.p);
  ProfileQuery quoted_query = query;
  for (FitPoint& local_optimum : quoted_query.local_optima)
    local_optimum.p = Reported(problem.device, local_optimum.p);
  RefineOptions how = BrieflySmall(stop);
  const auto refit = [&](double value, FitPoint start, double target, double tolerance) {
    held.Fix(query.parameter, value);
    start.p[query.parameter] = value;
    how.target = target;
    how.function_tolerance = how.first_tolerance = tolerance;
    return RefineModel(held, std::move(start), how);
  };
  ProfileSide side = FindProfileSide(model, quoted, quoted_query, {refit, nullptr});
  if (!side.better.empty()) side.better = Inner(problem.device, side.better);
  return side;
}

std::vector<FitPoint> FindOtherOptima(const RefineProblem& problem, const RefineEnd& best,
                                      std::vector<FitPoint> ends, double highest,
                                      const StopToken& stop) {
  const DeviceEffects& device_effects = *problem.device.effects;
  OptimumQuery query{highest, device_effects.law.base_size(), BrieflySmall(stop)};
  query.how.cutoff = highest;
  return FindOtherOptima(CurveModel(problem), device_effects, best, std::move(ends), query);
}

std::vector<bool> FindFlat(const RefineProblem& problem, const std::vector<double>& quoted) {
  const int count = problem.device.size(), points = static_cast<int>(problem.voltage_V.size());
  std::vector<double> residuals(points), slopes(static_cast<std::size_t>(points) * count);
  std::vector<bool> flat(count, false);
  const QuotedModel model(problem);
  if (!model.Evaluate(0, quoted.data(), nullptr, residuals.data(), slopes.data(), nullptr)) {
    return flat;
  }
  const DeviceEffects& device_effects = *problem.device.effects;
  for (const Settings& settings : FindSettings(device_effects, device_effects.law.base_size())) {
    for (const int k : settings.parameters) {
      bool none = true;
      for (int r = 0; r < points; ++r) none = none && slopes[r * count + k] == 0;
      flat[k] = none;
    }
  }
  return flat;
}

}  // namespace lyrefit
