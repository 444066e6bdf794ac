#include "lyrefit/diagnose/reference_rows.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

// Relative change of Pmax of the sweep's single diode against one parameter at its expected value.
// When n changes, the saturation current changes too, so that Voc is kept.
double PowerWith(const FittedSweep& sweep, int quantity, double expected) {
  const SweepState& s = sweep.state;
  Conditions conditions;
  conditions.cells_in_series = s.cells;
  conditions.cell_temperature_K = sweep.weighted.readings->reference_temperature_K;
  const Device device = MakeDevice(Model::kSingleDiode, conditions);
  const double thermal_V = conditions.ModuleThermalVoltage(ConstantSet::kCodata);
  const auto power = [&](double n, double series, double shunt) {
    shunt = std::max(shunt, 1e-15);
    const double saturation =
        SaturationCurrent(s.photocurrent_A - shunt * s.voc_V, s.voc_V, n * thermal_V);
    const double p[] = {s.photocurrent_A, saturation, n, std::max(series, 0.0), 1 / shunt};
    return ModelKeyPoints(device, p).max_power_W;
  };
  const double n = quantity == kJunction ? expected : s.ideality;
  const double series = quantity == kSeries ? expected : s.series_ohm;
  const double shunt = quantity == kShunt ? expected : s.shunt_S;
  return power(s.ideality, s.series_ohm, s.shunt_S) / power(n, series, shunt) - 1;
}

// Conversion of a quantity to its reporting unit.
struct Reader {
  const char* symbol;
  const char* name;
  const char* unit;
  double factor;     // of the quantity
  bool exponential;  // the factor applies to exp(quantity)
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

ReferenceRow RowOf(const FittedSweep& sweep, const Expectation& e, const Difference& d, int j) {
  const Reader reader = ReaderOf(j, sweep.state);
  const double deviation = std::sqrt(e.covariance(j, j) * d.widening);
  const double reach = deviation * StudentQuantile(0.975, e.degrees);
  ReferenceRow row{reader.symbol, reader.name, reader.unit};
  row.now = Read(reader, d.expected[j] + d.value[j]);
  row.expected = Read(reader, d.expected[j]);
  row.low_95 = Read(reader, d.expected[j] - reach);
  row.high_95 = Read(reader, d.expected[j] + reach);
  row.z = d.value[j] / deviation;
  row.corrected_p = std::min(1.0, kQuantities * d.p[j]);
  row.power = j == kShapeOff ? kUnknown
              : j == kFill   ? std::expm1(d.value[j])
                             : PowerWith(sweep, j, std::max(row.expected, 0.0));
  return row;
}

}  // namespace

std::vector<ReferenceRow> DescribeDifference(const FittedSweep& sweep, const Expectation& expected,
                                             const Difference& difference) {
  std::vector<ReferenceRow> rows;
  rows.reserve(kQuantities);
  for (int j = 0; j < kQuantities; ++j) rows.push_back(RowOf(sweep, expected, difference, j));
  return rows;
}

std::vector<ReferenceRow> DescribeLight(const SweepState& now,
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
  ReferenceRow row{"Isc/G", "current per light", "mA m2/W"};
  row.now = 1e3 * now.isc_A / now.irradiance_W_m2;
  row.expected = 1e3 * std::exp(line[0]);
  row.low_95 = row.expected * std::exp(-reach);
  row.high_95 = row.expected * std::exp(reach);
  row.z = difference / deviation;
  row.corrected_p = std::min(1.0, (kQuantities + 1) * FisherTail(row.z * row.z, 1, degrees));
  row.power = std::expm1(difference);
  return {row};
}

}  // namespace lyrefit
