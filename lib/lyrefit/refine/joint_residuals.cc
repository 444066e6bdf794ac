#include "lyrefit/refine/joint_residuals.h"

#include <ceres/jet.h>
#include <glog/logging.h>

#include <cmath>

#include "lyrefit/law/current.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/refine/residuals.h"

namespace lyrefit {
namespace {

// Every shared unknown of the richest law and both of a curve.
constexpr int kUnknowns = 18;
using Unknowns = ceres::Jet<double, kUnknowns>;
using Parameters = ceres::Jet<double, kJetWidth>;

double PriorResidual(const JointProblem& problem, double value, double sd) {
  return problem.noise_A * value / sd;
}

// Currents of the model at the points and their derivatives by the device's parameters.
void ModelCurrents(const JointProblem& problem, const JointCurve& curve,
                   const std::vector<double>& p, std::vector<double>* current, RowMatrix* slope) {
  const Device& device = problem.translation.device;
  const bool measured = problem.objective == Objective::kMeasuredCurrent;
  const int count = device.size();
  const std::vector<double> at =
      measured ? curve.current_A : SolveCurrents(device, p.data(), curve.voltage_V);
  current->resize(at.size());
  std::vector<Parameters> dual(count);
  for (int i = 0; i < count; ++i) dual[i] = Parameters(p[i], i);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Parameters explicit_current =
        ExplicitCurrent(device, dual.data(), curve.voltage_V[k], at[k]);
    double factor = 1;
    (*current)[k] = measured ? explicit_current.a : at[k];
    if (!measured) {
      const OperatingPoint point = KnownOperatingPoint(device, p.data(), curve.voltage_V[k], at[k]);
      factor = ImplicitFactor(device, p.data(), point);
    }
    slope->row(static_cast<int>(k)) = factor * explicit_current.v.head(count);
  }
}

}  // namespace

JointShape ShapeOf(const JointCurve& curve) {
  JointShape shape;
  shape.residuals = static_cast<int>(curve.voltage_V.size());
  shape.irradiance = curve.irradiance_sd > 0;
  shape.temperature = curve.temperature_sd_K > 0;
  shape.locals = shape.irradiance + shape.temperature;
  shape.residuals += shape.irradiance && std::isfinite(curve.irradiance_sd);
  shape.residuals += shape.temperature && std::isfinite(curve.temperature_sd_K);
  return shape;
}

std::vector<double> PackLocal(const JointShape& shape, const JointLocal& local) {
  std::vector<double> packed;
  if (shape.irradiance) packed.push_back(local[0]);
  if (shape.temperature) packed.push_back(local[1]);
  return packed;
}

JointLocal UnpackLocal(const JointShape& shape, const JointLocal& packed) {
  JointLocal local = {0, 0};
  std::size_t next = 0;
  if (shape.irradiance) local[0] = packed[next++];
  if (shape.temperature) local[1] = packed[next++];
  return local;
}

bool EvaluateJointCurve(const JointProblem& problem, const JointCoordinates& coordinates, int curve,
                        const double* theta, const double* local, double unit_A, double* residuals,
                        RowMatrix* shared_jacobian, RowMatrix* local_jacobian) {
  if (!coordinates.Sane(theta)) return false;
  const JointCurve& at = problem.curves[curve];
  const JointShape shape = ShapeOf(at);
  const int moving = coordinates.size();
  CHECK_LE(moving + 2, kUnknowns);
  std::vector<Unknowns> x(moving);
  for (int k = 0; k < moving; ++k) x[k] = Unknowns(theta[k], k);
  std::vector<Unknowns> shared(problem.shared());
  coordinates.ToShared(x.data(), shared.data());
  int next = 0;
  Unknowns relative(0.0), warmer(0.0);
  if (shape.irradiance) relative = Unknowns(local[next], moving + next), ++next;
  if (shape.temperature) warmer = Unknowns(local[next], moving + next), ++next;
  const Unknowns irradiance =
      at.irradiance_W_m2 * (1.0 + relative) + shared[problem.irradiance_offset()];
  const Unknowns temperature = at.temperature_K + warmer + shared[problem.temperature_offset()];
  if (!(irradiance.a > 0) || !(temperature.a > 100) || !(temperature.a < 600)) return false;
  const int count = problem.translation.device.size();
  std::vector<Unknowns> device(count);
  Translate(problem.translation, shared.data(), irradiance, temperature, device.data());
  std::vector<double> p(count);
  for (int i = 0; i < count; ++i) {
    p[i] = device[i].a;
    if (!std::isfinite(p[i])) return false;
  }

  const int points = static_cast<int>(at.voltage_V.size());
  std::vector<double> current;
  RowMatrix slope(points, count);
  ModelCurrents(problem, at, p, &current, &slope);
  for (int k = 0; k < points; ++k) {
    const double root = std::sqrt(at.weight[k]) / unit_A;
    residuals[k] = root * (current[k] - at.current_A[k]);
    if (!std::isfinite(residuals[k])) return false;
    slope.row(k) *= root;
  }
  RowMatrix chain(count, moving + shape.locals);
  for (int i = 0; i < count; ++i) chain.row(i) = device[i].v.head(moving + shape.locals);
  if (shared_jacobian != nullptr) {
    shared_jacobian->setZero(shape.residuals, moving);
    shared_jacobian->topRows(points).noalias() = slope * chain.leftCols(moving);
  }
  if (local_jacobian != nullptr) {
    local_jacobian->setZero(shape.residuals, shape.locals);
    local_jacobian->topRows(points).noalias() = slope * chain.rightCols(shape.locals);
  }
  int row = points, column = 0;
  for (const auto& [is_unknown, sd] : {std::pair(shape.irradiance, at.irradiance_sd),
                                       std::pair(shape.temperature, at.temperature_sd_K)}) {
    if (!is_unknown) continue;
    if (std::isfinite(sd)) {
      residuals[row] = PriorResidual(problem, local[column], sd) / unit_A;
      if (local_jacobian != nullptr) {
        (*local_jacobian)(row, column) = PriorResidual(problem, 1, sd) / unit_A;
      }
      ++row;
    }
    ++column;
  }
  return true;
}

}  // namespace lyrefit
