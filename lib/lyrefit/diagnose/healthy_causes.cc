#include "lyrefit/diagnose/healthy_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/effects/needs.h"

namespace lyrefit {
namespace {

// A dose of something that may have happened to a module: a base parameter raised, or an effect.
struct Dose {
  std::string id;
  std::string words;        // with the size in per cent in place of {}
  double percent = 1;       // of the dose, in the measure of `words`
  bool either_way = false;  // less of it is possible as well
  int parameter = -1;       // of the base that is raised,
  double raise = 0;         // by so much
  const char* effect = "";  // or an effect from the catalogue
  std::vector<double> p;    // with these parameters
};

std::vector<Dose> DosesFor(const FittedSweep& sweep) {
  const DataTraits& traits = sweep.measurement->readings.traits;
  const std::vector<double>& p = sweep.fit.p;
  const double voltage = std::max(traits.open_circuit, 0.1);
  std::vector<Dose> doses = {{"series_resistance",
                              "series resistance {:+.2g} %",
                              5,
                              true,
                              kBaseResistance,
                              0.05 * std::max(p[kBaseResistance], 1e-3),
                              "",
                              {}},
                             {"shunt",
                              "a leak that takes {:.2g} % of Isc at Voc",
                              0.5,
                              false,
                              kBaseConductance,
                              0.005 / voltage,
                              "",
                              {}},
                             {"ideality",
                              "n of the diode {:+.2g} % (recombination; the temperature)",
                              2,
                              true,
                              kBaseIdeality,
                              0.02 * p[kBaseIdeality],
                              "",
                              {}},
                             {"nonohmic_shunt",
                              "a leak that grows faster than the voltage, {:.2g} % of Isc at Voc",
                              0.5,
                              false,
                              -1,
                              0,
                              "nonohmic_shunt",
                              {0.005, 3}},
                             {"drift",
                              "light that changed by {:+.2g} % while the sweep was taken",
                              0.5,
                              true,
                              -1,
                              0,
                              "drift",
                              {0.005}}};
  if (traits.module && (traits.substrings > 1 || !traits.bypass_known)) {
    const int substrings = SubstringsOf(traits);
    if (substrings > 1) {
      doses.push_back({"shading",
                       fmt::format("one of {} substrings with {{:.2g}} % less light", substrings),
                       0.5,
                       false,
                       -1,
                       0,
                       "shading",
                       {0.005, 1.0 / substrings, 0.5, 1}});
    }
  }
  return doses;
}

// What a dose does to the currents, in scales; empty where the law cannot have it.
std::vector<double> ChangeBy(const FittedSweep& sweep, const Dose& dose) {
  const Readings& readings = sweep.measurement->readings;
  Law law = sweep.fit.law;
  std::vector<double> p = sweep.fit.p;
  if (dose.parameter >= 0) {
    p[dose.parameter] += dose.raise;
  } else {
    law.effects.push_back(FindEffect(dose.effect));
    p.insert(p.end(), dose.p.begin(), dose.p.end());
    if (law.size() != static_cast<int>(p.size())) return {};
  }
  LawWorkspace workspace;
  std::vector<double> change(readings.points.size());
  if (!EvaluateLaw(law, readings, p.data(), &workspace, change.data(), nullptr)) return {};
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= sweep.fit.current[k];
  return change;
}

// What a dose does to the quantities and the shape, beyond what its own change of Isc and Voc lets
// expect.
Eigen::VectorXd Direction(const FittedSweep& sweep, const Expectation& expected,
                          const std::vector<double>& change) {
  const SweepState after = StateWith(sweep, change);
  Eigen::VectorXd moved(3);
  moved << 0, std::log(after.isc_A / sweep.state.isc_A), after.voc_V - sweep.state.voc_V;
  moved.conservativeResize(expected.regressors);
  Eigen::VectorXd direction(kParameterQuantities + kShapeBins);
  const Eigen::VectorXd foretold = TransposedTimes(expected.slopes, moved);
  direction.head(kParameterQuantities) =
      ParametersOf(after) - ParametersOf(sweep.state) - foretold.head(kParameterQuantities);
  Eigen::VectorXd shape = after.shape - sweep.state.shape;
  for (double& value : shape) value = std::isfinite(value) ? value : 0;
  direction.tail(kShapeBins) = shape;
  return direction;
}

// The inverse covariance of what Direction gives. Neighbouring bins of a shape go together: they
// count as a third of their number. Few references say nothing of how quantities go together.
Eigen::MatrixXd Precision(const Expectation& expected) {
  constexpr double kTogether = 3, kSmallest = 1e-5;
  const int size = kParameterQuantities + kShapeBins;
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd covariance =
      expected.covariance.topLeftCorner(kParameterQuantities, kParameterQuantities);
  if (expected.degrees < 2 * kQuantities) {
    covariance = Eigen::MatrixXd(covariance.diagonal().asDiagonal());
  }
  for (int j = 0; j < kParameterQuantities; ++j) {
    precision.col(j).head(kParameterQuantities) =
        SolveSymmetric(covariance, Eigen::VectorXd::Unit(kParameterQuantities, j));
  }
  for (int k = 0; k < kShapeBins; ++k) {
    const double scale = std::hypot(expected.shape_scale[k], kSmallest);
    precision(kParameterQuantities + k, kParameterQuantities + k) = 1 / (kTogether * scale * scale);
  }
  return precision;
}

// What the readings would give of Pmax with and without a change of so many doses.
double PowerOf(const FittedSweep& sweep, const std::vector<double>& change, double doses) {
  const Readings& readings = sweep.measurement->readings;
  std::vector<double> voltage, now, without;
  for (std::size_t k = 0; k < change.size(); ++k) {
    voltage.push_back(readings.points[k].voltage);
    now.push_back(sweep.fit.current[k]);
    without.push_back(sweep.fit.current[k] - doses * change[k]);
  }
  return FindKeyPoints(voltage, now).max_power_W / FindKeyPoints(voltage, without).max_power_W - 1;
}

struct Attempt {
  HealthyCause cause;
  double left = 0;  // of the squared difference
};

std::optional<Attempt> Try(const FittedSweep& sweep, const Expectation& expected,
                           const Difference& difference, const Eigen::VectorXd& off,
                           const Eigen::MatrixXd& precision, const Dose& dose) {
  const std::vector<double> change = ChangeBy(sweep, dose);
  if (change.empty()) return {};
  const Eigen::VectorXd direction = Direction(sweep, expected, change);
  const Eigen::VectorXd weighed = Times(precision, direction);
  const double length = weighed.dot(direction);
  if (!(length > 0)) return {};
  const double doses = weighed.dot(off) / length;
  if (!dose.either_way && doses <= 0) return {};
  const double all = off.dot(Times(precision, off));
  const double error = std::sqrt(difference.widening / length) *
                       StudentQuantile(0.975, static_cast<double>(expected.degrees));
  Attempt attempt;
  attempt.left = (all - doses * doses * length) / difference.widening;
  HealthyCause& cause = attempt.cause;
  cause.id = dose.id;
  cause.size = doses * dose.percent;
  cause.low_95 = cause.size - error * dose.percent;
  cause.high_95 = cause.size + error * dose.percent;
  cause.unit = "%";
  cause.power = PowerOf(sweep, change, doses);
  cause.explained = doses * doses * length / all;
  cause.sentence = fmt::format(fmt::runtime(dose.words), cause.size) +
                   fmt::format(": {:+.2f} % of Pmax", 100 * cause.power);
  return attempt;
}

}  // namespace

std::vector<HealthyCause> ExplainDifference(const FittedSweep& sweep, const Expectation& expected,
                                            const Difference& difference) {
  // As good: within two deviations of the best. An explanation: of half of the difference.
  constexpr double kAsGood = 4, kHalf = 0.5;
  Eigen::VectorXd off(kParameterQuantities + kShapeBins);
  off.head(kParameterQuantities) = difference.value.head(kParameterQuantities);
  off.tail(kShapeBins) = difference.shape;
  const Eigen::MatrixXd precision = Precision(expected);
  std::vector<Attempt> attempts;
  for (const Dose& dose : DosesFor(sweep)) {
    if (auto attempt = Try(sweep, expected, difference, off, precision, dose)) {
      attempts.push_back(std::move(*attempt));
    }
  }
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const Attempt& a, const Attempt& b) { return a.left < b.left; });
  std::vector<HealthyCause> causes;
  for (Attempt& attempt : attempts) {
    if (attempt.left > attempts.front().left + kAsGood || attempt.cause.explained < kHalf) break;
    causes.push_back(std::move(attempt.cause));
  }
  return causes;
}

}  // namespace lyrefit
