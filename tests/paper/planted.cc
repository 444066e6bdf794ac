#include "paper/planted.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/base/random.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/model/kernel.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using Eigen::VectorXd;

// The device of a problem and the voltages of its measurement.
struct Bench {
  Device device;
  std::vector<double> p;
  double isc = 0;
  double voc = 0;
  VectorXd voltage;  // at the terminals, or at the junction for a measured-current optimum

  int diodes() const { return DiodeCount(device); }
  double PerVolt(int d) const {
    return 1 / (p[IdealityIndex(d)] * device.module_thermal_voltage_V);
  }
  // Current of the device at junction voltages, and its derivative.
  VectorXd Current(const VectorXd& vd) const {
    VectorXd current = VectorXd::Constant(vd.size(), p[kIph]) - vd / p[kRsh];
    for (int d = 0; d < diodes(); ++d) {
      for (Eigen::Index k = 0; k < vd.size(); ++k) {
        current[k] -= p[SaturationCurrentIndex(d)] * std::expm1(PerVolt(d) * vd[k]);
      }
    }
    return current;
  }
  VectorXd Slope(const VectorXd& vd) const {
    VectorXd slope = VectorXd::Constant(vd.size(), -1 / p[kRsh]);
    for (int d = 0; d < diodes(); ++d) {
      const double factor = p[SaturationCurrentIndex(d)] * PerVolt(d);
      slope.array() -= factor * (PerVolt(d) * vd.array()).exp();
    }
    return slope;
  }
};

// n of a diode: within the range, or at one of its ends, where optima often lie.
double DrawIdeality(const CertifyOptions& ranges, RandomStream* random) {
  const double low = std::max(ranges.n_lower, 0.8), high = std::min(ranges.n_upper, 2.5);
  const double n = low + (high - low) * random->Uniform();
  const double end = random->Uniform();
  if (end < 0.1) return ranges.n_upper;
  return end < 0.15 ? ranges.n_lower : n;
}

Bench DrawWeightedData(const SyntheticProblem& made, int number, RandomStream* random) {
  Bench bench;
  const Conditions& conditions = made.curve.conditions;
  bench.device = MakeDevice(made.model, conditions);
  bench.isc = 0.1 + 8 * random->Uniform();
  bench.voc = 0.6 * conditions.cells_in_series * (0.9 + 0.2 * random->Uniform());
  std::vector<double>& p = bench.p;
  p.resize(bench.device.size());
  p[kIph] = bench.isc;
  p[kRs] = (0.005 + 0.1 * random->Uniform()) * bench.voc / bench.isc;
  p[kRsh] = bench.voc / bench.isc * std::pow(10, 0.3 + 2.5 * random->Uniform());
  const int diodes = bench.diodes();
  for (int d = 0; d < diodes; ++d) {
    const double n = DrawIdeality(made.ranges, random);
    p[IdealityIndex(d)] = n;
    p[SaturationCurrentIndex(d)] =
        bench.isc / diodes / std::expm1(bench.voc / (n * bench.device.module_thermal_voltage_V));
  }
  const int fewest = std::max(8, 2 * diodes + 7);  // more points than optimality conditions
  const int points = number % 10 == 9 ? 100 + static_cast<int>(random->Index(201))
                                      : fewest + static_cast<int>(random->Index(61 - fewest));
  const auto reach = random->Index(3);  // some curves begin in reverse, some extend far beyond Voc
  const double low = reach == 1 ? -0.4 * bench.voc : 0;
  bench.voltage = VectorXd::LinSpaced(points, low, (reach == 2 ? 1.05 : 1.01) * bench.voc);
  return bench;
}

VectorXd RandomVector(Eigen::Index size, RandomStream* random) {
  VectorXd z(size);
  for (double& value : z) value = random->Normal();
  return z;
}

double RootMeanSquare(const VectorXd& y) {
  return y.norm() / std::sqrt(static_cast<double>(y.size()));
}

// Quantities of the optimality conditions at junction voltages `vd`. `weight` is the derivative of
// the residual by the current at the junction voltage; `rs_column` is the derivative by Rs.
struct Optimum {
  VectorXd vd, weight, rs_column;
  bool rs_fixed = false;
};

// Orthonormal basis of the columns of photocurrent, shunt and diodes, and of the derivatives by n
// for each n that is not at a bound. `with_rs` adds the derivative by Rs.
Eigen::MatrixXd TightColumns(const SyntheticProblem& made, const Bench& bench, const Optimum& at,
                             bool with_rs) {
  std::vector<VectorXd> columns = {at.weight, at.weight.cwiseProduct(at.vd)};
  const double scale = at.vd.maxCoeff();
  for (int d = 0; d < bench.diodes(); ++d) {
    const double u = bench.PerVolt(d), n = bench.p[IdealityIndex(d)];
    columns.push_back(at.weight.cwiseProduct(DiodeColumn(at.vd, scale, u)));
    if (n == made.ranges.n_lower || n == made.ranges.n_upper) continue;
    const VectorXd rise = ((at.vd.array() - scale) * u).exp() * at.vd.array();
    columns.push_back(at.weight.cwiseProduct(rise));
  }
  if (with_rs) columns.push_back(at.rs_column);
  Eigen::MatrixXd matrix(at.vd.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    matrix.col(static_cast<Eigen::Index>(c)) = columns[c].normalized();
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  return qr.householderQ() * Eigen::MatrixXd::Identity(matrix.rows(), qr.rank());
}

VectorXd Cleared(const Eigen::MatrixXd& tight, VectorXd z) {
  for (int pass = 0; pass < 2; ++pass) z -= tight * (tight.transpose() * z);
  return z;
}

// Diode column at point `step` of `steps` + 1 over the range of n (equal steps of 1/n).
VectorXd RangeColumn(const SyntheticProblem& made, const Bench& bench, const Optimum& at, int step,
                     int steps) {
  const double vt = bench.device.module_thermal_voltage_V;
  const double low = 1 / (made.ranges.n_upper * vt), high = 1 / (made.ranges.n_lower * vt);
  const double u = low + (high - low) * step / steps;
  return at.weight.cwiseProduct(DiodeColumn(at.vd, at.vd.maxCoeff(), u));
}

// Whether no diode in the range has a positive product with y beyond rounding, so that none reduces
// the residual.
bool NoDiodeHelps(const SyntheticProblem& made, const Bench& bench, const Optimum& at,
                  const VectorXd& y) {
  constexpr int kSteps = 2000;
  constexpr double kRounding = 2e-15;
  for (int i = 0; i <= kSteps; ++i) {
    const VectorXd column = RangeColumn(made, bench, at, i, kSteps);
    if (column.dot(y) > kRounding * column.norm() * y.norm()) return false;
  }
  return true;
}

// Removes from y its components along diode columns with positive product, the largest first. The
// result stays orthogonal to `tight`.
VectorXd TurnedAway(const SyntheticProblem& made, const Bench& bench, const Optimum& at,
                    const Eigen::MatrixXd& tight, VectorXd y) {
  constexpr int kTurns = 100, kColumns = 200;
  constexpr double kTooFar = 1.5, kWorth = 1e-14;
  Eigen::MatrixXd columns(y.size(), kColumns + 1);
  for (int i = 0; i <= kColumns; ++i) {
    const VectorXd column = RangeColumn(made, bench, at, i, kColumns);
    const VectorXd rest = Cleared(tight, column);
    columns.col(i) = rest.norm() > kWorth * column.norm() ? rest.normalized() : 0 * rest;
  }
  for (int turn = 0; turn < kTurns; ++turn) {
    Eigen::Index worst = 0;
    const double along = (columns.transpose() * y).maxCoeff(&worst);
    if (along <= 0) break;
    y -= kTooFar * along * columns.col(worst);
  }
  return Cleared(tight, y);
}

// Random residuals that satisfy the optimality conditions, scaled to the noise of the problem.
std::optional<VectorXd> DrawResiduals(const SyntheticProblem& made, const Bench& bench,
                                      const Optimum& at, RandomStream* random) {
  constexpr int kDraws = 20;
  const Eigen::MatrixXd tight = TightColumns(made, bench, at, !at.rs_fixed);
  for (int draw = 0; draw < kDraws; ++draw) {
    const VectorXd drawn = Cleared(tight, RandomVector(at.vd.size(), random));
    VectorXd y = TurnedAway(made, bench, at, tight, drawn);
    if (!(y.norm() > 1e-3 * drawn.norm())) continue;
    y *= made.noise * bench.isc / RootMeanSquare(y);
    if (NoDiodeHelps(made, bench, at, y)) return y;
  }
  return std::nullopt;
}

// The derivative of the measured-current residual by Rs contains the measured currents. Moves y
// along the one remaining direction until sum y slope (law + y) = 0.
VectorXd SyntheticStationary(const SyntheticProblem& made, const Bench& bench, const Optimum& at,
                             const VectorXd& y) {
  const VectorXd q = Cleared(TightColumns(made, bench, at, false), at.rs_column);
  const VectorXd slope = bench.Slope(at.vd);
  const double a = (q.array().square() * slope.array()).sum();
  const double b = q.squaredNorm() + 2 * (y.array() * q.array() * slope.array()).sum();
  const double c = (y.array().square() * slope.array()).sum();
  const double root = b * b - 4 * a * c;
  return root < 0 ? y : VectorXd(y - 2 * c / (b + std::copysign(std::sqrt(root), b)) * q);
}

void TakePoints(const VectorXd& voltage, const VectorXd& current, IvCurve* curve) {
  curve->voltage_V.assign(voltage.begin(), voltage.end());
  curve->current_A.assign(current.begin(), current.end());
}

bool PlantMeasured(const Bench& bench, SyntheticProblem* made, RandomStream* random) {
  Optimum at;
  at.vd = bench.voltage;
  at.weight = VectorXd::Ones(at.vd.size());
  at.rs_fixed = made->planted == Planted::kMeasuredAtRs;
  const VectorXd law = bench.Current(at.vd);
  at.rs_column = bench.Slope(at.vd).cwiseProduct(law);
  std::optional<VectorXd> y = DrawResiduals(*made, bench, at, random);
  if (y && !at.rs_fixed) {
    y = SyntheticStationary(*made, bench, at, *y);
    if (!NoDiodeHelps(*made, bench, at, *y)) return false;
  }
  if (!y) return false;
  const VectorXd current = law + *y;
  TakePoints(at.vd - bench.p[kRs] * current, current, &made->curve);
  if (at.rs_fixed) made->ranges.rs_lower_ohm = made->ranges.rs_upper_ohm = bench.p[kRs];
  return true;
}

VectorXd Solved(const Bench& bench) {
  const std::vector<double> voltage(bench.voltage.begin(), bench.voltage.end());
  const std::vector<double> current = SolveCurrents(bench.device, bench.p.data(), voltage);
  return Eigen::Map<const VectorXd>(current.data(), bench.voltage.size());
}

bool PlantSolved(const Bench& bench, SyntheticProblem* made, RandomStream* random) {
  Optimum at;
  const VectorXd solved = Solved(bench);
  at.vd = bench.voltage + bench.p[kRs] * solved;
  const VectorXd slope = bench.Slope(at.vd);
  at.weight = (1 - bench.p[kRs] * slope.array()).inverse();
  at.rs_column = at.weight.cwiseProduct(slope).cwiseProduct(solved);
  const std::optional<VectorXd> y = DrawResiduals(*made, bench, at, random);
  if (y) TakePoints(bench.voltage, solved + *y, &made->curve);
  return y.has_value();
}

// Sets ranges of Iph, Is and Rsh. A planted optimum lies inside them. For random errors the true
// Rsh lies above its range, and the parameter is set to the upper bound.
void DrawBox(const Bench& bench, SyntheticProblem* made) {
  CertifyOptions& ranges = made->ranges;
  ranges.iph_upper_A = 1.5 * bench.isc;
  ranges.is_upper_A = 0;
  for (int d = 0; d < bench.diodes(); ++d) {
    ranges.is_upper_A =
        std::max(ranges.is_upper_A, 3 * made->parameters[SaturationCurrentIndex(d)]);
  }
  double& shunt = made->parameters[kRsh];
  ranges.rsh_upper_ohm = (made->planted == Planted::kNothing ? 0.7 : 3) * shunt;
  shunt = std::min(shunt, ranges.rsh_upper_ohm);
}

bool Plant(const Bench& bench, SyntheticProblem* made, RandomStream* random) {
  if (made->planted == Planted::kNothing) return false;
  if (made->planted == Planted::kSolved) return PlantSolved(bench, made, random);
  return PlantMeasured(bench, made, random);
}

}  // namespace

SyntheticProblem MakeProblem(std::uint64_t seed, int number) {
  constexpr Planted kKinds[] = {Planted::kNothing, Planted::kMeasuredAtRs, Planted::kMeasured,
                                Planted::kSolved, Planted::kSolved};
  RandomStream random(seed, static_cast<std::uint64_t>(number));
  SyntheticProblem made;
  made.curve.name = fmt::format("made {}", number);
  made.curve.conditions.cells_in_series = random.Uniform() < 0.5 ? 1 : 36;
  made.curve.conditions.cell_temperature_K = 283.15 + 60 * random.Uniform();
  made.model = static_cast<Model>(1 + random.Index(3));
  made.planted = kKinds[number / 2 % 5];
  if (number % 2 == 1) {
    made.ranges.n_lower = 0.5;
    made.ranges.n_upper = 4;
  }
  const bool boxed = number % 3 == 2;
  made.noise = 1e-6 * std::pow(3e4, random.Uniform());
  constexpr int kDevices = 6;
  Bench bench;
  for (int device = 0; device < kDevices; ++device) {
    bench = DrawWeightedData(made, number / 2, &random);
    made.parameters = bench.p;
    if (Plant(bench, &made, &random)) {
      if (boxed) DrawBox(bench, &made);
      return made;
    }
    if (made.planted == Planted::kNothing) break;
  }
  made.planted = Planted::kNothing;
  const VectorXd errors = made.noise * bench.isc * RandomVector(bench.voltage.size(), &random);
  TakePoints(bench.voltage, Solved(bench) + errors, &made.curve);
  if (boxed) DrawBox(bench, &made);
  return made;
}

SyntheticProblem MakeWideProblem(std::uint64_t seed, int number) {
  constexpr int kFewestPoints = 8;
  SyntheticProblem made = MakeProblem(seed, number);
  RandomStream random(seed, 1000000 + static_cast<std::uint64_t>(number));
  IvCurve& curve = made.curve;
  const auto largest = [](const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
  };
  if (number % 3 == 1) {
    const double last = (0.75 + 0.25 * random.Uniform()) * largest(curve.voltage_V);
    const IvCurve part = UpTo(last, curve);
    if (part.size() >= kFewestPoints) curve = part;
  }
  const double reach = 0.9 + 0.8 * random.Uniform();
  made.planted = Planted::kNothing;
  made.ranges.rs_lower_ohm = 0;
  made.ranges.rs_upper_ohm = reach * largest(curve.voltage_V) / largest(curve.current_A);
  return made;
}

}  // namespace lyrefit
