// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Limits of the conditions of a field measurement, and the wind, which is not recorded with a
// curve.
struct ChecklistOptions {
  double least_irradiance_W_m2 = 700;
  double most_sweep_s = 5;
  double most_unsteady_percent = 2;
  double most_wind_m_s = 4;
  std::optional<double> wind_m_s;
};

inline constexpr OptionRow<ChecklistOptions> kChecklistOptionTable[] = {
    OptionRow<ChecklistOptions>("Conditions of a field measurement"),
    {"least-irradiance", "W/m2", "light that a field test asks for (IEC 61829:2015)",
     &ChecklistOptions::least_irradiance_W_m2, 0, 2000},
    {"most-sweep-time", "s", "longest sweep (IEC 61829:2015)", &ChecklistOptions::most_sweep_s, 0,
     3600},
    {"most-unsteady", "%", "largest departure of the light from its mean during a sweep",
     &ChecklistOptions::most_unsteady_percent, 0, 100},
    {"most-wind", "m/s", "most wind (IEC 61829:2015)", &ChecklistOptions::most_wind_m_s, 0, 100},
    {"wind", "m/s", "wind during the measurement", &ChecklistOptions::wind_m_s},
};

}  // namespace lyrefit
