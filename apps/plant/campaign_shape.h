#pragma once

#include <array>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/sparkline.h"

namespace lyrefit {

// What may change a string between two sweeps, each as what it does to a sweep. A sweep is taken in
// parts of its own Isc and Voc, i(v), and every mechanism is a change of this measured curve: no
// model of the modules is needed, and what was wrong before is in both sweeps.
//
//   light               i falls by d, unevenly by a part of d, and v at equal i rises by what the
//                       series resistance no longer takes (IEC 60891, procedure 1)
//   substrings          v falls to 1 - k / N: k of N groups of cells give no voltage
//   temperature         v falls by a constant
//   series resistance   v falls by r i
//   shunt               i of a part f of the cells falls by g v
//   mismatch            a part f of the cells has d less light; their bypass diodes conduct beyond
//
// Shunts and mismatch are alike in their cells, or spread evenly from nothing to twice the size.
//
//   other modules       Isc, Voc and the series resistance change freely
enum class Mechanism {
  kLight,
  kSubstrings,
  kTemperature,
  kSeriesResistance,
  kShunt,
  kMismatch,
  kOtherModules
};
inline constexpr int kMechanisms = 7;

// What less light does to a usual module of silicon at equal temperature, per ln of the light: Voc
// falls by n k T / q of about 0.9 V of 40 V and less, FF rises by the part of the power that the series
// resistance takes.
inline constexpr double kVocPerLight = 0.045, kFillPerLight = -0.06;

// The largest errors of a temperature sensor on a string that is aired like its neighbours, as part
// of Voc: 2.5 K as standard deviation, 6 K at most.
inline constexpr double kTemperatureSigma = 0.0075, kTemperatureMost = 0.018;

// A sweep: logarithms of its figures at standard conditions, and its currents at even voltages from
// 0 to Voc in parts of Isc; empty: unknown.
struct SweepFigures {
  double log_isc = kUnknown, log_voc = kUnknown;
  double imp_per_isc = kUnknown, vmp_per_voc = kUnknown;
  std::vector<double> currents;  // kSparklinePoints
};

// Standard deviations of the differences of two sweeps of a string that did not change.
struct SweepScatter {
  double log_isc = kUnknown, log_voc = kUnknown, log_fill = kUnknown;
  double log_imp_per_isc = kUnknown, log_vmp_per_voc = kUnknown;
  std::array<double, kSparklinePoints> currents{};
};

// What is known of the string.
struct StringFacts {
  int substrings = 0;                 // groups of cells with a bypass diode; 0: unknown
  double open_circuit_voltage_V = 0;  // Voc of the whole string
};

// A mechanism with the size that fits two sweeps best.
struct MechanismFit {
  Mechanism mechanism = Mechanism::kLight;
  // d, k / N, the part of Voc, r or g, in parts of Isc and Voc. Of other modules: r.
  double size = 0;
  double part = 1;           // f; of light, the standard deviation of d over d
  bool spread = false;       // evenly from nothing to twice the size
  int count = 0;             // k
  double misfit = kUnknown;  // -2 ln of the posterior but for a constant
  double goodness = 0;       // tail probability of chi-squared of what it leaves
  double probability = 0;    // among all mechanisms
};

// All mechanisms that may make `ill` of `sound`, the most probable first. Sizes are losses. Empty: what
// differs is as likely to be chance, since few strings change.
std::vector<MechanismFit> FitMechanisms(const SweepFigures& sound, const SweepFigures& ill,
                                        const SweepScatter& scatter, const StringFacts& facts);

}  // namespace lyrefit
