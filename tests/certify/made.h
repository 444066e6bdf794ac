#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {

inline IvCurve Shipped(const std::string& name) {
  return *ReadCurve(std::string(LYREFIT_DATA_DIR) + "/" + name);
}

// The data of a curve in the type that the functions below Certify() take.
inline MixtureData DataOf(const IvCurve& curve) {
  return CurveData(curve.voltage_V, curve.current_A);
}

inline Window WindowOf(const IvCurve& curve, double n_lower, double n_upper) {
  const double vt = curve.conditions.ModuleThermalVoltage(ConstantSet::kCodata);
  return {1 / (n_upper * vt), 1 / (n_lower * vt)};
}

// A synthetic curve of a cell or a module with one to three diodes: 8 to 60 points, noise between
// 1e-5 and 3e-2 of Isc. Some have reverse bias, some reach far beyond Voc, some are unsorted with
// duplicates.
inline IvCurve RandomCurve(std::uint64_t seed) {
  RandomStream random(seed, 77);
  IvCurve curve;
  curve.name = "made " + std::to_string(seed);
  curve.conditions.cells_in_series = random.Uniform() < 0.5 ? 1 : 36;
  curve.conditions.cell_temperature_K = 283.15 + 60 * random.Uniform();
  const int diodes = 1 + static_cast<int>(random.Index(3));
  const Device device = MakeDevice(static_cast<Model>(diodes), curve.conditions);
  const double isc = 0.1 + 8 * random.Uniform();
  const double voc = 0.6 * curve.conditions.cells_in_series * (0.9 + 0.2 * random.Uniform());
  std::vector<double> p(device.size());
  p[kIph] = isc;
  p[kRs] = 0.1 * voc / isc * random.Uniform();
  p[kRsh] = voc / isc * std::pow(10, 0.3 + 2.5 * random.Uniform());
  for (int d = 0; d < diodes; ++d) {
    const double n = 1 + (d == 0 ? 0.5 : 1.0) * random.Uniform();
    p[IdealityIndex(d)] = n;
    p[SaturationCurrentIndex(d)] =
        isc / diodes / std::expm1(voc / (n * device.module_thermal_voltage_V));
  }
  const auto kind = random.Index(4);
  const int points = 8 + static_cast<int>(random.Index(53));
  const double low = kind == 1 ? -0.4 * voc : 0;
  const double high = kind == 2 ? 1.1 * voc : 1.01 * voc;
  for (int k = 0; k < points; ++k) {
    curve.voltage_V.push_back(low + (high - low) * k / (points - 1));
  }
  curve.current_A = SolveCurrents(device, p.data(), curve.voltage_V);
  const double noise = isc * std::pow(10, -5 + 3.5 * random.Uniform());
  for (double& i : curve.current_A) i += noise * random.Normal();
  if (kind == 3) {
    for (int k = points - 1; k > 0; --k) {
      const int j = static_cast<int>(random.Index(k + 1));
      std::swap(curve.voltage_V[k], curve.voltage_V[j]);
      std::swap(curve.current_A[k], curve.current_A[j]);
    }
    curve.voltage_V.push_back(curve.voltage_V[0]);
    curve.current_A.push_back(curve.current_A[0] + noise);
  }
  return curve;
}

}  // namespace lyrefit
