// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <optional>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Source of the irradiance.
enum class LightSource {
  kNotStated,
  kReferenceCell,  // in the plane of the modules
  kPyranometer,
  kLaboratory,  // a simulator set by a calibrated reference
  kCurve,       // the curve's own short-circuit current
};

template <>
struct EnumTable<LightSource> {
  static constexpr EnumText<LightSource> kRows[] = {{LightSource::kNotStated, "not-stated"},
                                                    {LightSource::kReferenceCell, "reference-cell"},
                                                    {LightSource::kPyranometer, "pyranometer"},
                                                    {LightSource::kLaboratory, "laboratory"},
                                                    {LightSource::kCurve, "curve"}};
};

// Source of the cell temperature.
enum class TemperatureSource {
  kNotStated,
  kBackOfModule,  // a sensor on the back, which is colder than the cells
  kVoc,           // the open-circuit voltage, IEC 60904-5
  kLaboratory,    // module and room in equilibrium
};

template <>
struct EnumTable<TemperatureSource> {
  static constexpr EnumText<TemperatureSource> kRows[] = {
      {TemperatureSource::kNotStated, "not-stated"},
      {TemperatureSource::kBackOfModule, "back"},
      {TemperatureSource::kVoc, "voc"},
      {TemperatureSource::kLaboratory, "laboratory"}};
};

// Accuracy class of the current and voltage measurement.
enum class InstrumentClass { kField, kLaboratory };

template <>
struct EnumTable<InstrumentClass> {
  static constexpr EnumText<InstrumentClass> kRows[] = {
      {InstrumentClass::kField, "field"}, {InstrumentClass::kLaboratory, "laboratory"}};
};

// Uncertainties of the inputs of a translated curve. EVERY size is an EXPANDED uncertainty, k = 2,
// as on certificates and data sheets; the library halves it. A size that is not set is that of its
// class, see the table in field_inputs.h.
struct UncertaintyOptions {
  LightSource light_source = LightSource::kNotStated;
  TemperatureSource temperature_source = TemperatureSource::kNotStated;
  InstrumentClass instrument = InstrumentClass::kField;
  // Cell minus sensor temperature at 1000 W/m2, K, in proportion to the irradiance; added to the
  // measured temperature. This is a value, not an uncertainty. Default: 2.5 for a sensor on the
  // back, else 0.
  std::optional<double> cell_correction_K;
  std::optional<double> irradiance_percent;
  std::optional<double> temperature_K;
  std::optional<double> cell_offset_K;  // of cell minus sensor temperature
  std::optional<double> voltage_percent;
  std::optional<double> current_percent;
  double lead_percent = 20;
  double rear_percent = 10;
  double bifaciality_percent = 5;
  std::optional<double> alpha_percent;
  std::optional<double> beta_percent;
  double kappa_percent = 100;
  double series_resistance_percent = 20;
  double light_of_voc_percent = 20;
  double epsilon_percent = 8;
  double bandgap_percent = 2;
  double bandgap_slope_percent = 20;
  double ideality_slope_percent_per_K = 0.04;
  std::optional<double> translation_percent;
  double coverage_factor = 2;
  int draws = 10000;
  int significant_digits = 1;
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores; never changes a result
};

inline constexpr OptionRow<UncertaintyOptions> kUncertaintyOptionTable[] = {
    OptionRow<UncertaintyOptions>("Uncertainty (every size expanded, k = 2)"),
    {"irradiance-from", "", "what the irradiance was taken from",
     EnumOption<&UncertaintyOptions::light_source>()},
    {"temperature-from", "", "what the cell temperature was taken from",
     EnumOption<&UncertaintyOptions::temperature_source>()},
    {"instrument", "", "class of the curve tracer", EnumOption<&UncertaintyOptions::instrument>()},
    {"cell-correction", "K",
     "added to the temperature as read, at 1000 W/m2 and in proportion to the irradiance, as cells "
     "are warmer than the sensor; 0 for a sensor of the cells; else 2.5 where it is on the back",
     &UncertaintyOptions::cell_correction_K, -20, 20},
    {"irradiance-u", "%", "of the irradiance; else that of what it was taken from",
     &UncertaintyOptions::irradiance_percent, 0, 1000},
    {"temperature-u", "K", "of the temperature as read", &UncertaintyOptions::temperature_K, 0, 30},
    {"cell-offset-u", "K", "of how much warmer the cells are than the sensor",
     &UncertaintyOptions::cell_offset_K, 0, 30},
    {"voltage-u", "%", "calibration of the voltage", &UncertaintyOptions::voltage_percent, 0, 1000},
    {"current-u", "%", "calibration of the current", &UncertaintyOptions::current_percent, 0, 1000},
    {"lead-resistance-u", "%", "of the stated lead resistance", &UncertaintyOptions::lead_percent,
     0, 1000},
    {"rear-irradiance-u", "%", "of the irradiance of the back", &UncertaintyOptions::rear_percent,
     0, 1000},
    {"bifaciality-u", "%", "of the bifaciality", &UncertaintyOptions::bifaciality_percent, 0, 1000},
    {"alpha-u", "%", "of the temperature coefficient of Isc; else 20, or of its technology",
     &UncertaintyOptions::alpha_percent, 0, 1000},
    {"beta-u", "%", "of the temperature coefficient of Voc; else 5, or of its technology",
     &UncertaintyOptions::beta_percent, 0, 1000},
    {"kappa-u", "%", "of the curve correction factor", &UncertaintyOptions::kappa_percent, 0, 1000},
    {"rs-u", "%", "of the internal series resistance",
     &UncertaintyOptions::series_resistance_percent, 0, 1000},
    {"b-u", "%", "of B1 and B2, how Voc follows the light",
     &UncertaintyOptions::light_of_voc_percent, 0, 1000},
    {"epsilon-u", "%", "of epsilon, by which procedure 4 moves the voltage with temperature",
     &UncertaintyOptions::epsilon_percent, 0, 100},
    {"bandgap-u", "%", "of the band gap", &UncertaintyOptions::bandgap_percent, 0, 100},
    {"bandgap-slope-u", "%", "of its slope with temperature",
     &UncertaintyOptions::bandgap_slope_percent, 0, 1000},
    {"mu-gamma-u", "%/K", "of the slope of the ideality, in parts of 1",
     &UncertaintyOptions::ideality_slope_percent_per_K, 0, 10},
    {"translation-u", "%", "of Pmax, by the procedure itself; else by its size over this step",
     &UncertaintyOptions::translation_percent, 0, 1000},
    {"coverage-factor", "k", "of expanded uncertainties in reports",
     &UncertaintyOptions::coverage_factor, 1, 4},
    {"draws", "N", "of the Monte Carlo propagation; 0: the linear one alone",
     &UncertaintyOptions::draws, 0, 10000000},
    {"significant-digits", "N",
     "of the standard uncertainty, to which both propagations must agree (JCGM 101, clause 8)",
     &UncertaintyOptions::significant_digits, 1, 3},
    {"seed", "N", "of the draws", &UncertaintyOptions::seed, OptionTrait::kNoFlag},
    {"threads", "N", "0: all cores; never changes a result", &UncertaintyOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoFlag | OptionTrait::kNoEcho},
};

}  // namespace lyrefit
