#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/law/device.h"

namespace lyrefit {

struct SimulateOptions {
  Model model = Model::kSingleDiode;
  std::map<std::string, double> parameters;  // by symbol or name: all of the model, n per cell
  Conditions conditions;
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<double> voltage_V;  // empty: `points` even steps from 0 to 2 % beyond open circuit
  int points = 100;
  // Independent Gaussian noise on every current, of the two parts' root of the sum of squares.
  double noise_A = 0;         // standard deviation, constant part
  double noise_relative = 0;  // standard deviation, part of |current|
  std::uint64_t seed = 0;     // of the noise
  std::string name = "simulated";
};

// The curve of a device under the given conditions: I(V) solved to rounding, then noise. Same
// options, same bits. Errors: a parameter missing, unknown or outside its physical range, no
// open-circuit voltage to end at, options outside their ranges.
Expected<IvCurve> Simulate(const SimulateOptions& options);

// Model, parameters, conditions, constants and name of a JSON fit report, ready to be simulated. An
// infinite shunt resistance, null in JSON, is read back as infinite.
Expected<SimulateOptions> ReadFitForSimulation(const std::string& path);

}  // namespace lyrefit
