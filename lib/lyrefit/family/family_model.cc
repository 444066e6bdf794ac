#include "lyrefit/family/family_model.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/dual.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/model/extended_set.h"

namespace lyrefit {
namespace {

// Every shared parameter of the largest translation model, irradiance and temperature.
constexpr int kUnknowns = 16;
using Unknowns = Dual<kUnknowns>;

ModelShape ShapeOf(const JointProblem& problem) {
  const Translation& at = problem.translation;
  ModelShape shape;
  shape.points = 0;
  for (const JointCurve& curve : problem.curves) {
    const int points = curve.residuals();
    FitBlock block{points, 0};
    for (const OwnUnknown& own : OwnUnknowns(curve)) {
      ++block.locals;
      block.residuals += std::isfinite(own.sd) ? 1 : 0;
    }
    shape.blocks.push_back(block);
    shape.points += points;
  }
  shape.points = std::max(shape.points, 1.0);
  shape.current_scale_A = problem.current_scale_A;
  shape.voltage_scale_V = problem.voltage_scale_V;
  shape.thermal_voltage_V = at.device.module_thermal_voltage_V;
  shape.parameters = MakeFitParameters(at.parameters, problem.lower, problem.upper);
  shape.parameters[problem.irradiance_offset()].step = 100;
  shape.parameters[problem.temperature_offset()].step = 10;
  const double perfect = shape.resistance_scale() / kPerfectConductance;
  FitParameter& shunt = shape.parameters[at.resistance_shunt];
  if (!shunt.fixed()) shunt.upper = std::min(shunt.upper, perfect);
  shape.parameters[at.saturation_current].may_vanish = false;
  return shape;
}

// A device's parameters under the operating conditions of one curve. `chain`, if not null:
// derivatives by the shared parameters, then by irradiance and temperature. False if the conditions
// are not physical or a parameter is not finite.
bool TranslateCurve(const JointProblem& problem, const double* p, double irradiance,
                    double temperature, std::vector<double>* device, RowMatrix* chain) {
  const Translation& at = problem.translation;
  if (at.extended) {  // its equations include the operating conditions
    *device = ExtendedParameters(at, p);
    if (chain == nullptr) return true;
    chain->setZero(at.extended->size(), problem.shared());
    for (int k = 0; k < at.extended->size(); ++k) (*chain)(k, at.shared_of[k]) = 1;
    return true;
  }
  if (!(irradiance > 0) || !(temperature > 100) || !(temperature < 600)) return false;
  const int count = at.device.size(), shared = at.size();
  device->resize(count);
  if (chain == nullptr) {
    Translate(at, p, irradiance, temperature, device->data());
  } else {
    std::vector<Unknowns> x(shared), dual(count);
    for (int i = 0; i < shared; ++i) x[i] = Unknowns(p[i], i);
    Translate(at, x.data(), Unknowns(irradiance, shared), Unknowns(temperature, shared + 1),
              dual.data());
    chain->resize(count, shared + 2);
    for (int i = 0; i < count; ++i) {
      (*device)[i] = dual[i].a;
      std::copy_n(dual[i].v, shared + 2, chain->row(i).data());
    }
  }
  return std::all_of(device->begin(), device->end(), [](double x) { return std::isfinite(x); });
}

// Residuals of a curve's readings without those of priors; `slopes`, if not null: their derivatives
// by the device's parameters. False if the model cannot be evaluated.
bool PointResiduals(const JointProblem& problem, const JointCurve& curve, const Device& device,
                    const double* p, const PointSet& points, double* residuals, RowMatrix* slopes) {
  ModelCurrents(device, problem.objective, p, points, FastestKernel(), residuals,
                slopes != nullptr ? slopes->data() : nullptr);
  if (!std::isfinite(residuals[0])) return false;
  for (int k = 0; k < curve.residuals(); ++k) {
    const double root = std::sqrt(curve.weight[k]);
    residuals[k] = root * (residuals[k] - curve.current_A[k]);
    if (slopes != nullptr) slopes->row(k) *= root;
  }
  return true;
}

// As PointResiduals, of measured key points.
bool ResidualsOfKeyPoints(const JointProblem& problem, const JointCurve& curve,
                          const Device& device, const double* p, double* residuals,
                          RowMatrix* slopes) {
  RowMatrix by_device(kKeyPointRows, device.size());
  const KeyPointValues model = KeyPointsNear(device, p, curve.key_points->value,
                                             slopes != nullptr ? by_device.data() : nullptr);
  int row = 0;
  for (int k = 0; k < kKeyPointRows; ++k) {
    const double measured = curve.key_points->value[k];
    if (!std::isfinite(measured)) continue;
    const double scale = problem.key_point_scale_A / (curve.key_points->error[k] * measured);
    residuals[row] = scale * (model[k] - measured);
    if (!std::isfinite(residuals[row])) return false;
    if (slopes != nullptr) slopes->row(row) = scale * by_device.row(k);
    ++row;
  }
  return true;
}

}  // namespace

std::vector<OwnUnknown> OwnUnknowns(const JointCurve& curve) {
  std::vector<OwnUnknown> own;
  if (curve.irradiance_sd > 0) own.push_back({0, curve.irradiance_sd});
  if (curve.temperature_sd_K > 0) own.push_back({1, curve.temperature_sd_K});
  return own;
}

FamilyModel::FamilyModel(const JointProblem& problem)
    : FitModel(ShapeOf(problem)), problem_(problem) {
  CHECK(problem.translation.extended || problem.translation.size() + 2 <= kUnknowns);
  for (const JointCurve& curve : problem.curves) {
    points_.push_back(MakePointSet(curve.voltage_V, curve.current_A));
  }
}

FitPoint FamilyModel::Pack(const JointPoint& point) const {
  FitPoint packed{point.shared, {}};
  for (std::size_t c = 0; c < problem_.curves.size(); ++c) {
    for (const OwnUnknown& own : OwnUnknowns(problem_.curves[c])) {
      packed.local.push_back(c < point.local.size() ? point.local[c][own.which] : 0);
    }
  }
  return packed;
}

JointPoint FamilyModel::Unpack(const FitPoint& point) const {
  JointPoint joint{point.p, std::vector<JointLocal>(problem_.curves.size(), {0, 0})};
  std::size_t next = 0;
  for (std::size_t c = 0; c < problem_.curves.size(); ++c) {
    for (const OwnUnknown& own : OwnUnknowns(problem_.curves[c])) {
      joint.local[c][own.which] = point.local[next++];
    }
  }
  return joint;
}

bool FamilyModel::Evaluate(int block, const double* p, const double* local, double* residuals,
                           double* slopes, double* local_slopes) const {
  const Translation& at = problem_.translation;
  const JointCurve& curve = problem_.curves[block];
  const std::vector<OwnUnknown> own = OwnUnknowns(curve);
  double part[] = {0, 0};
  for (std::size_t k = 0; k < own.size(); ++k) part[own[k].which] = local[k];
  const double irradiance = curve.irradiance_W_m2 * (1 + part[0]) + p[problem_.irradiance_offset()];
  const double temperature = curve.temperature_K + part[1] + p[problem_.temperature_offset()];
  const bool sloped = slopes != nullptr || local_slopes != nullptr;
  std::vector<double> device;
  RowMatrix chain;
  if (!TranslateCurve(problem_, p, irradiance, temperature, &device, sloped ? &chain : nullptr)) {
    return false;
  }
  const int points = curve.residuals();
  const Device& own_device = DeviceOf(problem_, block);
  RowMatrix by_device(sloped ? points : 0, own_device.size());
  RowMatrix* const wanted = sloped ? &by_device : nullptr;
  const bool evaluated =
      curve.key_points
          ? ResidualsOfKeyPoints(problem_, curve, own_device, device.data(), residuals, wanted)
          : PointResiduals(problem_, curve, own_device, device.data(), points_[block], residuals,
                           wanted);
  if (!evaluated) return false;
  // The common errors of the sensors shift irradiance and temperature one to one; priors do not
  // depend on shared parameters.
  const FitBlock& size = shape().blocks[block];
  RowMatrix by_unknown = RowMatrix::Zero(sloped ? size.residuals : 0, problem_.shared());
  if (sloped) by_unknown.topRows(points).noalias() = by_device.lazyProduct(chain);
  if (slopes != nullptr) std::copy_n(by_unknown.data(), by_unknown.size(), slopes);
  int row = points;
  for (int k = 0; k < size.locals; ++k) {
    const double per_unknown = own[k].which == 0 ? curve.irradiance_W_m2 : 1;
    for (int r = 0; local_slopes != nullptr && r < points; ++r) {
      local_slopes[r * size.locals + k] = per_unknown * by_unknown(r, at.size() + own[k].which);
    }
    if (!std::isfinite(own[k].sd)) continue;
    residuals[row] = problem_.noise_A * local[k] / own[k].sd;
    if (local_slopes != nullptr) local_slopes[row * size.locals + k] = problem_.noise_A / own[k].sd;
    ++row;
  }
  return true;
}

}  // namespace lyrefit
