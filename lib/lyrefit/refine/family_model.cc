#include "lyrefit/refine/family_model.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/dual.h"
#include "lyrefit/refine/active_set.h"
#include "lyrefit/refine/model_current.h"

namespace lyrefit {
namespace {

// Every shared parameter of the richest law, irradiance and temperature.
constexpr int kUnknowns = 16;
using Unknowns = Dual<kUnknowns>;

constexpr double kAbsent = -25;  // ln(current of a vanished diode at V0 / I0)

struct OwnUnknown {
  int which;  // in JointLocal
  double sd;  // of its prior, may be infinite
};

std::vector<OwnUnknown> OwnUnknowns(const JointCurve& curve) {
  std::vector<OwnUnknown> own;
  if (curve.irradiance_sd > 0) own.push_back({0, curve.irradiance_sd});
  if (curve.temperature_sd_K > 0) own.push_back({1, curve.temperature_sd_K});
  return own;
}

ModelShape ShapeOf(const JointProblem& problem) {
  const Translation& at = problem.translation;
  ModelShape shape;
  shape.points = 0;
  for (const JointCurve& curve : problem.curves) {
    const int points = static_cast<int>(curve.voltage_V.size());
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

}  // namespace

FamilyModel::FamilyModel(const JointProblem& problem)
    : FitModel(ShapeOf(problem)), problem_(problem) {
  CHECK_LE(problem.translation.size() + 2, kUnknowns);
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
  if (!(irradiance > 0) || !(temperature > 100) || !(temperature < 600)) return false;
  const int count = at.device.size(), shared = at.size(), unknowns = problem_.shared();
  const bool sloped = slopes != nullptr || local_slopes != nullptr;
  std::vector<double> device(count);
  std::vector<Unknowns> dual(sloped ? count : 0);
  if (sloped) {
    std::vector<Unknowns> x(shared);
    for (int i = 0; i < shared; ++i) x[i] = Unknowns(p[i], i);
    Translate(at, x.data(), Unknowns(irradiance, shared), Unknowns(temperature, shared + 1),
              dual.data());
    for (int i = 0; i < count; ++i) device[i] = dual[i].a;
  } else {
    Translate(at, p, irradiance, temperature, device.data());
  }
  for (const double value : device) {
    if (!std::isfinite(value)) return false;
  }
  const int points = static_cast<int>(curve.voltage_V.size());
  RowMatrix by_device(sloped ? points : 0, count);
  ModelCurrents(at.device, problem_.objective, device.data(),
                {curve.voltage_V, curve.current_A, points_[block]}, FastestKernel(), residuals,
                sloped ? by_device.data() : nullptr);
  for (int k = 0; k < points; ++k) {
    const double root = std::sqrt(curve.weight[k]);
    residuals[k] = root * (residuals[k] - curve.current_A[k]);
    if (sloped) by_device.row(k) *= root;
  }
  RowMatrix by_unknown;
  if (sloped) {
    RowMatrix chain(count, unknowns);
    for (int i = 0; i < count; ++i) std::copy_n(dual[i].v, unknowns, chain.row(i).data());
    by_unknown.noalias() = by_device.lazyProduct(chain);
  }
  // Irradiance and temperature are the sensors' common errors but for a constant; priors depend on
  // none of what is shared.
  const int rows = shape().blocks[block].residuals, locals = shape().blocks[block].locals;
  if (slopes != nullptr) {
    std::copy_n(by_unknown.data(), by_unknown.size(), slopes);
    std::fill(slopes + by_unknown.size(), slopes + rows * unknowns, 0.0);
  }
  int row = points;
  for (int k = 0; k < locals; ++k) {
    const double per_unknown = own[k].which == 0 ? curve.irradiance_W_m2 : 1;
    for (int r = 0; local_slopes != nullptr && r < points; ++r) {
      local_slopes[r * locals + k] = per_unknown * by_unknown(r, shared + own[k].which);
    }
    if (!std::isfinite(own[k].sd)) continue;
    residuals[row] = problem_.noise_A * local[k] / own[k].sd;
    if (local_slopes != nullptr) local_slopes[row * locals + k] = problem_.noise_A / own[k].sd;
    ++row;
  }
  return true;
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

std::vector<double> DeviceAt(const JointProblem& problem, const JointPoint& point, int curve) {
  const TrueConditions at = ConditionsAt(problem, point, curve);
  std::vector<double> device(problem.translation.device.size());
  Translate(problem.translation, point.shared.data(), at.irradiance_W_m2, at.temperature_K,
            device.data());
  return device;
}

namespace {

RefineOptions HowToRefine(const JointOptions& options) {
  RefineOptions how;
  how.max_iterations = options.max_iterations;
  how.function_tolerance = options.function_tolerance;
  how.max_rounds = options.max_rounds;
  if (options.proceed) how.stop = [&options] { return !options.proceed(); };
  how.trust_radius = 1e6;  // starts are further off than a curve's
  return how;
}

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
    const std::size_t points = problem.curves[c].voltage_V.size();
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      (k < points ? end->squares : end->prior_squares) += residuals[k] * residuals[k];
    }
    local += block.locals;
  }
}

JointEnd RefineFamily(const JointProblem& problem, const FamilyModel& model, FitPoint start,
                      const RefineOptions& how) {
  RefineEnd found = RefineModel(model, std::move(start), how);
  const Translation& at = problem.translation;
  const int is = at.saturation_current_2;
  if (is >= 0 && found.held[is] && found.p[is] <= 0 && problem.upper[is] > 0) {
    const double pivot = problem.voltage_scale_V / at.device.module_thermal_voltage_V;
    found.p[is] = problem.current_scale_A * std::exp(kAbsent - pivot / found.p[at.n_2]);
  }
  JointEnd end;
  AddSquares(problem, model, found, &end);
  end.point = model.Unpack(found);
  end.converged = found.converged;
  end.stopped = found.stopped;
  end.iterations = found.iterations;
  end.projected_gradient = found.projected_gradient;
  end.held = std::move(found.held);
  return end;
}

}  // namespace

JointEnd RefineJointly(const JointProblem& problem, JointPoint start, const JointOptions& options) {
  const FamilyModel model(problem);
  return RefineFamily(problem, model, model.Pack(start), HowToRefine(options));
}

JointSpread FindJointSpread(const JointProblem& problem, const JointEnd& end, double variance) {
  const FamilyModel model(problem);
  JointSpread spread;
  static_cast<Spread&>(spread) = FindSpread(model, model.Pack(end.point), end.held, variance);
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

ProfileSide FindProfileSide(const JointProblem& problem, const JointEnd& best,
                            const ProfileQuery& query, const std::function<bool()>& proceed) {
  const FamilyModel model(problem);
  RefineEnd from;
  static_cast<FitPoint&>(from) = model.Pack(best.point);
  from.mean_square = (best.squares + best.prior_squares) / model.shape().points;
  JointOptions options;
  options.proceed = proceed;
  RefineOptions how = HowToRefine(options);
  ProfileRefits refits;
  refits.refit = [&](double value, const FitPoint& start, double enough, double tolerance) {
    FamilyModel held = model;
    held.Fix(query.parameter, value);
    FitPoint at = start;
    at.p[query.parameter] = value;
    how.enough = enough;
    how.function_tolerance = tolerance;
    return RefineModel(held, std::move(at), how);
  };
  return FindProfileSide(model, from, query, refits);
}

}  // namespace lyrefit
