#include "lyrefit/estimate/refine/curve_model.h"

#include <utility>

#include "lyrefit/estimate/refine/coarsen.h"

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

CurveModel::CurveModel(const RefineProblem& problem, GiveUp give_up) : CurveModel(problem) {
  if (problem.device.effects != nullptr) kept_ = std::make_unique<LawWorkspace>(give_up);
}

CurveModel::CurveModel(std::unique_ptr<RefineProblem> own)
    : FitModel(ShapeOf(*own)), own_(std::move(own)), problem_(*own_) {}

bool CurveModel::Evaluate(int /*block*/, const double* p, const double* /*local*/,
                          double* residuals, double* slopes, double* /*local_slopes*/) const {
  Residuals(problem_, p, residuals, slopes, kept_.get());
  return true;
}

double CurveModel::MeanSquare(const FitPoint& point) const {
  return lyrefit::MeanSquare(problem_, point.p, kept_.get());
}

std::unique_ptr<FitModel> CurveModel::Coarse() const {
  if (!CanCoarsen(problem_)) return nullptr;
  return std::unique_ptr<FitModel>(
      new CurveModel(std::make_unique<RefineProblem>(Coarsen(problem_))));
}

}  // namespace lyrefit
