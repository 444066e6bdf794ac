#include "lyrefit/estimate/fit/reading_errors.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/fit/average_neighbours.h"
#include "lyrefit/estimate/refine/curve_model.h"
#include "lyrefit/estimate/refine/linearize.h"
#include "lyrefit/model/current.h"

namespace lyrefit {
namespace {

constexpr int kSpare = 3;  // least excess of readings over parameters, for three sizes
constexpr double kExactReadings = 1e-11;

// Largest delivered current and Voc of a lit curve, which its forward current may exceed manyfold.
// Otherwise the largest current and forward voltage: a dark curve crosses 0 A near 0 V, or where an
// offset has it.
struct Scales {
  double current_A;
  double voltage_V;
};

Scales ScalesOf(const RefineProblem& problem, const IvCurve& curve) {
  Scales scales = {problem.current_scale_A, problem.voltage_scale_V};
  if (IsDark(curve)) return scales;
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  const double most_A = *std::max_element(curve.current_A.begin(), curve.current_A.end());
  if (most_A > 0) scales.current_A = most_A;
  if (key.open_circuit_voltage_V > 0) scales.voltage_V = key.open_circuit_voltage_V;
  return scales;
}

// Path length along the sweep up to each reading, in units of Voc. It is computed from means of
// neighbours, since noise of close voltages would lengthen it at each reading.
std::vector<double> PositionsOf(const std::vector<double>& voltage_V, double open_circuit_V) {
  const Grouping first = GroupNeighbours(voltage_V, open_circuit_V);
  const std::vector<double> means = Means(first, voltage_V);
  std::vector<double> positions;
  double way = 0;
  for (std::size_t g = 0; g < means.size(); ++g) {
    if (g > 0) way += std::fabs(means[g] - means[g - 1]) / open_circuit_V;
    positions.insert(positions.end(), first[g + 1] - first[g], way);
  }
  return positions;
}

// The problem with independent errors, whose residuals are not whitened.
RefineProblem Plain(RefineProblem problem) {
  problem.errors = nullptr;
  return problem;
}

}  // namespace

void AppendErrorShape(const ReadingsAt& at, int chain, ErrorShape* shape) {
  const bool measured = at.objective == Objective::kMeasuredCurrent;
  const std::vector<double> current =
      SolveCurrents(at.device, at.p.data(), MakePointSet(at.voltage_V, at.current_A));
  const std::vector<double> position = PositionsOf(at.voltage_V, at.open_circuit_V);
  const double junction_V = at.p[IdealityIndex(0)] * at.device.module_thermal_voltage_V;
  shape->position.insert(shape->position.end(), position.begin(), position.end());
  for (std::size_t k = 0; k < current.size(); ++k) {
    const double voltage = at.voltage_V[k];
    const OperatingPoint point = KnownOperatingPoint(at.device, at.p.data(), voltage, current[k]);
    const double factor = ImplicitFactor(at.device, at.p.data(), point);
    // An error of 1 A of the current is an error of 1 - Rs F' of the measured-current residual.
    const double unit = std::sqrt(at.weight[k]) / (measured ? factor : 1);
    const double slope = std::fabs(point.conductance_S) * factor;
    shape->current.push_back(unit);
    if (at.dark) {
      // An instrument errs by a part of each reading, over decades of current. So does an error of
      // the junction's voltage.
      shape->voltage.push_back(unit * std::fabs(current[k]) / junction_V);
      shape->path.push_back(unit * std::fabs(current[k]));
      shape->part.push_back(0);  // that of the voltage is one
    } else {
      // The error of a voltage is proportional to the voltage.
      shape->voltage.push_back(unit * slope * std::fabs(voltage) / at.open_circuit_V);
      shape->path.push_back(unit * at.p[kIph] * factor);
      shape->part.push_back(unit * std::fabs(current[k]));
    }
    shape->chain.push_back(chain);
  }
}

ErrorShape ShapeOfErrors(const RefineProblem& problem, const IvCurve& curve,
                         const std::vector<double>& p) {
  ErrorShape shape;
  AppendErrorShape({problem.device, problem.objective, problem.voltage_V, problem.current_A,
                    problem.weights, ScalesOf(problem, curve).voltage_V, p, IsDark(curve)},
                   0, &shape);
  if (IsDark(curve) || !curve.sigma_A.empty()) shape.part.clear();
  for (std::size_t k = 0; k < curve.sigma_A.size(); ++k) {
    shape.stated.push_back(shape.current[k] * curve.sigma_A[k]);
  }
  return shape;
}

std::optional<FoundErrors> FindErrors(const RefineProblem& problem, const IvCurve& curve,
                                      const RefineEnd& end, bool path_is_usual) {
  const RefineProblem plain = Plain(problem);
  const Linearization now = Linearize(CurveModel(plain), end, end.active);
  const auto spare = now.jacobian.rows() - now.jacobian.cols();
  const double smallest = kExactReadings * problem.current_scale_A;
  const double rms = now.residual.norm() / std::sqrt(static_cast<double>(now.residual.size()));
  if (spare < kSpare || !(rms > smallest)) return {};
  const Scales scales = ScalesOf(problem, curve);
  const Grouping groups = GroupNeighbours(problem.voltage_V, scales.voltage_V);
  const ErrorShape shape = ShapeOfErrors(problem, curve, end.p);
  ErrorPrior prior = UsualErrors(scales.current_A, scales.voltage_V);
  prior.path_is_usual = path_is_usual && !IsDark(curve);
  FoundErrors found = FindErrorSizes(
      AverageShape(groups, shape), prior, AverageRows(groups, RowMatrix(now.residual)),
      AverageRows(groups, now.jacobian), DifferencesWithin(groups, shape, now.residual));
  if (!curve.sigma_A.empty()) {
    double squares = 0;
    for (const double sigma : curve.sigma_A) squares += sigma * sigma;
    found.sizes.current_A = std::sqrt(squares / static_cast<double>(curve.size()));
  }
  return found;
}

RefineProblem WeighByErrors(const RefineProblem& plain, const IvCurve& curve, const ErrorSpec& spec,
                            const std::vector<double>& p) {
  // Effects act on single readings, which must not be averaged.
  const Grouping groups = plain.device.effects == nullptr
                              ? GroupNeighbours(plain.voltage_V, ScalesOf(plain, curve).voltage_V)
                              : EachAlone(plain.voltage_V.size());
  RefineProblem weighed = plain;
  if (groups.size() <= plain.voltage_V.size()) weighed = AverageProblem(groups, plain, p);
  weighed.weights.assign(weighed.voltage_V.size(), 1);
  RefineProblem unweighted = plain;
  unweighted.weights.assign(plain.voltage_V.size(), 1);
  ErrorShape shape = AverageShape(groups, ShapeOfErrors(unweighted, curve, p));
  if (spec.kind == ErrorKind::kStated) shape.stated.clear();
  ErrorModel errors = MakeErrorModel(shape, spec.sizes);
  double squares = 0;
  for (const double white : errors.white) squares += white * white;
  for (const double path : errors.path) squares += path * path;
  weighed.noise_A = std::sqrt(squares / static_cast<double>(errors.size()));
  for (double& white : errors.white) white /= weighed.noise_A;
  for (double& path : errors.path) path /= weighed.noise_A;
  weighed.errors = std::make_shared<const ErrorModel>(std::move(errors));
  return weighed;
}

}  // namespace lyrefit
