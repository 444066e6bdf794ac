#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "studies/coverage.h"

namespace lyrefit {

// Curves that are simulated of each tandem.
enum class Spectra {
  kOne,      // the reference spectrum alone
  kThree,    // the reference, a red-rich and a blue-rich spectrum; every light is stated
  kBias,     // as three, and two curves with light for one junction alone
  kUnknown,  // as three; the bottom junction's light of the other two is not stated
};

template <>
struct EnumTable<Spectra> {
  static constexpr EnumText<Spectra> kRows[] = {{Spectra::kOne, "one"},
                                                {Spectra::kThree, "three"},
                                                {Spectra::kBias, "bias"},
                                                {Spectra::kUnknown, "unknown"}};
};

// The tandems that are simulated and fitted.
struct JunctionsOptions {
  int sets = 200;
  std::uint64_t seed = 0;  // of all random draws; set s has its own stream
  Spectra spectra = Spectra::kThree;
  int points = 60;               // per curve, at even steps from -0.1 V to a little beyond Voc
  double noise_relative = 1e-3;  // standard deviation of every current, as a part of Isc
  int threads = 0;               // 0: all cores; affects only the measured seconds
};

inline constexpr OptionRow<JunctionsOptions> kJunctionsOptionTable[] = {
    {"sets", "", "simulated tandems", &JunctionsOptions::sets, 1, 1e6},
    {"seed", "", "seed of everything that is drawn", &JunctionsOptions::seed, 0,
     1.8446744073709552e19},
    {"spectra", "NAME", "curves of each tandem", EnumOption<&JunctionsOptions::spectra>()},
    {"points", "", "points of each curve", &JunctionsOptions::points, 10, 1e5},
    {"noise-relative", "", "standard deviation of every current, as a part of Isc",
     &JunctionsOptions::noise_relative, 1e-9, 0.1},
    {"threads", "N", "0: all cores", &JunctionsOptions::threads, 0, kMostThreads},
};

// A tandem and its simulated curves.
struct SimulatedTandem {
  std::vector<double> truth;       // order of TwoJunctionInfos, under the reference spectrum
  std::vector<StatedLight> light;  // of each curve
  CurveSet set;
};

// Draws set number `s`: even numbers are perovskite on silicon, odd ones GaInP on GaAs.
SimulatedTandem DrawTandem(const JunctionsOptions& options, int s);

// The true value of an estimate of a fit of this tandem.
double TruthOf(const SimulatedTandem& tandem, const TwoJunctionReport& report,
               const ParameterInfo& info);

struct JunctionsReport {
  std::vector<ParameterCoverage> parameters;
  int sets = 0;
  int failed = 0;  // without a usable fit
  int above = 0;   // fits whose RMSE is above that of the true parameters
  double seconds = 0;
};

// Simulates and fits the tandems and counts how often intervals hold the true value.
JunctionsReport CountJunctions(const JunctionsOptions& options, const Observer& observer = {});

std::string JunctionsText(const JunctionsOptions& options, const JunctionsReport& report);

}  // namespace lyrefit
