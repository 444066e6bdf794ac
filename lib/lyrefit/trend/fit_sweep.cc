// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/fit_sweep.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/refine/least_squares.h"

namespace lyrefit {
namespace {

// Positions in the vector that is fitted. Currents of the diodes are those at Voc, over Isc.
enum FittedAt { kFitIph, kFitFirst, kFitSecond, kFitRs, kFitGsh, kFitN, kFitted };

struct SweepData {
  const std::vector<double>& voltage;
  const std::vector<double>& current;
  double thermal_V;
  double isc;
  double voc;
};

// Current through the junction and its slope at a junction voltage.
struct Junction {
  double first;  // currents of the diodes
  double second;
  double current;
  double slope;  // of what the diodes and the shunt take, over voltage
};

Junction AtJunction(const SweepData& data, const double* p, double junction_V) {
  const double a = p[kFitN] * data.thermal_V;
  const double half = std::exp(std::min(0.5 * (junction_V - data.voc) / a, 100.0));
  Junction at{};
  at.first = data.isc * p[kFitFirst] * half * half;
  at.second = data.isc * p[kFitSecond] * half;
  at.current = p[kFitIph] - at.first - at.second - p[kFitGsh] * junction_V;
  at.slope = (at.first + 0.5 * at.second) / a + p[kFitGsh];
  return at;
}

// Newton's method for V = Vd - I Rs from the junction voltage of the measured current on.
double JunctionVoltage(const SweepData& data, const double* p, double voltage, double current) {
  double junction = voltage + current * p[kFitRs];
  constexpr int kSteps = 30;
  for (int step = 0; step < kSteps; ++step) {
    const Junction at = AtJunction(data, p, junction);
    const double miss = junction - voltage - p[kFitRs] * at.current;
    const double change = miss / (1 + p[kFitRs] * at.slope);
    junction -= change;
    if (std::fabs(change) < 1e-12 * data.voc) break;
  }
  return junction;
}

// Currents of the readings less the measured ones, and their derivatives by the implicit equation.
bool EvaluateSweep(const SweepData& data, const double* p, double* residuals, double* jacobian) {
  const double a = p[kFitN] * data.thermal_V;
  for (std::size_t k = 0; k < data.voltage.size(); ++k) {
    const double junction = JunctionVoltage(data, p, data.voltage[k], data.current[k]);
    const Junction at = AtJunction(data, p, junction);
    residuals[k] = at.current - data.current[k];
    if (!std::isfinite(residuals[k])) return false;
    if (jacobian == nullptr) continue;
    const double factor = 1 / (1 + p[kFitRs] * at.slope);
    const double half = std::exp(std::min(0.5 * (junction - data.voc) / a, 100.0));
    double* const row = jacobian + k * kFitted;
    row[kFitIph] = factor;
    row[kFitFirst] = -factor * data.isc * half * half;
    row[kFitSecond] = -factor * data.isc * half;
    row[kFitRs] = -factor * at.current * at.slope;
    row[kFitGsh] = -factor * junction;
    row[kFitN] = factor * (at.first + 0.5 * at.second) * (junction - data.voc) / (a * p[kFitN]);
  }
  return true;
}

}  // namespace

SweepFit FitSweep(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                  double thermal_V, double n, SweepFree free) {
  SweepFit out;
  const KeyPoints key = FindKeyPoints(voltage_V, current_A);
  const double isc = key.short_circuit_current_A, voc = key.open_circuit_voltage_V;
  if (!(isc > 0) || !(voc > 0)) return out;
  const SweepData data = {voltage_V, current_A, thermal_V, isc, voc};
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
