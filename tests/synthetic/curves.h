#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/model/device.h"

// Curves that tests make: the device and its noise are known.
namespace lyrefit {

// `points` equidistant voltages.
std::vector<double> EvenVoltages(double from_V, double to_V, int points);

// Adds Gaussian noise to the currents.
void AddNoise(double noise_A, RandomStream* random, IvCurve* curve);

// The readings of a curve up to a voltage.
IvCurve UpTo(double last_V, const IvCurve& curve);

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

// Iph, Is, n, Rs and Rsh of the string at the recipe's light.
std::vector<double> SyntheticParameters(const Recipe& recipe);

IvCurve SyntheticCurve(const Recipe& recipe);

IvCurve SyntheticDarkCurve(std::uint64_t seed = 2);

CurveSet SetOf(std::vector<IvCurve> curves);

inline const std::vector<double> kSingleTruth = {3.8, 2e-8, 1.2, 0.25, 300};
inline const std::vector<double> kDoubleTruth = {3.8, 5e-10, 1.02, 0.2, 300, 2e-5, 2};

// A 36-cell module at 25 C with `points` readings from 0 V to slightly beyond Voc and noise.
IvCurve ModuleCurve(Model model, const std::vector<double>& p, double noise_A,
                    std::uint64_t seed = 1, int points = 60, double to_V = 21.8);

// A single diode whose irradiance wanders by 1e-3 during the sweep (autoregressive, with the length
// of the sweep). The voltages have relative noise of 3e-4.
IvCurve WanderingCurve(int seed, int points = 100);

// Without code of the models. Voltage of `cells` cells in series at a current, without series
// resistance, at 25 C. n = 1.1 and Voc is 0.64 V per cell at 9 A. A bypass diode limits the voltage to
// about -0.5 V.
double SubstringVoltage(double current_A, double photocurrent_A, int cells);

// A 60-cell module of three substrings, each with its own light (1 means 9 A): `points` equidistant
// voltages from 0 to 39 V, noise of 2 mA.
IvCurve SyntheticModule(double first = 1, double second = 1, double third = 1, int points = 100);

// A single cell from -0.1 to 0.69 V in steps of 10 mV; photocurrent 0.15 A times `light`, noise of
// 30 uA.
IvCurve SyntheticCell(double light = 1);

// A laboratory cell of 0.25 cm2 at 25 C: Iph, Is, n, Rs and Rsh in A and ohm.
inline const std::vector<double> kCellTruth = {5.5e-3, 2e-13, 1.4, 6, 9000};

// A sweep of a diode under `light` W/m2 (0: dark) from -0.1 to 0.96 V, or down from there.
IvCurve CellSweepOf(std::vector<double> p, double light, bool down = false, double noise_A = 0);

CurveSet CellOf(std::vector<IvCurve> curves);

}  // namespace lyrefit
