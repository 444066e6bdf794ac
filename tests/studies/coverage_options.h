#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/family/family_options.h"

namespace lyrefit {

// Error model of the simulated currents.
enum class CoverageNoise {
  kEqual,  // independent, with one standard deviation for all curves
  kIsc,    // independent, in proportion to each curve's Isc
  // Drifting irradiance: in proportion to the curve's Isc, correlation length along the sweep one
  // Voc; an independent error of a tenth of it is added.
  kCorrelated,
  // Key points in place of sweeps: independent relative errors of Isc, Voc, Vmp and Pmp, of the
  // sizes that the fit expects by default (KeyPointErrors).
  kKeyPoints,
};

template <>
struct EnumTable<CoverageNoise> {
  static constexpr EnumText<CoverageNoise> kRows[] = {{CoverageNoise::kEqual, "equal"},
                                                      {CoverageNoise::kIsc, "isc"},
                                                      {CoverageNoise::kCorrelated, "correlated"},
                                                      {CoverageNoise::kKeyPoints, "key-points"}};
};

// The sets that are simulated and fitted.
struct CoverageOptions {
  int sets = 500;
  std::uint64_t seed = 0;  // of all random draws; set s has its own stream
  int curves = 0;          // per set; 0: drawn from 5 to 30 for every set
  int points = 40;         // per curve, at even steps from 0 V to open circuit
  // Standard deviation of every current, relative to Isc at the reference conditions.
  double noise_relative = 1e-3;
  CoverageNoise noise = CoverageNoise::kEqual;
  double temperature_error_K = 0;    // offset of every reported temperature
  double irradiance_error_W_m2 = 0;  // offset of every reported irradiance
  // Shared parameters by symbol or name, all of them; empty: a module is drawn for every set.
  std::map<std::string, double> module;
  int cells_in_series = 72;  // cells of `module`
  int threads = 0;           // 0: all cores; affects only the measured seconds
  // Law, model, offsets and search of the fits. Fits of single curves, folds and the random
  // baseline are always switched off. Every fit uses one thread.
  FamilyOptions family;
};

inline constexpr OptionRow<CoverageOptions> kCoverageOptionTable[] = {
    OptionRow<CoverageOptions>("Device"),
    {"law", "NAME", "how parameters follow irradiance and temperature",
     EnumOption<&CoverageOptions::family, &FamilyOptions::law>()},
    {"model", "NAME", "number of diodes; td cannot be fitted jointly",
     EnumOption<&CoverageOptions::family, &FamilyOptions::model>()},
    {"set", "P=VALUE",
     "value of a shared parameter, Iph=8; once for each; default: a module drawn for every set",
     AssignmentsOption<&CoverageOptions::module>()},
    {"cells", "N", "cells in series, with --set (72)", &CoverageOptions::cells_in_series,
     OptionTrait::kUnchecked | OptionTrait::kNoDefault},
    OptionRow<CoverageOptions>("Sets"),
    {"sets", "", "simulated sets", &CoverageOptions::sets, 1, 1e6},
    {"seed", "", "seed of everything that is drawn; set s has its own stream",
     &CoverageOptions::seed, 0, 1.8446744073709552e19},
    {"curves", "", "curves of each set; 0: drawn from 5 to 30 for every set",
     &CoverageOptions::curves, 0, 1000},
    {"points", "", "points of each curve, from 0 V to open circuit", &CoverageOptions::points, 10,
     1e5},
    {"noise-relative", "", "standard deviation of every current, as a part of Isc at the reference",
     &CoverageOptions::noise_relative, 1e-9, 0.1},
    {"noise", "NAME",
     "errors of one size, in proportion to each curve's Isc, correlated, or of key points alone",
     EnumOption<&CoverageOptions::noise>()},
    {"temperature-error", "K", "hidden: the temperatures read that much too high",
     &CoverageOptions::temperature_error_K, -20, 20},
    {"irradiance-error", "W/m2", "hidden: the irradiances read that much too high",
     &CoverageOptions::irradiance_error_W_m2, -80, 80},
    {"threads", "N", "0: all cores; never changes a result but the seconds",
     &CoverageOptions::threads, 0, kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoEcho},
    OptionRow<CoverageOptions>("Fit"),
    {"weights", "NAME",
     "how curves count: as the residuals say, every point alike, relative to Isc",
     EnumOption<&CoverageOptions::family, &FamilyOptions::weights>()},
    {"temperature-offset", "", "fit one common error of the temperatures",
     SwitchOption<&CoverageOptions::family, &FamilyOptions::temperature_offset>()},
    {"irradiance-offset", "", "fit one common error of the irradiances",
     SwitchOption<&CoverageOptions::family, &FamilyOptions::irradiance_offset>()},
};

}  // namespace lyrefit
