// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
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
    {"wind", "m/s", "wind during the measurement", &ChecklistOptions::wind_m_s, 0, 100},
};

// Notes of the operator for the printed page. They enter no computation: the uncertainty of a
// calibration is set in UncertaintyOptions.
struct FieldNotes {
  std::string tracer;
  std::string serial;
  std::string calibration;
  std::string operated_by;
  std::string remark;
};

inline constexpr OptionRow<FieldNotes> kFieldNotesTable[] = {
    OptionRow<FieldNotes>("Printed on the page"),
    {"tracer", "TEXT", "the instrument, as it is called", &FieldNotes::tracer},
    {"serial", "TEXT", "its serial number", &FieldNotes::serial},
    {"calibration", "TEXT", "its calibration: certificate, date", &FieldNotes::calibration},
    {"operator", "TEXT", "who measured", &FieldNotes::operated_by},
    {"remark", "TEXT", "whatever else is to be read on the page", &FieldNotes::remark},
};

// Tolerance of a module's rated power in the notation of data sheets: "-0,+5" in percent, "-0W,+5W"
// in watt.
struct PowerTolerance {
  double low = -3;  // below the rating: 0 or negative
  double high = 3;
  bool in_W = false;
};
Expected<PowerTolerance> ReadTolerance(const std::string& text);
std::string ToleranceText(const PowerTolerance& tolerance);

// Rating of the modules, and the layout of the string.
struct FieldTestOptions {
  std::optional<double> rated_W;
  PowerTolerance tolerance;
  double rated_percent = 0;
  std::optional<double> power_coefficient_percent_K;
  double power_coefficient_percent = 5;
  int modules = 0;  // 0: as the curve or the sheet of the module states, else 1
  int strings = 1;
  double cabling_percent = 0;
};

inline constexpr OptionRow<FieldTestOptions> kFieldTestOptionTable[] = {
    OptionRow<FieldTestOptions>("Field test"),
    {"rated-W", "W", "rated Pmax of one module at 1000 W/m2 and 25 C", &FieldTestOptions::rated_W,
     1e-6, 1e6},
    {"tolerance", "-L,+H", "of the rating, in % or as -0W,+5W",
     OptionText<FieldTestOptions>{[](const std::string& text, FieldTestOptions* options,
                                     const TextReaders&) -> Expected<void> {
                                    const Expected<PowerTolerance> tolerance = ReadTolerance(text);
                                    if (!tolerance) return tl::unexpected<Error>(tolerance.error());
                                    options->tolerance = *tolerance;
                                    return {};
                                  },
                                  [](const FieldTestOptions& options) -> std::vector<std::string> {
                                    return {ToleranceText(options.tolerance)};
                                  },
                                  nullptr, false}},
    {"rated-u", "%", "expanded uncertainty (k = 2) of the rating itself; 0: it is a promise",
     &FieldTestOptions::rated_percent, 0, 50},
    {"gamma", "%/K", "temperature coefficient of Pmax",
     &FieldTestOptions::power_coefficient_percent_K, -10, 10},
    {"gamma-u", "%", "its expanded uncertainty (k = 2), of itself",
     &FieldTestOptions::power_coefficient_percent, 0, 1000},
    {"modules", "N", "modules in series in the string; 0: as the curve or the sheet states, else 1",
     &FieldTestOptions::modules, 0, 1000},
    {"strings", "N", "strings in parallel", &FieldTestOptions::strings, 1, 1000},
    {"cabling-loss", "%", "of the power in the cables, at 1000 W/m2",
     &FieldTestOptions::cabling_percent, 0, 50},
};

}  // namespace lyrefit
