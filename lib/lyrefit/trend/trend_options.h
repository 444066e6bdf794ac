// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Options of a trend.
struct TrendOptions {
  // The first days of the series, with which all later ones are compared.
  double reference_days = 30;
  // Sweeps in less light tell power only, W/m2.
  double least_irradiance_W_m2 = 200;
  // Expected number of false onsets a year of a device without a change.
  double false_alarms_per_year = 0.05;
  // Onsets of what takes less power than this are not claimed, in percent.
  double least_onset_percent = 0.3;
  // Standard deviations of what the instruments may drift in a year. They widen intervals.
  double irradiance_drift_percent = 0.5;
  double temperature_drift_K = 0.2;
  std::uint64_t seed = 0;  // of the null distribution of changes
  int threads = 0;         // 0: all cores; never changes a result
};

inline constexpr OptionRow<TrendOptions> kTrendOptionTable[] = {
    OptionRow<TrendOptions>("Trend"),
    {"reference-days", "DAYS", "the first days, with which all later ones are compared",
     &TrendOptions::reference_days, 3.0, 3660.0},
    {"least-irradiance", "W/m2", "sweeps in less light tell power only",
     &TrendOptions::least_irradiance_W_m2, 0.0, 1000.0},
    {"false-alarms", "RATE", "expected number of false onsets a year",
     &TrendOptions::false_alarms_per_year, 0.001, 5.0},
    {"least-onset", "PERCENT", "onsets of what takes less power are not claimed",
     &TrendOptions::least_onset_percent, 0.0, 100.0},
    {"irradiance-drift", "PERCENT",
     "what the light sensor may drift in a year, one standard deviation",
     &TrendOptions::irradiance_drift_percent, 0.0, 20.0},
    {"temperature-drift", "K",
     "what the temperature sensor may drift in a year, one standard deviation",
     &TrendOptions::temperature_drift_K, 0.0, 20.0},
    {"seed", "", "seed of the draws from series without a change", &TrendOptions::seed, 0,
     1.8446744073709552e19},
    {"threads", "N", "0: all cores; never changes a result", &TrendOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoEcho},
};

}  // namespace lyrefit
