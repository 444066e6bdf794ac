#include "lyrefit/diagnose/healthy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/diagnose/expectation.h"
#include "lyrefit/diagnose/healthy_causes.h"
#include "lyrefit/law/model_points.h"

namespace lyrefit {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<Expected<FittedSweep>> FitAll(const std::vector<IvCurve>& curves, int threads) {
  std::vector<Expected<FittedSweep>> fits(curves.size());
  ParallelFor(static_cast<int>(curves.size()), threads,
              [&](int i) { fits[i] = FitSweep(curves[i]); });
  return fits;
}

// Pmax of the sweep's own device with one parameter as expected, against now. The diode keeps the
// open-circuit voltage when n changes.
double PowerWith(const FittedSweep& sweep, int quantity, double expected) {
  const SweepState& s = sweep.state;
  Conditions conditions;
  conditions.cells_in_series = s.cells;
  conditions.cell_temperature_K = sweep.measurement->readings.reference_temperature_K;
  const Device device = MakeDevice(Model::kSingleDiode, conditions);
  const double thermal_V = conditions.ModuleThermalVoltage(ConstantSet::kCodata);
  const auto power = [&](double n, double series, double shunt) {
    shunt = std::max(shunt, 1e-15);
    const double saturation =
        (s.photocurrent_A - shunt * s.voc_V) / std::expm1(s.voc_V / (n * thermal_V));
    const double p[] = {s.photocurrent_A, saturation, n, std::max(series, 0.0), 1 / shunt};
    return ModelKeyPoints(device, p).max_power_W;
  };
  const double n = quantity == kJunction ? expected : s.ideality;
  const double series = quantity == kSeries ? expected : s.series_ohm;
  const double shunt = quantity == kShunt ? expected : s.shunt_S;
  return power(s.ideality, s.series_ohm, s.shunt_S) / power(n, series, shunt) - 1;
}

// A quantity in the unit a person reads.
struct Reader {
  const char* symbol;
  const char* name;
  const char* unit;
  double factor;     // of the quantity,
  bool exponential;  // or of its exponential
};

Reader ReaderOf(int quantity, const SweepState& s) {
  const double ohm = s.voc_V / s.isc_A;
  switch (quantity) {
    case kFill:
      return {"FF", "fill factor", "%", 100, true};
    case kSeries:
      return {"Rs", "series resistance", "ohm", ohm, false};
    case kJunction:
      return {"n", "ideality factor", "", 1, false};
    case kShunt:
      return {"Gsh", "shunt conductance", "S", 1 / ohm, false};
    default:
      return {"shape", "departure from the usual shape", "% of Isc", 100, true};
  }
}

double Read(const Reader& reader, double quantity) {
  return reader.factor * (reader.exponential ? std::exp(quantity) : quantity);
}

HealthyRow RowOf(const FittedSweep& sweep, const Expectation& e, const Difference& d, int j) {
  const Reader reader = ReaderOf(j, sweep.state);
  const double deviation = std::sqrt(e.covariance(j, j) * d.widening);
  const double reach = deviation * StudentQuantile(0.975, e.degrees);
  HealthyRow row{reader.symbol, reader.name, reader.unit};
  row.now = Read(reader, d.expected[j] + d.value[j]);
  row.expected = Read(reader, d.expected[j]);
  row.low_95 = Read(reader, d.expected[j] - reach);
  row.high_95 = Read(reader, d.expected[j] + reach);
  row.z = d.value[j] / deviation;
  row.corrected_p = std::min(1.0, kQuantities * d.p[j]);
  row.power = j == kShapeOff ? kNone
              : j == kFill   ? std::expm1(d.value[j])
                             : PowerWith(sweep, j, std::max(row.expected, 0.0));
  return row;
}

// Isc per light, where the light of all is known: by the sensor, whose own scatter is in the
// references too. With the temperatures of enough sweeps it follows them.
std::vector<HealthyRow> LightRow(const SweepState& now,
                                 const std::vector<const SweepState*>& references) {
  const int count = static_cast<int>(references.size());
  bool temperatures = std::isfinite(now.temperature_C) && count >= 8;
  Eigen::MatrixXd x = Eigen::MatrixXd::Ones(count, 2), y(count, 1);
  for (int i = 0; i < count; ++i) {
    const SweepState& r = *references[i];
    if (!std::isfinite(r.irradiance_W_m2)) return {};
    y(i, 0) = std::log(r.isc_A / r.irradiance_W_m2);
    x(i, 1) = r.temperature_C - now.temperature_C;
    temperatures = temperatures && std::isfinite(r.temperature_C);
  }
  if (!std::isfinite(now.irradiance_W_m2)) return {};
  if (!temperatures) x.conservativeResize(count, 1);
  const Eigen::VectorXd line = LeastSquares(x, Eigen::VectorXd(y.col(0)));
  const Eigen::VectorXd off = y.col(0) - Times(x, line);
  const int degrees = count - static_cast<int>(x.cols());
  const Eigen::VectorXd here = Eigen::VectorXd::Unit(x.cols(), 0);
  const double leverage = here.dot(SolveSymmetric(TransposedTimes(x, x), here));
  const double deviation = std::sqrt(off.squaredNorm() / degrees * (1 + leverage) + 1e-14);
  const double difference = std::log(now.isc_A / now.irradiance_W_m2) - line[0];
  const double reach = deviation * StudentQuantile(0.975, degrees);
  HealthyRow row{"Isc/G", "current per light", "mA m2/W"};
  row.now = 1e3 * now.isc_A / now.irradiance_W_m2;
  row.expected = 1e3 * std::exp(line[0]);
  row.low_95 = row.expected * std::exp(-reach);
  row.high_95 = row.expected * std::exp(reach);
  row.z = difference / deviation;
  row.corrected_p = std::min(1.0, (kQuantities + 1) * FisherTail(row.z * row.z, 1, degrees));
  row.power = std::expm1(difference);
  return {row};
}

// What the references miss at u alike: the median, where at least half of them have readings.
double CommonAt(const std::vector<const SweepState*>& references, double u) {
  std::vector<double> values;
  for (const SweepState* r : references) {
    const std::vector<double>& place = r->place;
    const auto above = std::lower_bound(place.begin(), place.end(), u);
    if (above == place.end() || (above == place.begin() && *above > u)) continue;
    const std::size_t k = above - place.begin();
    const double step = k > 0 ? place[k] - place[k - 1] : 0;
    const double part = step > 0 ? (u - place[k - 1]) / step : 1;
    values.push_back(k > 0 ? r->off[k - 1] + part * (r->off[k] - r->off[k - 1]) : r->off[0]);
  }
  if (2 * values.size() < references.size() || values.empty()) return 0;
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

void TakeCommonOff(const IvCurve& curve, const SweepState& state,
                   const std::vector<const SweepState*>& references, HealthyComparison* result) {
  result->without_common = curve;
  double squares = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double common = CommonAt(references, curve.voltage_V[k] / state.voc_V);
    result->without_common.current_A[k] -= common * state.isc_A;
    squares += common * common;
  }
  result->common = std::sqrt(squares / static_cast<double>(curve.size()));
  result->without_common.assumptions.push_back(fmt::format(
      "what the single diodes of {} healthy sweeps miss alike ({:.2g} % of Isc) is taken off the "
      "readings",
      references.size(), 100 * result->common));
}

std::string LightSentence(const HealthyRow& row) {
  const double percent = 100 * row.power;
  return fmt::format("current per light {:+.2g} %: {}", percent,
                     percent < 0 ? "soiling, a shade on all cells alike, or the light's sensor"
                                 : "the light's sensor, or healthy sweeps that were soiled");
}

std::string SentenceOf(const HealthyComparison& c, bool light) {
  const std::string whom = fmt::format("{} healthy sweeps", c.references.size());
  if (!c.differs) {
    return fmt::format(
        "Like its {} (p = {:.2g}): the fill factor is as expected, {:.2f} % "
        "against {:.2f} %.",
        whom, c.p_value, c.rows.front().now, c.rows.front().expected);
  }
  std::string text = fmt::format("Unlike its {} (p = {:.1g}): ", whom, c.p_value);
  for (std::size_t i = 0; i < c.causes.size(); ++i) {
    text += (i > 0 ? "; or " : "") + c.causes[i].sentence;
  }
  if (light) text += (c.causes.empty() ? "" : "; and ") + LightSentence(c.rows.back());
  if (c.causes.empty() && !light) {
    text += "nothing that is known here makes this difference; see the table";
  }
  return text + ".";
}

void NameSweeps(const std::vector<const SweepState*>& references, const Expectation& e,
                HealthyComparison* result) {
  for (const int i : e.used) result->references.push_back(references[i]->name);
  for (const int i : e.odd) {
    result->left_out.push_back(references[i]->name + ": unlike the other healthy sweeps");
  }
  static const char* const kRegressors[] = {"Isc", "Voc"};
  for (int k = 1; k < e.regressors; ++k) result->regressed_on.push_back(kRegressors[k - 1]);
  const std::size_t far = references.size() - e.used.size() - e.odd.size();
  if (far > 0) {
    result->left_out.push_back(fmt::format("{} more: the nearest in Isc and Voc were taken", far));
  }
  if (e.degrees < 2 * kQuantities) {
    result->warnings.push_back(
        fmt::format("{} healthy sweeps show only large differences: with 15 and more all "
                    "parameters are judged together",
                    e.used.size()));
  }
}

// `looks`: how many sweeps are compared alike.
HealthyComparison Compare(const FittedSweep& sweep,
                          const std::vector<const SweepState*>& references, double level,
                          int looks) {
  const Expectation e = Expect(references, sweep.state);
  const Difference d = Differ(e, sweep.state);
  HealthyComparison result;
  result.name = sweep.state.name;
  NameSweeps(references, e, &result);
  for (int j = 0; j < kQuantities; ++j) result.rows.push_back(RowOf(sweep, e, d, j));
  std::vector<const SweepState*> used;
  for (const int i : e.used) used.push_back(references[i]);
  const std::vector<HealthyRow> light = LightRow(sweep.state, used);
  result.rows.insert(result.rows.end(), light.begin(), light.end());
  for (HealthyRow& row : result.rows) row.differs = row.corrected_p * looks < level;
  const bool by_light = !light.empty() && result.rows.back().differs;
  const double light_p = light.empty() ? 1 : light.front().corrected_p;
  result.p_value = std::min(1.0, looks * std::min(d.p_value, light_p));
  result.differs = result.p_value < level;
  if (looks * d.p_value < level) result.causes = ExplainDifference(sweep, e, d);
  result.sentence = SentenceOf(result, by_light);
  return result;
}

// Whether the references reach the sweep's Isc and Voc.
Expected<void> CheckReach(const SweepState& sweep,
                          const std::vector<const SweepState*>& references) {
  constexpr double kReach = 1.2;
  const auto check = [&](double SweepState::*field, const char* what,
                         const char* unit) -> Expected<void> {
    double low = references.front()->*field, high = low;
    for (const SweepState* r : references) {
      low = std::min(low, r->*field);
      high = std::max(high, r->*field);
    }
    const double value = sweep.*field;
    if (value <= kReach * high && value * kReach >= low) return {};
    return Fail(
        fmt::format("{}: {} {:.4g} {} is more than 20 % beyond the healthy sweeps' {:.4g} "
                    "to {:.4g} {}; compare it with sweeps under like light",
                    sweep.name, what, value, unit, low, high, unit));
  };
  if (auto isc = check(&SweepState::isc_A, "Isc", "A"); !isc) return isc;
  return check(&SweepState::voc_V, "Voc", "V");
}

Expected<void> CheckOptions(const HealthyOptions& options) {
  if (auto valid = ValidateOptions(options, kHealthyOptionRows); !valid) return valid;
  return ValidateThreads(options.threads);
}

}  // namespace

Expected<HealthyComparison> CompareWithHealthy(const IvCurve& curve,
                                               const std::vector<IvCurve>& healthy,
                                               const HealthyOptions& options) {
  if (auto valid = CheckOptions(options); !valid) return tl::unexpected(valid.error());
  auto sweep = FitSweep(curve);
  if (!sweep) return tl::unexpected(sweep.error());
  const auto fits = FitAll(healthy, options.threads);
  std::vector<const SweepState*> references;
  std::vector<std::string> left_out;
  for (const auto& fit : fits) {
    if (!fit) {
      left_out.push_back(fit.error().message);
    } else if (fit->state.cells != sweep->state.cells) {
      return Fail(
          fmt::format("{} has {} cells in series, the healthy sweep {} has {}: compare "
                      "sweeps of one module or of its like",
                      curve.name, sweep->state.cells, fit->state.name, fit->state.cells));
    } else {
      references.push_back(&fit->state);
    }
  }
  if (references.size() < kFewestReferences) {
    return Fail(fmt::format("{} healthy sweeps can be used, a comparison needs {} or more{}",
                            references.size(), kFewestReferences,
                            left_out.empty() ? "" : " (" + left_out.front() + ")"));
  }
  if (auto near = CheckReach(sweep->state, references); !near) {
    return tl::unexpected(near.error());
  }
  HealthyComparison result = Compare(*sweep, references, options.level, 1);
  result.left_out.insert(result.left_out.begin(), left_out.begin(), left_out.end());
  std::vector<const SweepState*> used;
  for (const SweepState* r : references) {
    const auto& names = result.references;
    if (std::find(names.begin(), names.end(), r->name) != names.end()) used.push_back(r);
  }
  TakeCommonOff(curve, sweep->state, used, &result);
  return result;
}

Expected<OddSweeps> FindOddSweeps(const std::vector<IvCurve>& curves,
                                  const HealthyOptions& options) {
  if (auto valid = CheckOptions(options); !valid) return tl::unexpected(valid.error());
  const auto fits = FitAll(curves, options.threads);
  OddSweeps result;
  std::vector<const FittedSweep*> sweeps;
  for (const auto& fit : fits) {
    if (!fit) {
      result.rejected.push_back(fit.error().message);
    } else if (!sweeps.empty() && fit->state.cells != sweeps.front()->state.cells) {
      return Fail(
          fmt::format("{} has {} cells in series, {} has {}: these are not sweeps of one "
                      "module",
                      fit->state.name, fit->state.cells, sweeps.front()->state.name,
                      sweeps.front()->state.cells));
    } else {
      sweeps.push_back(&*fit);
    }
  }
  const int count = static_cast<int>(sweeps.size());
  if (count <= kFewestReferences) {
    return Fail(fmt::format("{} sweeps can be compared with each other, that takes {} or more",
                            count, kFewestReferences + 1));
  }
  // Those that look odd by themselves are nobody's reference the second time.
  std::vector<char> odd(count, 0);
  std::vector<HealthyComparison> found(count);
  std::vector<char> compared(count, 0);
  for (const bool last : {false, true}) {
    std::vector<char> now(count, 0);
    ParallelFor(count, options.threads, [&](int i) {
      std::vector<const SweepState*> others;
      for (int k = 0; k < count; ++k) {
        if (k != i && odd[k] == 0) others.push_back(&sweeps[k]->state);
      }
      if (others.size() < kFewestReferences || !CheckReach(sweeps[i]->state, others)) return;
      compared[i] = 1;
      if (last) {
        found[i] = Compare(*sweeps[i], others, options.level, count);
      } else {
        const SweepState& state = sweeps[i]->state;
        now[i] = Differ(Expect(others, state), state).p_value < options.level ? 1 : 0;
      }
    });
    odd = now;
  }
  for (int i = 0; i < count; ++i) {
    if (compared[i] == 0) {
      result.rejected.push_back(sweeps[i]->state.name + ": no other sweeps under like light");
      continue;
    }
    result.odd += found[i].differs ? 1 : 0;
    result.sweeps.push_back(std::move(found[i]));
  }
  std::stable_sort(result.sweeps.begin(), result.sweeps.end(),
                   [](const auto& a, const auto& b) { return a.p_value < b.p_value; });
  return result;
}

}  // namespace lyrefit
