#include "lyrefit/estimate/refine/curve_model.h"

#include <algorithm>
#include <utility>

#include "lyrefit/estimate/refine/coarsen.h"

namespace lyrefit {
namespace {

// The current at the highest voltage; 0 if it is not above those that the device delivers.
double ForwardCurrent(const RefineProblem& problem) {
  double highest_V = 0, forward_A = 0, delivered_A = 0;
  for (std::size_t k = 0; k < problem.voltage_V.size(); ++k) {
    if (!(problem.voltage_V[k] > 0)) continue;
    delivered_A = std::max(delivered_A, problem.current_A[k]);
    if (!(problem.voltage_V[k] > highest_V)) continue;
    highest_V = problem.voltage_V[k];
    forward_A = -problem.current_A[k];
  }
  return forward_A > delivered_A ? forward_A : 0;
}

ModelShape ShapeOf(const RefineProblem& problem) {
  ModelShape shape;
  shape.parameters = MakeFitParameters(problem.device.parameters, problem.lower, problem.upper);
  shape.blocks = {{static_cast<int>(problem.voltage_V.size()), 0}};
  shape.points = static_cast<double>(problem.voltage_V.size());
  shape.current_scale_A = problem.current_scale_A;
  shape.voltage_scale_V = problem.voltage_scale_V;
  shape.forward_A = ForwardCurrent(problem);
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
