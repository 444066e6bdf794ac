#include "lyrefit/translate/key_point_noise.h"

#include <cmath>
#include <cstddef>
#include <string>

#include "lyrefit/base/random.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

// Bootstrap draws use streams apart from those of a propagation with the same seed.
constexpr std::uint64_t kStreams = std::uint64_t{1} << 40;

bool AllFinite(const std::vector<double>& deviations) {
  for (const double deviation : deviations) {
    if (!std::isfinite(deviation)) return false;
  }
  return true;
}

// Relative deviation of each key point from the smooth curve's, 0 where the smooth curve has none.
std::vector<double> Deviations(const std::vector<double>& drawn, const std::vector<double>& at) {
  std::vector<double> parts(at.size(), 0);
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (std::isfinite(at[k]) && at[k] != 0) parts[k] = drawn[k] / at[k] - 1;
  }
  return parts;
}

std::vector<std::vector<double>> Covariance(const std::vector<std::vector<double>>& rows,
                                            const std::vector<double>& mean) {
  const std::size_t n = mean.size();
  std::vector<std::vector<double>> covariance(n, std::vector<double>(n, 0));
  if (rows.size() < 2) return covariance;
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        covariance[i][j] += (row[i] - mean[i]) * (row[j] - mean[j]);
      }
    }
  }
  for (std::vector<double>& row : covariance) {
    for (double& entry : row) entry /= static_cast<double>(rows.size() - 1);
  }
  return covariance;
}

}  // namespace

std::vector<OutputQuantity> KeyPointQuantities() {
  return {{"short_circuit_current", "Isc", "A"},
          {"open_circuit_voltage", "Voc", "V"},
          {"max_power_current", "Imp", "A"},
          {"max_power_voltage", "Vmp", "V"},
          {"max_power", "Pmax", "W"},
          {"fill_factor", "FF", ""}};
}

std::vector<double> KeyPointVector(const KeyPoints& key) {
  return {key.short_circuit_current_A,
          key.open_circuit_voltage_V,
          key.max_power_current_A,
          key.max_power_voltage_V,
          key.max_power_W,
          key.fill_factor};
}

KeyPointNoise EstimateKeyPointNoise(const std::vector<double>& voltage_V,
                                    const std::vector<double>& current_A,
                                    const std::vector<double>& sigma_A,
                                    const std::vector<double>& sigma_V, int draws,
                                    std::uint64_t seed, KeyPointMethod method) {
  KeyPointNoise noise;
  noise.draws = draws;
  const std::vector<double> smooth = KeyPointVector(KeyPointsBy(method, {voltage_V, current_A}));
  std::vector<std::vector<double>> rows;
  std::vector<double> voltage = voltage_V, current = current_A;
  for (int draw = 0; draw < draws; ++draw) {
    RandomStream random(seed, kStreams + static_cast<std::uint64_t>(draw));
    for (std::size_t i = 0; i < current.size(); ++i) {
      current[i] = current_A[i] + sigma_A[i] * random.Normal();
      if (!sigma_V.empty()) voltage[i] = voltage_V[i] + sigma_V[i] * random.Normal();
    }
    std::vector<double> parts =
        Deviations(KeyPointVector(KeyPointsBy(method, {voltage, current})), smooth);
    if (AllFinite(parts)) rows.push_back(std::move(parts));
  }
  noise.failed = draws - static_cast<int>(rows.size());
  noise.relative_bias.assign(smooth.size(), 0);
  for (const std::vector<double>& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      noise.relative_bias[k] += row[k] / static_cast<double>(rows.size());
    }
  }
  noise.relative_covariance = Covariance(rows, noise.relative_bias);
  return noise;
}

KeyPointNoise NoiseOfCurve(const PreparedCurve& curve, std::uint64_t seed) {
  constexpr int kDraws = 400;
  std::vector<double> current_A = curve.points.current_A;
  if (curve.diode) {
    const Device device = MakeDevice(Model::kSingleDiode, {});
    std::vector<double> p(device.size());
    p[kIph] = curve.diode->photocurrent_A;
    p[SaturationCurrentIndex(0)] = curve.diode->saturation_current_A;
    p[IdealityIndex(0)] = curve.diode->nNsVth_V / device.module_thermal_voltage_V;
    p[kRs] = curve.diode->resistance_series_ohm;
    p[kRsh] = curve.diode->resistance_shunt_ohm;
    for (std::size_t i = 0; i < current_A.size(); ++i) {
      current_A[i] = SolveOperatingPoint(device, p.data(), curve.points.voltage_V[i]).current_A;
    }
  }
  return EstimateKeyPointNoise(curve.points.voltage_V, current_A,
                               std::vector<double>(current_A.size(), curve.noise_A), {}, kDraws,
                               seed, curve.key_points);
}

OutputTerm NoiseTerm(const KeyPointNoise& noise, const std::vector<double>& translated) {
  OutputTerm term;
  term.name = "noise";
  term.title = "noise of the readings";
  term.group = "readings";
  term.source = "bootstrap of the key points from the noise of the readings, " +
                std::to_string(noise.draws) + " draws";
  term.factors = FactorsOf(noise.relative_covariance);
  for (std::vector<double>& factor : term.factors) {
    for (std::size_t k = 0; k < factor.size(); ++k) factor[k] *= translated[k];
  }
  return term;
}

}  // namespace lyrefit
