#include "faults/base_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "faults/cell.h"

namespace faults {
namespace {

constexpr int kSize = 5;
using Five = std::array<double, kSize>;
enum { kPhoto, kLogDiode, kIdeality, kResistance, kConductance };

struct Data {
  const Plan& plan;
  const std::vector<double>& currents;
  const std::vector<double>& sigmas;
  Device fixed;  // cells, band gap and temperature coefficient, which are not fitted
  double pivot;  // V, where the diode current is a parameter
};

Device DeviceOf(const Five& p, const Data& data) {
  Device device = data.fixed;
  device.photocurrent = p[kPhoto];
  device.ideality = p[kIdeality];
  device.saturation = std::exp(p[kLogDiode]) /
                      std::expm1(data.pivot / (p[kIdeality] * kBoltzmannOverCharge * kReferenceK));
  device.resistance = p[kResistance];
  device.conductance = p[kConductance];
  return device;
}

struct Linear {  // residuals and their derivatives, in noise standard deviations
  double chi2 = 0;
  std::vector<double> residuals;
  std::vector<Five> slopes;
};

double JunctionAt(const Five& p, const Data& data, const Setting& at, double v) {
  return JunctionCurrent(CellUnder(DeviceOf(p, data), {}, at.suns, at.kelvin), v);
}

// Derivatives of the solved current, by differences of the junction equation.
Five SlopesAt(const Five& p, const Data& data, const Setting& at, double v, double current) {
  const double by_v =
      (JunctionAt(p, data, at, v + 1e-6) - JunctionAt(p, data, at, v - 1e-6)) / 2e-6;
  const double relief = 1 / (1 - by_v * p[kResistance]);
  Five slopes;
  for (int k = 0; k < kSize; ++k) {
    if (k == kResistance) {
      slopes[k] = by_v * current * relief;
      continue;
    }
    const double step =
        1e-6 * std::max(std::fabs(p[k]), k == kConductance ? 0.01 * p[kPhoto] : 1e-9);
    Five up = p, down = p;
    up[k] += step;
    down[k] -= step;
    slopes[k] = (JunctionAt(up, data, at, v) - JunctionAt(down, data, at, v)) / (2 * step) * relief;
  }
  return slopes;
}

Linear Linearised(const Five& p, const Data& data, bool slopes) {
  Linear linear;
  const Device device = DeviceOf(p, data);
  for (std::size_t i = 0; i < data.currents.size(); ++i) {
    const Setting& at = data.plan.settings[i];
    const Cell cell = CellUnder(device, {}, at.suns, at.kelvin);
    const double v = JunctionAtVoltage(cell, at.voltage / device.cells);
    const double current = JunctionCurrent(cell, v);
    const double weight = 1 / data.sigmas[i];
    linear.residuals.push_back((current - data.currents[i]) * weight);
    linear.chi2 += linear.residuals.back() * linear.residuals.back();
    if (!slopes) continue;
    linear.slopes.push_back(SlopesAt(p, data, at, v, current));
    for (double& slope : linear.slopes.back()) slope *= weight;
  }
  return linear;
}

// Step of the damped normal equations over the free parameters, by Gaussian elimination with
// columns scaled to 1.
Five StepOf(const Linear& linear, const std::array<bool, kSize>& held, double damping) {
  double a[kSize][kSize + 1] = {};
  for (std::size_t i = 0; i < linear.residuals.size(); ++i) {
    for (int r = 0; r < kSize; ++r) {
      for (int c = 0; c < kSize; ++c) a[r][c] += linear.slopes[i][r] * linear.slopes[i][c];
      a[r][kSize] -= linear.slopes[i][r] * linear.residuals[i];
    }
  }
  Five scale;
  for (int k = 0; k < kSize; ++k) scale[k] = a[k][k] > 0 ? 1 / std::sqrt(a[k][k]) : 1;
  for (int r = 0; r < kSize; ++r) {
    for (int c = 0; c < kSize; ++c) a[r][c] *= scale[r] * scale[c] * !(held[r] || held[c]);
    a[r][kSize] *= scale[r] * !held[r];
    a[r][r] = 1 + damping;
  }
  for (int k = 0; k < kSize; ++k) {
    for (int r = k + 1; r < kSize; ++r) {
      const double factor = a[r][k] / a[k][k];
      for (int c = k; c <= kSize; ++c) a[r][c] -= factor * a[k][c];
    }
  }
  Five step;
  for (int k = kSize - 1; k >= 0; --k) {
    double rest = a[k][kSize];
    for (int c = k + 1; c < kSize; ++c) rest -= a[k][c] * step[c];
    step[k] = rest / a[k][k];
  }
  for (int k = 0; k < kSize; ++k) step[k] *= scale[k];
  return step;
}

std::array<bool, kSize> Held(const Five& p, const Linear& linear) {
  std::array<bool, kSize> held = {};
  for (const int k : {kResistance, kConductance}) {
    double slope = 0;
    for (std::size_t i = 0; i < linear.residuals.size(); ++i) {
      slope += linear.slopes[i][k] * linear.residuals[i];
    }
    held[k] = p[k] <= 0 && slope > 0;
  }
  return held;
}

Five Moved(const Five& p, const Five& step) {
  Five to = p;
  for (int k = 0; k < kSize; ++k) to[k] += step[k];
  to[kLogDiode] = std::clamp(to[kLogDiode], p[kLogDiode] - 2, p[kLogDiode] + 2);
  to[kIdeality] = std::clamp(to[kIdeality], 0.2, 6.0);
  to[kResistance] = std::max(to[kResistance], 0.0);
  to[kConductance] = std::max(to[kConductance], 0.0);
  return to;
}

}  // namespace

double BaseFit::Misfit() const { return std::sqrt(chi2); }

BaseFit FitBase(const Device& start, const Plan& plan, const std::vector<double>& currents,
                const std::vector<double>& sigmas) {
  Data data{plan, currents, sigmas, start, 0.95 * start.open_circuit};
  data.fixed.saturation_2 = 0;
  const double n_vt = start.ideality * kBoltzmannOverCharge * kReferenceK;
  Five p = {start.photocurrent, std::log(start.saturation * std::expm1(data.pivot / n_vt)),
            start.ideality, start.resistance, start.conductance};
  Linear linear = Linearised(p, data, true);
  double damping = 1e-4;
  for (int i = 0; i < 200 && damping < 1e12 && linear.chi2 > 1e-14; ++i) {
    const Five to = Moved(p, StepOf(linear, Held(p, linear), damping));
    const double chi2 = Linearised(to, data, false).chi2;
    if (!(chi2 < linear.chi2)) {
      damping *= 8;
      continue;
    }
    const double gain = linear.chi2 - chi2;
    p = to;
    linear = Linearised(p, data, true);
    damping = std::max(damping / 10, 1e-13);
    if (gain < 1e-9 * chi2 + 1e-13) break;
  }
  BaseFit fit;
  fit.device = DeviceOf(p, data);
  fit.chi2 = linear.chi2;
  for (std::size_t i = 0; i < currents.size(); ++i) {
    fit.currents.push_back(currents[i] + linear.residuals[i] * sigmas[i]);
  }
  return fit;
}

}  // namespace faults
