#include "lyrefit/diagnose/reference_parts.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
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

namespace {

// Usual standard deviations between sweeps of one module, relative; of the leak in parts of Isc at Voc.
struct Scatter {
  double light, voltage, fill, leak;
};

// Of flashers, of repeated tests of one module (IEC 60904-9, class A: the light holds to 0.5 to 2 %); of
// the field, of sensors of light (3 %) and temperature (3 K).
Scatter ScatterOf(Setup setup) {
  const bool indoors = setup == Setup::kFlash || setup == Setup::kLaboratory;
  return indoors ? Scatter{0.005, 0.002, 0.005, 0.01} : Scatter{0.03, 0.01, 0.01, 0.02};
}

// A row of `now` against the mean of `expected`, of a quantity with a standard deviation.
ReferenceRow RowAgainst(ReferenceRow row, double now, const std::vector<double>& expected,
                        double deviation) {
  const auto count = static_cast<double>(expected.size());
  row.now = now;
  for (const double value : expected) row.expected += value / count;
  deviation *= std::sqrt(1 + 1 / count);
  row.low_95 = row.expected - kNormal95 * deviation;
  row.high_95 = row.expected + kNormal95 * deviation;
  row.z = (row.now - row.expected) / deviation;
  row.corrected_p = std::min(1.0, 4 * std::erfc(std::fabs(row.z) / std::sqrt(2.0)));
  return row;
}

// Voc of a reference with the current and the temperature of this sweep: n Vt ln(Isc) and what is usual
// of a cell's temperature, 0.3 %/K.
double VoltageAt(const SweepState& reference, const SweepState& now) {
  constexpr double kPerKelvin = -0.003;
  const double thermal_V =
      reference.cells * ThermalVoltage(reference.temperature_C + kZeroCelsius_K);
  const double n = std::clamp(reference.ideality, 1.0, 2.0);
  return reference.voc_V * (1 + kPerKelvin * (now.temperature_C - reference.temperature_C)) +
         n * thermal_V * std::log(now.isc_A / reference.isc_A);
}

}  // namespace

std::vector<ReferenceRow> DescribeKeyPoints(const SweepState& now,
                                            const std::vector<const SweepState*>& references) {
  constexpr double kAlike = 1.2;
  const auto known = [](const SweepState& s) {
    return std::isfinite(s.irradiance_W_m2) && std::isfinite(s.temperature_C);
  };
  std::vector<double> light, voltage, fill, leak;
  if (!known(now) || references.empty()) return {};
  for (const SweepState* r : references) {
    const double ratio = now.irradiance_W_m2 / r->irradiance_W_m2;
    if (!known(*r) || ratio > kAlike || ratio * kAlike < 1) return {};
    light.push_back(1e3 * r->isc_A / r->irradiance_W_m2);
    voltage.push_back(VoltageAt(*r, now));
    fill.push_back(100 * r->fill_factor);
    leak.push_back(100 * r->shunt_S * r->voc_V / r->isc_A);
  }
  const Scatter scatter = ScatterOf(now.setup);
  std::vector<ReferenceRow> rows = {
      RowAgainst({"Isc/G", "current per light", "mA m2/W"}, 1e3 * now.isc_A / now.irradiance_W_m2,
                 light, scatter.light * light.front()),
      RowAgainst({"Voc", "open-circuit voltage at this current", "V"}, now.voc_V, voltage,
                 scatter.voltage * voltage.front()),
      RowAgainst({"FF", "fill factor", "%"}, 100 * now.fill_factor, fill,
                 scatter.fill * fill.front()),
      RowAgainst({"leak", "leak at Voc", "% of Isc"}, 100 * now.shunt_S * now.voc_V / now.isc_A,
                 leak, 100 * scatter.leak)};
  for (ReferenceRow& row : rows) row.power = row.now / row.expected - 1;
  rows.back().power = kUnknown;
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
