#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/random.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

// A synthetic measurement of a silicon cell of 8 A, or of a string of such cells. Voltages are per
// cell; noise_relative is relative to each current.
struct Recipe {
  std::string name = "made";
  int points = 60;
  int cells = 1;
  double irradiance_W_m2 = 1000;
  double from_V = -0.02;  // per cell
  double to_V = 0.645;
  bool and_back = false;
  double noise_A = 0.004;
  double noise_relative = 0;
  std::uint64_t seed = 1;
};

inline std::vector<double> SweepVoltages(const Recipe& recipe) {
  std::vector<double> voltage;
  const double step = (recipe.to_V - recipe.from_V) / (recipe.points - 1);
  for (int k = 0; k < recipe.points; ++k) voltage.push_back(recipe.from_V + step * k);
  if (recipe.and_back) {
    for (int k = recipe.points - 1; k >= 0; --k) voltage.push_back(recipe.from_V + step * k);
  }
  for (double& v : voltage) v *= recipe.cells;
  return voltage;
}

// Iph, Is, n, Rs and Rsh of the string at the recipe's light.
inline std::vector<double> SyntheticParameters(const Recipe& recipe) {
  return {8 * recipe.irradiance_W_m2 / 1000, 1.2e-8, 1.2, 0.004 * recipe.cells, 20. * recipe.cells};
}

inline IvCurve SyntheticCurve(const Recipe& recipe) {
  IvCurve curve;
  curve.name = recipe.name;
  curve.conditions.cells_in_series = recipe.cells;
  curve.conditions.irradiance_W_m2 = recipe.irradiance_W_m2;
  curve.voltage_V = SweepVoltages(recipe);
  const std::vector<double> p = SyntheticParameters(recipe);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  curve.current_A = SolveCurrents(device, p.data(), curve.voltage_V);
  RandomStream random(recipe.seed);
  for (double& i : curve.current_A) {
    i += recipe.noise_A * random.Normal() + recipe.noise_relative * i * random.Normal();
  }
  return curve;
}

inline CurveSet SetOf(std::vector<IvCurve> curves) {
  CurveSet set;
  set.name = "made set";
  set.curves = std::move(curves);
  return set;
}

inline IvCurve SyntheticDarkCurve(std::uint64_t seed = 2) {
  Recipe recipe;
  recipe.name = "dark";
  recipe.irradiance_W_m2 = 0;
  recipe.from_V = -0.5;
  recipe.seed = seed;
  return SyntheticCurve(recipe);
}

}  // namespace lyrefit
