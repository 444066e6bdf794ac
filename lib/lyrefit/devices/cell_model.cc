#include "lyrefit/devices/joint_problem.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lyrefit/base/dual.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr int kMostDeviceParameters = 9;  // three diodes

ModelShape ShapeOf(const CellProblem& problem) {
  ModelShape shape;
  std::vector<int> readings;
  for (const CellBlock& block : problem.blocks) {
    readings.push_back(static_cast<int>(block.voltage_V.size()));
  }
  SetBlocks(readings, &shape);
  shape.current_scale_A = problem.current_scale_A;
  shape.voltage_scale_V = problem.voltage_scale_V;
  shape.thermal_voltage_V = problem.device.module_thermal_voltage_V;
  SetParameters(problem.parameters, problem.lower, problem.upper, &shape);
  return shape;
}

// ln Is of a heated block above that of the others, times n, and its derivative by the temperature.
struct HeatedSaturation {
  double times_n = 0;
  double per_K = 0;
};

HeatedSaturation SaturationAbove(const CellProblem& problem, double kelvin) {
  const double part = 1 + kelvin / problem.temperature_K, gap = problem.gap_over_thermal;
  return {gap * (1 - 1 / part) + 3 * std::log(part),
          (gap / part + 3) / part / problem.temperature_K};
}

// Derivatives of a heated block by Is and n of each diode and by its temperature; `row` has those by
// Is and n of the heated device.
void ChainToWarmth(const CellProblem& problem, const double* p, const std::vector<double>& device,
                   double* row) {
  const double kelvin = p[problem.warmth()];
  const HeatedSaturation above = SaturationAbove(problem, kelvin);
  for (int diode = 0; diode < DiodeCount(problem.device); ++diode) {
    const int at_is = SaturationCurrentIndex(diode), at_n = IdealityIndex(diode);
    const double n = p[at_n - 1], by_log = row[at_is - 1] * device[at_is];
    row[problem.warmth()] += row[at_n - 1] * n / problem.temperature_K + by_log * above.per_K / n;
    row[at_n - 1] =
        row[at_n - 1] * (1 + kelvin / problem.temperature_K) - by_log * above.times_n / (n * n);
    row[at_is - 1] *= std::exp(above.times_n / n);
  }
}

// Derivatives by the problem's parameters from those by the device's. The shunt in the light has the
// conductance 1 / Rsh + c Iph. `by_light`: of the photocurrent by the parameter of the light.
void ChainToProblem(const CellProblem& problem, const double* p, const std::vector<double>& device,
                    const double* by_device, const CellBlock& block, double by_light, double* row) {
  for (int i = 1; i < problem.device.size(); ++i) row[i - 1] = by_device[i];
  if (problem.warmer && block.heated) ChainToWarmth(problem, p, device, row);
  if (block.pseudo) {
    row[kRs - 1] = 0;
    row[block.light] = by_device[kIph];
    return;
  }
  const double by_conductance = -by_device[kRsh] * device[kRsh] * device[kRsh];
  const double shunt = p[kRsh - 1];
  row[kRsh - 1] = -by_conductance / (shunt * shunt);
  row[problem.collection()] = by_conductance * device[kIph];
  if (block.light < 0) return;
  row[block.light] = by_light * (by_device[kIph] + by_conductance * p[problem.collection()]);
}

// Derivatives of the open-circuit voltage by the device's parameters: F(Voc, p) = 0.
void OpenCircuitSlopes(const Device& device, const double* p, double voltage_V, double* slopes) {
  using Number = Dual<kMostDeviceParameters + 1>;
  std::array<Number, kMostDeviceParameters> x;
  for (int i = 0; i < device.size(); ++i) x[i] = Number(p[i], i);
  const Number current =
      JunctionCurrent(device, x.data(), Number(voltage_V, kMostDeviceParameters));
  for (int i = 0; i < device.size(); ++i) {
    slopes[i] = -current.v[i] / current.v[kMostDeviceParameters];
  }
}

}  // namespace

std::vector<double> DeviceUnderLight(const CellProblem& problem, const double* p,
                                     double photocurrent_A, bool heated) {
  std::vector<double> device(problem.device.size());
  device[kIph] = photocurrent_A;
  std::copy_n(p, problem.device.size() - 1, device.begin() + 1);
  device[kRsh] = 1 / (1 / p[kRsh - 1] + p[problem.collection()] * photocurrent_A);
  if (!problem.warmer || !heated) return device;
  const double kelvin = p[problem.warmth()], above = SaturationAbove(problem, kelvin).times_n;
  for (int diode = 0; diode < DiodeCount(problem.device); ++diode) {
    double& n = device[IdealityIndex(diode)];
    device[SaturationCurrentIndex(diode)] *= std::exp(above / n);
    n *= 1 + kelvin / problem.temperature_K;
  }
  return device;
}

CellModel::CellModel(const CellProblem& problem) : FitModel(ShapeOf(problem)), problem_(problem) {
  CHECK_LE(problem.device.size(), kMostDeviceParameters);
  CHECK(problem.device.effects == nullptr);
  for (const CellBlock& block : problem.blocks) {
    points_.push_back(block.open_circuit ? PointSet()
                                         : MakePointSet(block.voltage_V, block.current_A));
  }
}

// The currents with those of the part of the area that is behind a resistance of its own, likewise
// their derivatives by the device; `slopes`, if not null, receives those by share and resistance.
void CellModel::AddContacts(int block, const double* p, std::vector<double> device, double* current,
                            RowMatrix* by_device, double* slopes) const {
  const double share = p[problem_.contact_share()];
  device[kRs] = p[problem_.contact_resistance()];
  std::vector<double> far(problem_.blocks[block].voltage_V.size());
  RowMatrix by_far(by_device->rows(), by_device->cols());
  ModelCurrents(problem_.device, Objective::kSolvedCurrent, device.data(), points_[block],
                FastestKernel(), far.data(), slopes != nullptr ? by_far.data() : nullptr);
  for (std::size_t k = 0; k < far.size(); ++k) {
    const double more = far[k] - current[k];
    current[k] += share * more;
    if (slopes == nullptr) continue;
    const auto row = static_cast<Eigen::Index>(k);
    double* const own = slopes + row * shape().size();
    own[problem_.contact_share()] = more;
    own[problem_.contact_resistance()] = share * by_far(row, kRs);
    by_far(row, kRs) = 0;
    by_device->row(row) = (1 - share) * by_device->row(row) + share * by_far.row(row);
  }
}

bool CellModel::EvaluateCurve(int block, const double* p, double* residuals, double* slopes) const {
  const CellBlock& curve = problem_.blocks[block];
  const int size = shape().size(), points = static_cast<int>(curve.voltage_V.size());
  std::vector<double> device =
      DeviceUnderLight(problem_, p, curve.light < 0 ? 0 : p[curve.light], curve.heated);
  if (curve.pseudo) {
    device[kRs] = 0;
    device[kRsh] = p[kRsh - 1];
  }
  const int parameters = problem_.device.size();
  RowMatrix by_device(slopes != nullptr ? points : 0, parameters);
  ModelCurrents(problem_.device, Objective::kSolvedCurrent, device.data(), points_[block],
                FastestKernel(), residuals, slopes != nullptr ? by_device.data() : nullptr);
  if (problem_.contacts && !curve.pseudo)
    AddContacts(block, p, device, residuals, &by_device, slopes);
  const double scale = problem_.error_A / curve.error;
  for (int k = 0; k < points; ++k) {
    residuals[k] = scale * (residuals[k] - curve.current_A[k]);
    if (!std::isfinite(residuals[k])) return false;
    if (slopes == nullptr) continue;
    double* const row = slopes + static_cast<std::ptrdiff_t>(k) * size;
    by_device.row(k) *= scale;
    for (int i = problem_.contact_share(); i < problem_.first_light(); ++i) row[i] *= scale;
    ChainToProblem(problem_, p, device, by_device.row(k).data(), curve, 1, row);
  }
  return true;
}

bool CellModel::EvaluateOpenCircuit(const CellBlock& block, const double* p, double* residuals,
                                    double* slopes) const {
  const double scale = problem_.error_A / block.error;
  std::array<double, kMostDeviceParameters> by_device;
  for (std::size_t k = 0; k < block.voltage_V.size(); ++k) {
    const std::vector<double> device =
        DeviceUnderLight(problem_, p, block.current_A[k] * p[block.light], block.heated);
    const double voltage_V = ModelOpenCircuit(problem_.device, device.data());
    residuals[k] = scale * (voltage_V - block.voltage_V[k]);
    if (!std::isfinite(residuals[k])) return false;
    if (slopes == nullptr) continue;
    OpenCircuitSlopes(problem_.device, device.data(), voltage_V, by_device.data());
    for (double& slope : by_device) slope *= scale;
    ChainToProblem(problem_, p, device, by_device.data(), block, block.current_A[k],
                   slopes + static_cast<std::ptrdiff_t>(k) * shape().size());
  }
  return true;
}

bool CellModel::Evaluate(int block, const double* p, const double* /*local*/, double* residuals,
                         double* slopes, double* /*local_slopes*/) const {
  const CellBlock& measured = problem_.blocks[block];
  if (slopes != nullptr) {
    std::fill_n(slopes,
                static_cast<std::ptrdiff_t>(shape().size()) * shape().blocks[block].residuals, 0.0);
  }
  return measured.open_circuit ? EvaluateOpenCircuit(measured, p, residuals, slopes)
                               : EvaluateCurve(block, p, residuals, slopes);
}

}  // namespace lyrefit
