#include "lyrefit/estimate/fit/reading_errors.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/refine/coarsen.h"
#include "lyrefit/estimate/refine/coordinates.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr double kWidest = 0.01;  // largest width of a group, in units of Voc

using Values = std::vector<double>;

// Width of each group along the path, at most kWidest: the distance of its mean to the nearer
// neighbouring mean. `position` has the means.
Values WidthsOf(const Values& position) {
  Values widths(position.size(), kWidest);
  for (std::size_t g = 0; g < position.size(); ++g) {
    if (g > 0) widths[g] = std::min(widths[g], position[g] - position[g - 1]);
    if (g + 1 < position.size()) widths[g] = std::min(widths[g], position[g + 1] - position[g]);
  }
  return widths;
}

// Relative loss of path variance by averaging within each group, times the path length l. For m
// readings at equal distances d, averaging multiplies the variance by the mean of exp(-|x - x'| /
// l) over all pairs. That is 1 - d (m^2 - 1) / (3 m l) where d m is much less than l.
Values AveragedAway(const Grouping& first, const Values& position) {
  Values parts = WidthsOf(position);
  for (std::size_t g = 0; g < parts.size(); ++g) {
    const double m = first[g + 1] - first[g];
    parts[g] *= (m * m - 1) / (3 * m * m);
  }
  return parts;
}

}  // namespace

Grouping GroupNeighbours(const std::vector<double>& voltage_V, double open_circuit_V) {
  const int readings = static_cast<int>(voltage_V.size());
  return GroupByRule(
      readings,
      {(readings + kFewPoints - 1) / kFewPoints, voltage_V, kWidest * open_circuit_V, {}});
}

ErrorShape AverageShape(const Grouping& first, const ErrorShape& shape) {
  ErrorShape means;
  means.current = MeanErrors(first, shape.current);
  means.voltage = MeanErrors(first, shape.voltage);
  means.stated = MeanErrors(first, shape.stated);
  means.part = MeanErrors(first, shape.part);
  means.path = Means(first, shape.path);
  means.position = Means(first, shape.position);
  if (first.size() <= shape.position.size()) {
    means.averaged_away = AveragedAway(first, means.position);
  }
  for (int g = 0; g < GroupCount(first); ++g) means.chain.push_back(shape.chain[first[g]]);
  return means;
}

Differences DifferencesWithin(const Grouping& first, const ErrorShape& shape,
                              const Eigen::VectorXd& residual) {
  Differences differences;
  const Values widths = WidthsOf(Means(first, shape.position));
  // The standard deviation of a difference is sqrt(2) times that of a typical reading.
  const auto append = [](const Values& errors, int begin, int end, Values* to) {
    double squares = 0;
    for (int k = begin; k < end && !errors.empty(); ++k) squares += errors[k] * errors[k];
    if (!errors.empty()) to->push_back(std::sqrt(2 * squares / (end - begin)));
  };
  for (int g = 0; g < GroupCount(first); ++g) {
    const int begin = first[g], count = first[g + 1] - begin, pairs = count / 2;
    if (pairs == 0) continue;
    const int end = begin + 2 * pairs;
    double squares = 0;
    for (int k = begin; k < end; k += 2) squares += std::pow(residual[k + 1] - residual[k], 2);
    append(shape.current, begin, end, &differences.shape.current);
    append(shape.voltage, begin, end, &differences.shape.voltage);
    append(shape.stated, begin, end, &differences.shape.stated);
    append(shape.part, begin, end, &differences.shape.part);
    append(shape.path, begin, end, &differences.shape.path);
    differences.shape.position.push_back(widths[g] / count);
    differences.count.push_back(pairs);
    differences.mean_square.push_back(squares / pairs);
  }
  return differences;
}

RefineProblem AverageProblem(const Grouping& first, const RefineProblem& problem,
                             const std::vector<double>& p) {
  const auto model = [&](const Values& voltage_V, const Values& near_A) {
    return SolveCurrents(problem.device, p.data(), MakePointSet(voltage_V, near_A));
  };
  Values distance = problem.current_A;
  const Values fitted = model(problem.voltage_V, problem.current_A);
  for (std::size_t k = 0; k < distance.size(); ++k) distance[k] -= fitted[k];
  Values voltage = Means(first, problem.voltage_V), current = Means(first, distance);
  const Values there = model(voltage, Means(first, problem.current_A));
  for (std::size_t g = 0; g < current.size(); ++g) current[g] += there[g];
  return WithPoints(problem, std::move(voltage), std::move(current), {});
}

std::vector<int> FindDegrees(const FoundErrors& found, const StandardErrorsAt& standard_errors,
                             int most) {
  constexpr double kStep = 0.1;  // step of ln size
  constexpr int kFewest = 3;
  constexpr double ErrorSizes::*kSizes[] = {&ErrorSizes::current_A, &ErrorSizes::voltage_V,
                                            &ErrorSizes::path, &ErrorSizes::length,
                                            &ErrorSizes::current_part};
  using Slopes = Eigen::Matrix<double, 5, 1>;
  std::vector<Slopes> slopes;  // d ln variance / d ln sizes, per estimate
  for (int j = 0; j < 5; ++j) {
    if (!(found.sizes.*kSizes[j] > 0)) continue;
    const auto beside = [&](double step) {
      ErrorSizes there = found.sizes;
      there.*kSizes[j] *= std::exp(step);
      return standard_errors(there);
    };
    const std::vector<double> up = beside(kStep), down = beside(-kStep);
    slopes.resize(up.size(), Slopes::Zero());
    for (std::size_t i = 0; i < up.size(); ++i) slopes[i][j] = std::log(up[i] / down[i]) / kStep;
  }
  std::vector<int> degrees;
  for (const Slopes& slope : slopes) {
    const double variance = slope.dot(found.uncertainty * slope);  // variance of ln variance
    const bool well_known = !std::isfinite(variance) || variance * most < 2;
    const int few = std::min(kFewest, most);
    degrees.push_back(well_known ? most : std::max(static_cast<int>(2 / variance), few));
  }
  return degrees;
}

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
