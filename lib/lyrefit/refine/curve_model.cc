#include "lyrefit/refine/curve_model.h"

#include <cmath>
#include <utility>

#include "lyrefit/refine/model_current.h"
#include "lyrefit/refine/thin.h"

namespace lyrefit {
namespace {

ModelShape ShapeOf(const RefineProblem& problem) {
  ModelShape shape;
  shape.parameters = MakeFitParameters(problem.device.parameters, problem.lower, problem.upper);
  shape.blocks = {{static_cast<int>(problem.voltage_V.size()), 0}};
  shape.points = static_cast<double>(problem.voltage_V.size());
  shape.current_scale_A = problem.current_scale_A;
  shape.voltage_scale_V = problem.voltage_scale_V;
  shape.thermal_voltage_V = problem.device.module_thermal_voltage_V;
  return shape;
}

}  // namespace

CurveModel::CurveModel(const RefineProblem& problem)
    : FitModel(ShapeOf(problem)), problem_(problem) {}

CurveModel::CurveModel(std::unique_ptr<RefineProblem> own)
    : FitModel(ShapeOf(*own)), own_(std::move(own)), problem_(*own_) {}

bool CurveModel::Evaluate(int /*block*/, const double* p, const double* /*local*/,
                          double* residuals, double* slopes, double* /*local_slopes*/) const {
  ModelCurrents(problem_.device, problem_.objective, p,
                {problem_.voltage_V, problem_.current_A, problem_.points}, *problem_.kernel,
                residuals, slopes);
  const int count = problem_.device.size();
  for (std::size_t k = 0; k < problem_.voltage_V.size(); ++k) {
    const double root = std::sqrt(problem_.weights[k]);
    residuals[k] = (residuals[k] - problem_.current_A[k]) * root;
    for (int i = 0; slopes != nullptr && i < count; ++i) slopes[k * count + i] *= root;
  }
  return true;
}

double CurveModel::MeanSquare(const FitPoint& point) const {
  return lyrefit::MeanSquare(problem_, point.p);
}

std::unique_ptr<FitModel> CurveModel::Few() const {
  if (problem_.voltage_V.size() <= kFewPoints || problem_.device.extension) return nullptr;
  return std::unique_ptr<FitModel>(new CurveModel(std::make_unique<RefineProblem>(Thin(problem_))));
}

}  // namespace lyrefit
