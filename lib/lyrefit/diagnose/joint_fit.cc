#include "lyrefit/diagnose/joint_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/diagnose/law_coordinates.h"

namespace lyrefit {
namespace {

constexpr double kStep = 1e-3;      // of an unknown, in standard deviations
constexpr double kFarthest = 6;     // limit of an unknown, in standard deviations
constexpr double kOpenCircuit = 1;  // search range above the initial Voc, V per cell

bool Currents(const CurveLaw& own, const Readings& readings, double* current,
              double* jacobian = nullptr) {
  LawWorkspace workspace;
  return LawCoordinates(own.law, readings)
      .Evaluate(own.theta.data(), &workspace, current, jacobian);
}

// Sets the voltage of readings above 0 V to the law's Voc. These curves have no unknown bypass drop,
// so `unknown` changes light and temperature only.
bool FindOpenCircuit(const CurveLaw& own, const std::vector<double>& unknown, PlannedCurve* curve) {
  const Readings all = Under(*curve, unknown);
  Readings one = all;
  bool found = true;
  const auto current = [&](double voltage) {
    one.points.front().voltage = voltage;
    double result = 0;
    found = found && Currents(own, one, &result);
    return result;
  };
  for (std::size_t k = 0; k < all.points.size(); ++k) {
    double& voltage = curve->readings.points[k].voltage;
    if (!(voltage > 0)) continue;
    one.points = {all.points[k]};
    voltage = RootBetween(current, 0, voltage + kOpenCircuit);
  }
  return found;
}

// Noise of the used reading with the nearest current.
double SigmaAt(const WeightedData& measured, double current) {
  double nearest = 1e300, sigma = 0;
  for (std::size_t k = 0; k < measured.sigma.size(); ++k) {
    if (measured.used[k] == 0) continue;
    const double off = std::fabs(measured.readings->points[k].current - current);
    if (off >= nearest) continue;
    nearest = off;
    sigma = measured.sigma[k];
  }
  return sigma;
}

std::vector<double> InUnits(const std::vector<double>& unknown, const std::vector<double>& sizes) {
  std::vector<double> values;
  for (std::size_t k = 0; k < sizes.size(); ++k) values.push_back(unknown[k] * sizes[k]);
  return values;
}

// Residuals of one further curve from row `first` on, and derivatives by all coordinates.
bool EvaluateCurve(const Joint& joint, const PlannedCurve& curve, int first, const Law& law,
                   const std::vector<double>& theta, double* residuals, RowMatrix* rows) {
  const int count = static_cast<int>(curve.readings.points.size());
  const int size = law.size();
  const CurveLaw own = LawOn(curve, law, theta);
  std::vector<double> unknown(theta.begin() + size, theta.end());
  const Readings readings = Under(curve, InUnits(unknown, joint.unknown));
  std::vector<double> current(count);
  RowMatrix slopes(count, own.law.size());
  if (!Currents(own, readings, current.data(), rows != nullptr ? slopes.data() : nullptr)) {
    return false;
  }
  for (int k = 0; k < count; ++k) {
    residuals[first + k] = current[k] - joint.readings.points[first + k].current;
  }
  if (rows == nullptr) return true;
  for (std::size_t k = 0; k < own.from.size(); ++k) {
    rows->block(first, own.from[k], count, 1) = slopes.col(static_cast<int>(k));
  }
  std::vector<double> moved(count);
  for (const int u : {curve.light, curve.temperature, curve.drop}) {
    if (u < 0) continue;
    std::vector<double> shifted = unknown;
    shifted[u] += kStep;
    if (!Currents(own, Under(curve, InUnits(shifted, joint.unknown)), moved.data())) return false;
    for (int k = 0; k < count; ++k) (*rows)(first + k, size + u) = (moved[k] - current[k]) / kStep;
  }
  return true;
}

// All rows: readings already measured, further readings, then the unknowns.
bool EvaluateJoint(const Joint& joint, const LawCoordinates& coordinates, const Law& law,
                   const double* values, LawWorkspace* workspace, double* residuals,
                   double* jacobian) {
  const int size = law.size(), unknown = static_cast<int>(joint.unknown.size());
  const int count = static_cast<int>(joint.readings.points.size());
  const std::vector<double> theta(values, values + size + unknown);
  RowMatrix rows;
  if (jacobian != nullptr) rows.setZero(count, size + unknown);
  RowMatrix slopes(joint.taken, size);
  std::vector<double> current(joint.taken);
  if (!coordinates.Evaluate(values, workspace, current.data(),
                            jacobian != nullptr ? slopes.data() : nullptr)) {
    return false;
  }
  for (int k = 0; k < joint.taken; ++k) {
    residuals[k] = current[k] - joint.readings.points[k].current;
  }
  if (jacobian != nullptr) rows.topLeftCorner(joint.taken, size) = slopes;
  int first = joint.taken;
  for (const PlannedCurve& curve : joint.curves) {
    if (!EvaluateCurve(joint, curve, first, law, theta, residuals,
                       jacobian != nullptr ? &rows : nullptr)) {
      return false;
    }
    first += static_cast<int>(curve.readings.points.size());
  }
  Eigen::Map<RowMatrix> r(residuals, count, 1);
  Whiten(joint.errors, joint.used, r);
  for (int k = 0; k < unknown; ++k) residuals[count + k] = theta[size + k];
  if (!r.allFinite()) return false;
  if (jacobian == nullptr) return true;
  Whiten(joint.errors, joint.used, rows);
  Eigen::Map<RowMatrix> all(jacobian, count + unknown, size + unknown);
  all.topRows(count) = rows;
  all.bottomRows(unknown).setZero();
  for (int k = 0; k < unknown; ++k) all(count + k, size + k) = 1;
  return all.allFinite();
}

}  // namespace

std::optional<Joint> TakeFurther(const WeightedData& measured, double deviation,
                                 const FollowUp& follow_up, const LawFit& truth,
                                 const std::vector<double>& unknown) {
  Joint joint{follow_up.curves,
              follow_up.unknown,
              *measured.readings,
              measured.sigma,
              measured.used,
              {},
              0};
  for (double& sigma : joint.sigma) sigma *= deviation;
  joint.taken = static_cast<int>(measured.readings->points.size());
  const std::vector<double> values = InUnits(unknown, follow_up.unknown);
  const std::vector<double> theta = LawCoordinates(truth.law, *measured.readings).Of(truth.p);
  for (PlannedCurve& curve : joint.curves) {
    const CurveLaw own = LawOn(curve, truth.law, theta);
    if (curve.open_circuit && !FindOpenCircuit(own, values, &curve)) return std::nullopt;
    std::vector<double> current(curve.readings.points.size());
    if (!Currents(own, Under(curve, values), current.data())) return std::nullopt;
    const Reading last = joint.readings.points.back();
    for (std::size_t k = 0; k < current.size(); ++k) {
      Reading reading = curve.readings.points[k];
      reading.current = current[k];
      reading.curve = last.curve + 1;
      reading.segment += last.segment + 1;
      joint.readings.points.push_back(reading);
      joint.sigma.push_back(deviation * SigmaAt(measured, current[k]));
      joint.used.push_back(1);
    }
  }
  WeightedData weighted = measured;
  weighted.readings = std::make_shared<const Readings>(joint.readings);
  weighted.sigma = joint.sigma;
  weighted.used = joint.used;
  weighted.path *= deviation;
  joint.errors = ErrorsOf(weighted);
  return joint;
}

std::vector<double> DrawErrors(const ErrorModel& errors, RandomStream* random) {
  std::vector<double> drawn(errors.size());
  double path = 0;
  for (int place = 0, before = -1; place < errors.size(); ++place) {
    const int k = errors.order.empty() ? place : errors.order[place];
    if (!errors.path.empty()) {
      const bool follows = before >= 0 && errors.chain[k] == errors.chain[before];
      const double kept = follows ? std::exp(errors.position[before] - errors.position[k]) : 0;
      path = kept * path + std::sqrt(1 - kept * kept) * random->Normal();
    }
    const double shared = errors.path.empty() ? 0 : errors.path[k] * path;
    drawn[k] = shared + errors.white[k] * random->Normal();
    before = k;
  }
  return drawn;
}

void Disturb(RandomStream* random, Joint* joint) {
  const std::vector<double> drawn = DrawErrors(joint->errors, random);
  for (std::size_t k = joint->taken; k < drawn.size(); ++k) {
    joint->readings.points[k].current += drawn[k];
  }
}

FurtherEnd FitJoint(const Joint& joint, const Law& law,
                    const std::vector<std::vector<double>>& starts) {
  Readings old = joint.readings;
  old.points.resize(joint.taken);
  const LawCoordinates coordinates(law, old);
  LeastSquaresProblem problem = coordinates.Problem();
  const int unknown = static_cast<int>(joint.unknown.size());
  const int count = static_cast<int>(joint.readings.points.size());
  problem.residuals = count + unknown;
  problem.lower.resize(law.size() + unknown, -kFarthest);
  problem.upper.resize(law.size() + unknown, kFarthest);
  problem.fixed.resize(law.size() + unknown, 0);
  LawWorkspace workspace;
  problem.evaluate = [&](const double* theta, double* residuals, double* jacobian) {
    return EvaluateJoint(joint, coordinates, law, theta, &workspace, residuals, jacobian);
  };
  LeastSquaresEnd best;
  for (const std::vector<double>& p : starts) {
    std::vector<double> start = coordinates.Of(p);
    start.resize(law.size() + unknown, 0.0);
    LeastSquaresOptions options = UpTo(40, 1e-6);
    if (best.usable) options.cutoff = best.sum_of_squares;
    LeastSquaresEnd end = SolveLeastSquares(problem, start, options);
    if (end.usable && (!best.usable || end.sum_of_squares < best.sum_of_squares)) {
      best = std::move(end);
    }
  }
  FurtherEnd fit;
  if (!best.usable) return fit;
  std::vector<double> residuals(problem.residuals);
  fit.usable = problem.evaluate(best.p.data(), residuals.data(), nullptr);
  fit.sum = best.sum_of_squares;
  fit.after = Eigen::Map<Eigen::VectorXd>(residuals.data() + joint.taken, count - joint.taken);
  return fit;
}

}  // namespace lyrefit
