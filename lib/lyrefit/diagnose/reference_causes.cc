#include "lyrefit/diagnose/reference_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

// `power`: relative change of Pmax.
ReferenceCause CauseWith(const std::string& id, const std::string& sentence, const Sized& size,
                         const char* unit, double power, double explained) {
  ReferenceCause cause;
  cause.id = id;
  cause.sentence = sentence;
  cause.strength = {{"", "size", unit, size.value, size.low_95, size.high_95}};
  cause.power_effect.value = -power;
  cause.explained = explained;
  return cause;
}

// A dose of a possible change of a module: a coordinate of the base raised, or an effect.
struct Dose {
  std::string id;
  std::string words;        // sentence with {} for the size in per cent
  double percent = 1;       // size of the dose, in the unit of `words`
  bool either_way = false;  // negative doses are possible too
  int coordinate = -1;      // the raised one (law_coordinates.h), -1: an effect
  double raise = 0;         // its increase
  const char* effect = "";  // id of an effect in the catalogue
  std::vector<double> p;    // its first parameters; the others are neutral
};

std::vector<Dose> DosesFor(const FittedSweep& sweep) {
  const DataTraits& traits = sweep.weighted.readings->traits;
  const double ohm = sweep.weighted.readings->scale.resistance_ohm();
  const double voltage = sweep.state.voc_V / sweep.state.cells;
  std::vector<Dose> doses = {{"series_resistance",
                              "series resistance {:+.2g} %",
                              5,
                              true,
                              kRs,
                              0.05 * std::max(sweep.fit.p[kRs] / ohm, 1e-3),
                              "",
                              {}},
                             {"shunt",
                              "a leak that takes {:.2g} % of Isc at Voc",
                              0.5,
                              false,
                              kRsh,
                              0.005 / voltage,
                              "",
                              {}},
                             {"ideality",
                              "n of the diode {:+.2g} % (recombination; the temperature)",
                              2,
                              true,
                              IdealityIndex(0),
                              0.02 * Ideality(sweep.fit),
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
                       {0.005, 1.0 / substrings}});
    }
  }
  return doses;
}

// Change of the currents by `doses` doses, in scales; empty if the law cannot be evaluated. The
// currents of the sweep include the change. A property that every module has (series resistance,
// ideality) is therefore reduced in the law. Any other change is added to the law, since the module
// may lack it.
std::vector<double> ChangeBy(const FittedSweep& sweep, const Dose& dose, double doses) {
  const Readings& readings = *sweep.weighted.readings;
  Law law = sweep.fit.law;
  std::vector<double> p = sweep.fit.p;
  const bool taken = dose.coordinate >= 0 && dose.either_way;
  const double sign = taken ? -1 : 1;
  if (dose.coordinate >= 0) {
    const LawCoordinates coordinates(law, readings);
    std::vector<double> theta = coordinates.Of(p);
    theta[dose.coordinate] = std::max(theta[dose.coordinate] + sign * doses * dose.raise, 0.0);
    p = coordinates.Parameters(theta);
  } else {
    const Effect& effect = *FindEffect(dose.effect);
    const std::size_t first = p.size();
    for (const EffectParameter& parameter : effect.parameters) p.push_back(parameter.neutral);
    std::copy(dose.p.begin(), dose.p.end(), p.begin() + static_cast<std::ptrdiff_t>(first));
    p[first] *= doses;
    law.effects.push_back(&effect);
  }
  LawWorkspace workspace;
  std::vector<double> change(readings.points.size());
  if (!EvaluateLaw(law, readings, p.data(), &workspace, change.data(), nullptr)) return {};
  for (std::size_t k = 0; k < change.size(); ++k) {
    change[k] = sign * (change[k] - sweep.fit.current[k]);
  }
  return change;
}

// Change of the quantities and the shape when `change` is removed from the readings. The part
// expected from the resulting change of Isc and Voc is subtracted.
Eigen::VectorXd TakenOff(const FittedSweep& sweep, const Expectation& expected,
                         std::vector<double> change) {
  for (double& value : change) value = -value;
  const SweepState without = StateWith(sweep, change);
  Eigen::VectorXd moved(3);
  moved << 0, std::log(sweep.state.isc_A / without.isc_A), sweep.state.voc_V - without.voc_V;
  moved.conservativeResize(expected.regressors);
  const Eigen::VectorXd foretold = TransposedTimes(expected.slopes, moved);
  Eigen::VectorXd taken(kParameterQuantities + kShapeBins);
  taken.head(kParameterQuantities) =
      ParametersOf(sweep.state) - ParametersOf(without) - foretold.head(kParameterQuantities);
  Eigen::VectorXd shape = sweep.state.shape - without.shape;
  for (double& value : shape) value = std::isfinite(value) ? value : 0;
  taken.tail(kShapeBins) = shape;
  return taken;
}

// Inverse covariance of the vector that TakenOff returns. Neighbouring bins of a shape are
// correlated and count as a third of their number. Few references do not determine the correlation
// of the quantities, which is then set to 0.
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

// Relative change of Pmax by a change of the currents.
double PowerOf(const FittedSweep& sweep, const std::vector<double>& change) {
  const Readings& readings = *sweep.weighted.readings;
  std::vector<double> voltage, without;
  for (std::size_t k = 0; k < change.size(); ++k) {
    voltage.push_back(readings.points[k].voltage);
    without.push_back(sweep.fit.current[k] - change[k]);
  }
  return FindKeyPoints(voltage, sweep.fit.current).max_power_W /
             FindKeyPoints(voltage, without).max_power_W -
         1;
}

// The difference to be explained and its precision matrix.
struct Puzzle {
  const FittedSweep& sweep;
  const Expectation& expected;
  double widening;
  Eigen::VectorXd off;
  Eigen::MatrixXd precision;
};

struct Attempt {
  ReferenceCause cause;
  bool generic = false;  // drift of the light, no fault of the device
  double left = 0;       // unexplained part of the squared difference
};

// Converts a relative change from the present value of a parameter to its former value.
double InPercent(const Dose& dose, double percent) {
  if (dose.coordinate < 0 || !dose.either_way) return percent;
  return percent / std::max(1 - percent / 100, 0.01);
}

// Secant iteration for the number of doses, from `doses`. It is needed because some changes are not
// proportional to the dose: a shunt that reaches 0, a shade smaller than the plateau's slope.
std::optional<Attempt> TryFrom(const Puzzle& puzzle, const Dose& dose, double doses) {
  constexpr int kRounds = 5;
  constexpr double kMost = 60, kNear = 0.02;
  Eigen::VectorXd taken;
  std::vector<double> change;
  double length = 0;
  for (int round = 0; round < kRounds; ++round) {
    change = ChangeBy(puzzle.sweep, dose, doses);
    if (change.empty()) return {};
    taken = TakenOff(puzzle.sweep, puzzle.expected, change);
    const Eigen::VectorXd weighed = Times(puzzle.precision, taken);
    length = weighed.dot(taken);
    if (!(length > 0)) return {};
    const double factor = weighed.dot(puzzle.off) / length;
    if (round + 1 == kRounds || std::fabs(factor - 1) < kNear) break;
    doses = std::clamp(factor * doses, -kMost, kMost);
    if (doses == 0 || (doses < 0 && !dose.either_way)) return {};
  }
  const Eigen::VectorXd left = puzzle.off - taken;
  const double all = puzzle.off.dot(Times(puzzle.precision, puzzle.off));
  const double error = std::fabs(doses) * dose.percent * std::sqrt(puzzle.widening / length) *
                       StudentQuantile(0.975, puzzle.expected.degrees);
  Attempt attempt;
  attempt.generic = dose.id == "drift";
  attempt.left = left.dot(Times(puzzle.precision, left)) / puzzle.widening;
  const double percent = doses * dose.percent;
  const Sized size = {InPercent(dose, percent), InPercent(dose, percent - error),
                      InPercent(dose, percent + error)};
  const double power = PowerOf(puzzle.sweep, change);
  attempt.cause = CauseWith(dose.id,
                            fmt::format(fmt::runtime(dose.words), size.value) +
                                fmt::format(", Pmax {:+.2f} %", 100 * power),
                            size, "%", power, 1 - attempt.left * puzzle.widening / all);
  attempt.cause.effect = dose.effect;
  return attempt;
}

void Try(const Puzzle& puzzle, const Dose& dose, std::vector<Attempt>* attempts) {
  std::optional<Attempt> best = TryFrom(puzzle, dose, 1);
  if (dose.either_way) {
    std::optional<Attempt> less = TryFrom(puzzle, dose, -1);
    if (less && (!best || less->left < best->left)) best = std::move(less);
  }
  if (best) attempts->push_back(std::move(*best));
}

// What a quantity is above its expected value, in parts of `unit`.
Sized Change(const ReferenceRow& row, double unit) {
  return {(row.now - row.expected) / unit, (row.now - row.high_95) / unit,
          (row.now - row.low_95) / unit};
}

}  // namespace

std::vector<ReferenceCause> ExplainDifference(const FittedSweep& sweep, const Expectation& expected,
                                              const Difference& difference) {
  // A cause is as good as the best within two deviations, or three for a drift of the light. A
  // deviation is widened if the best one leaves more than its nine or so independent values
  // explain. Each cause must explain half of the difference.
  constexpr double kAsGood = 4, kClearly = 9, kHalf = 0.5, kNumbers = 9;
  Puzzle puzzle{sweep, expected, difference.widening,
                Eigen::VectorXd(kParameterQuantities + kShapeBins), Precision(expected)};
  puzzle.off.head(kParameterQuantities) = difference.value.head(kParameterQuantities);
  puzzle.off.tail(kShapeBins) = difference.shape;
  std::vector<Attempt> attempts;
  for (const Dose& dose : DosesFor(sweep)) Try(puzzle, dose, &attempts);
  double least = std::numeric_limits<double>::max();
  for (const Attempt& a : attempts) least = std::min(least, a.left);
  const double unit = std::max(1.0, least / kNumbers);
  const auto calibration = [unit](const Attempt& a) {
    return a.left + (a.generic ? kClearly * unit : 0);
  };
  std::stable_sort(attempts.begin(), attempts.end(), [&](const Attempt& a, const Attempt& b) {
    return calibration(a) < calibration(b);
  });
  std::vector<ReferenceCause> causes;
  for (Attempt& a : attempts) {
    const bool as_good = a.left <= attempts.front().left + kAsGood * unit;
    if (as_good && a.cause.explained >= kHalf) causes.push_back(std::move(a.cause));
  }
  return causes;
}

std::vector<ReferenceCause> ExplainKeyPoints(const std::vector<ReferenceRow>& rows) {
  constexpr double kPerKelvin = 0.003;  // of Voc
  const ReferenceRow &light = rows[0], &voltage = rows[1], &leak = rows[3];
  const auto less = [](const ReferenceRow& row) { return row.differs && row.z < 0; };
  std::vector<ReferenceCause> causes;
  const auto add = [&](const char* id, const std::string& sentence, const ReferenceRow& row) {
    causes.push_back(CauseWith(id, sentence, Change(row, row.expected / 100), "%", row.power, 1));
  };
  const double warmer_K = -voltage.power / kPerKelvin;
  const bool leaks = leak.differs && leak.z > 0;
  if (less(voltage) && (less(light) || !leaks)) {
    // The rear of PERC lost 36 % of Isc and 7 % of Voc, the front 5 % of both: Luo et al. 2018,
    // doi:10.1002/pip.3028. Other forms: luo2017, molto2023.
    add("polarisation",
        fmt::format("polarisation of this face (PID-p): Isc {:+.1f} %, and Voc {:+.1f} % beyond "
                    "what that current takes",
                    100 * light.power, 100 * voltage.power),
        less(light) ? light : voltage);
    add("degradation", "degradation of all cells by light and heat (LID, LeTID) or by age",
        less(light) ? light : voltage);
    if (less(light)) {
      add("less_light",
          fmt::format("dirt or less light, on cells {:.0f} K warmer than stated", warmer_K), light);
    } else {
      add("temperature", fmt::format("cells {:.0f} K warmer than stated", warmer_K), voltage);
    }
  } else if (less(light)) {
    add("less_light",
        fmt::format("current per light {:+.2g} %: soiling, a shade on all cells alike, or the "
                    "light's sensor{}",
                    100 * light.power,
                    leaks ? ""
                          : "; the voltage is what that current gives, so that polarisation "
                            "(PID-p) does not show"),
        light);
  }
  if (leaks) {
    // Shunts take voltage before current, polarisation of unlike cells current before voltage.
    const bool first = light.power > voltage.power;
    causes.insert(
        first ? causes.begin() : causes.end(),
        CauseWith(
            "shunt",
            fmt::format(
                "a slope as of a leak that takes {:.2g} % of Isc at Voc, {:.2g} % is expected: "
                "of many cells potential-induced shunting (PID-s), or cells that give unlike "
                "currents",
                leak.now, std::max(leak.expected, 0.0)),
            Change(leak, 1), "% of Isc", rows[2].power, 1));
  }
  return causes;
}

std::string DecidingMeasurement(const std::vector<ReferenceCause>& causes) {
  const auto has = [&](std::string_view id) {
    return std::any_of(causes.begin(), causes.end(),
                       [&](const ReferenceCause& cause) { return cause.id == id; });
  };
  std::string text;
  if (has("polarisation")) {
    text =
        "the other face, which polarisation spares or takes otherwise, and this face after some "
        "days of sun, in which polarisation goes and degradation stays; clean it first";
  }
  if (has("shunt")) {
    text += text.empty() ? "" : "; ";
    text +=
        "a sweep at a fifth of the light, where shunts (PID-s) lose more than in full light; they "
        "heal in the dark at 60 C and above, or by night under the opposite voltage";
  }
  return text;
}

}  // namespace lyrefit
