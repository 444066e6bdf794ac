// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/fit_sweep.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/refine/least_squares.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {
namespace {

// Positions in the vector that is fitted. Currents of the diodes are those at Voc, over Isc.
enum FittedAt { kFitIph, kFitFirst, kFitSecond, kFitRs, kFitGsh, kFitN, kFitted };

struct SweepData {
  PointSet points;
  double thermal_V;
  double isc;
  double voc;
};

// Currents of the readings less the measured ones, and their derivatives by the implicit equation.
// Newton's method for I = F(V + I Rs), of all readings at once and from the measured currents on.
bool EvaluateSweep(const SweepData& data, const double* p, double* residuals, double* jacobian) {
  constexpr int kSteps = 30;
  const double rs = p[kFitRs], a = p[kFitN] * data.thermal_V;
  // Saturation currents of diodes that carry Isc at Voc.
  const double unit[] = {data.isc * std::exp(-data.voc / a),
                         data.isc * std::exp(-0.5 * data.voc / a)};
  const PreparedDevice device =
      TwoDiodes(p[kFitIph], p[kFitGsh], p[kFitFirst] * unit[0], p[kFitSecond] * unit[1], a);
  const std::size_t length = data.points.voltage_V.size();
  const auto size = static_cast<std::size_t>(data.points.size);
  Block* const current = ScratchBlocks((3 + 2 * device.count) * length);
  std::copy(data.points.current_A.begin(), data.points.current_A.end(), current);
  double* const solved = current->lane;
  const double* const rows = NumbersOf(current + length);
  const auto row = [&](int r) { return rows + r * length * Block::kLanes; };
  const double* const slope = row(1);
  for (int step = 0; step < kSteps; ++step) {
    FastestKernel().explicit_currents(device.terms, device.count, rs, data.points, current,
                                      current + length);
    double most = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const double change = (rows[k] - solved[k]) / (1 - rs * slope[k]);
      solved[k] += change;
      most = std::max(most, std::fabs(change));
    }
    if (!(rs * most > 1e-12 * data.voc)) break;
  }
  const double* const measured = NumbersOf(data.points.current_A.data());
  for (std::size_t k = 0; k < size; ++k) {
    residuals[k] = solved[k] - measured[k];
    if (!std::isfinite(residuals[k])) return false;
    if (jacobian == nullptr) continue;
    const double factor = 1 / (1 - rs * slope[k]);
    double* const to = jacobian + k * kFitted;
    to[kFitIph] = factor;
    to[kFitRs] = factor * solved[k] * slope[k];
    to[kFitGsh] = factor * row(4)[k];
    to[kFitN] = 0;
    for (int d = 0; d < 2; ++d) {
      const PreparedTerm<double>& diode = device.terms[2 + d];
      const double by_saturation = row(6 + 2 * d)[k] - 1;  // with that of the light
      to[kFitFirst + d] = factor * by_saturation * unit[d];
      to[kFitN] +=
          factor * (by_saturation * diode.a * data.voc - row(7 + 2 * d)[k]) * diode.b / p[kFitN];
    }
  }
  return true;
}

}  // namespace

PreparedDevice TwoDiodes(double light_A, double conductance_S, double first_A, double second_A,
                         double nNsVth) {
  PreparedDevice device;
  device.count = 4;
  device.terms[0] = {TermKind::kPhotocurrent, light_A - first_A - second_A, 0};
  device.terms[1] = {TermKind::kShunt, conductance_S, 0};
  device.terms[2] = {TermKind::kDiode, first_A, 1 / nNsVth};
  device.terms[3] = {TermKind::kDiode, second_A, 0.5 / nNsVth};
  return device;
}

SweepFit FitSweep(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                  double thermal_V, double n, SweepFree free) {
  SweepFit out;
  const KeyPoints key = FindKeyPoints(voltage_V, current_A);
  const double isc = key.short_circuit_current_A, voc = key.open_circuit_voltage_V;
  if (!(isc > 0) || !(voc > 0)) return out;
  const SweepData data = {MakePointSet(voltage_V, current_A), thermal_V, isc, voc};
  const double scale = voc / isc;
  const bool single = free == SweepFree::kIdeality;
  LeastSquaresProblem problem;
  problem.residuals = static_cast<int>(voltage_V.size());
  problem.lower = {0, 0, -0.5, 0, -0.05 / scale, 0.3};
  problem.upper = {3 * isc, 10, 10, scale, 10 / scale, 6};
  problem.fixed = {0, 0, static_cast<char>(single), 0, 0, static_cast<char>(!single)};
  problem.evaluate = [&](const double* p, double* residuals, double* jacobian) {
    return EvaluateSweep(data, p, residuals, jacobian);
  };
  const LeastSquaresEnd end = SolveLeastSquares(
      problem, {isc, single ? 0.9 : 0.7, single ? 0 : 0.2, 0.02 * scale, 1e-3 / scale, n},
      UpTo(60, 1e-10));
  if (!end.usable) return out;
  out.photocurrent_A = end.p[kFitIph];
  out.resistance_series_ohm = end.p[kFitRs];
  out.shunt_conductance_S = end.p[kFitGsh];
  out.n = end.p[kFitN];
  out.open_circuit_V = voc;
  out.diode_A = isc * end.p[kFitFirst];
  out.diode_2_A = isc * end.p[kFitSecond];
  out.rms_A = std::sqrt(end.sum_of_squares / static_cast<double>(voltage_V.size()));
  out.usable = true;
  return out;
}

}  // namespace lyrefit
