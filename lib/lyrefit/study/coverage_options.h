#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"
#include "lyrefit/family/family_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// What the errors of the simulated currents are like.
enum class CoverageNoise {
  kEqual,       // independent, of one size over all curves
  kIsc,         // independent, in proportion to each curve's Isc
  kCorrelated,  // wandering light: along each sweep, in proportion to its Isc, correlated over one
                // Voc; a tenth of that is independent
};

template <>
struct EnumTable<CoverageNoise> {
  static constexpr EnumText<CoverageNoise> kRows[] = {{CoverageNoise::kEqual, "equal"},
                                                      {CoverageNoise::kIsc, "isc"},
                                                      {CoverageNoise::kCorrelated, "correlated"}};
};

// Which sets are simulated and fitted, and how many.
struct CoverageOptions {
  int sets = 500;
  std::uint64_t seed = 0;        // of everything that is drawn; set s has its own stream
  int curves = 0;                // of each set; 0: drawn from 5 to 30 for every set
  int points = 40;               // of each curve, even steps from 0 V to open circuit
  double noise_relative = 1e-3;  // standard deviation of every current, of Isc at the reference
  CoverageNoise noise = CoverageNoise::kEqual;
  double temperature_error_K = 0;        // every sensor reads that much too high
  double irradiance_error_W_m2 = 0;      // the same
  std::map<std::string, double> module;  // shared parameters by symbol or name, all of them; empty:
                                         // a module drawn for every set
  int cells_in_series = 72;              // of that module
  int threads = 0;                       // 0: all cores; never changes a result but the seconds
  // A file that every finished set is written to, and that a study is taken up from; empty: none.
  // `sets` and `threads` may be others than before.
  std::string journal;
  // Law, model, offsets and search of the fits. What costs time and says nothing here (fits of
  // single curves, folds, random baseline) is switched off, and every fit has one thread.
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
    {"noise", "NAME", "errors of one size, in proportion to each curve's Isc, or correlated",
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
