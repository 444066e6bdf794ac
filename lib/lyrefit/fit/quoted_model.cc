#include "lyrefit/fit/quoted_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lyrefit/law/extension.h"

namespace lyrefit {
namespace {

// Of what is reported at the corners of the effect's box, the extremes of parameter i.
ParameterRange ReportedRange(const RefineProblem& problem, int i, int first, int size) {
  ParameterRange range{HUGE_VAL, -HUGE_VAL};
  std::vector<double> p = problem.lower;
  for (int corner = 0; corner < 1 << size; ++corner) {
    for (int k = 0; k < size; ++k) {
      p[first + k] = (corner >> k & 1) != 0 ? problem.upper[first + k] : problem.lower[first + k];
    }
    const double value = Reported(problem.device, p)[i];
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range;
}

ModelShape QuotedShape(const RefineProblem& problem, ModelShape shape) {
  const Extension& extension = *problem.device.extension;
  for (std::size_t e = 0; e < extension.uses.size(); ++e) {
    const int first = extension.law.Offset(static_cast<int>(e));
    const int size = extension.uses[e].effect->size();
    for (int i = first; i < first + size; ++i) {
      const ParameterRange range = ReportedRange(problem, i, first, size);
      shape.parameters[i].lower = range.low;
      shape.parameters[i].upper = range.high;
      shape.parameters[i].step = range.high > range.low ? 0.1 * (range.high - range.low) : 1;
    }
  }
  return shape;
}

// Derivatives of an effect's own numbers by what is reported, at `p`.
Eigen::MatrixXd OwnByReported(const RefineProblem& problem, const std::vector<double>& p, int first,
                              int size) {
  constexpr double kStep = 1e-6;  // of a parameter's range
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(size, size);
  for (int k = 0; k < size; ++k) {
    const double range = problem.upper[first + k] - problem.lower[first + k];
    const double step = kStep * (range > 0 ? range : std::max(std::fabs(p[first + k]), 1.0));
    std::vector<double> above = p, below = p;
    above[first + k] += step;
    below[first + k] -= step;
    above = Reported(problem.device, above);
    below = Reported(problem.device, below);
    for (int j = 0; j < size; ++j) {
      slopes(j, k) = (above[first + j] - below[first + j]) / (2 * step);
    }
  }
  return slopes.inverse();
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
  const Extension& extension = *problem_.device.extension;
  for (std::size_t e = 0; e < extension.uses.size(); ++e) {
    const int first = extension.law.Offset(static_cast<int>(e));
    const int size = extension.uses[e].effect->size();
    const Eigen::MatrixXd chain = OwnByReported(problem_, own, first, size);
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
                           const ProfileQuery& query, const std::function<bool()>& stop) {
  const QuotedModel model(problem);
  QuotedModel held(problem);
  RefineEnd quoted = best;
  quoted.p = Reported(problem.device, best.p);
  const auto refit = [&](double value, FitPoint start, double enough, double tolerance) {
    held.Fix(query.parameter, value);
    start.p[query.parameter] = value;
    RefineOptions how;
    how.small = true;
    how.let_in = false;
    how.max_rounds = 10;
    how.max_iterations = how.first_iterations = 200;
    how.enough = enough;
    how.function_tolerance = how.first_tolerance = tolerance;
    how.stop = stop;
    return RefineModel(held, start, how);
  };
  ProfileSide side = FindProfileSide(model, quoted, query, {refit, nullptr});
  if (!side.better.empty()) side.better = Inner(problem.device, side.better);
  return side;
}

}  // namespace lyrefit
