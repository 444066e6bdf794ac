// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/effects/fitted_effect.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// All results are for the solved-current objective, r = I_model(V) - I_measured.

// One reading: measured current, base model and extended model. The points are in the order of
// measurement.
struct DiagnosedPoint {
  int curve = 0;    // position among Diagnosis::curves
  int segment = 0;  // number of the monotone voltage sweep, over the whole set
  double voltage_V = 0;
  double current_A = 0;
  double sigma_A = 0;    // estimated standard deviation of the noise
  double before_A = 0;   // base model
  double after_A = 0;    // extended model; equal to before_A if nothing was found
  double without_A = 0;  // extended model with its causes removed: the device without the fault
  double time_s = 0;     // NaN if no times were recorded
};

// One curve of a diagnosis.
struct DiagnosedCurve {
  std::string name;  // as in the input
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
  bool dark = false;  // measured without light
  int points = 0;
};

// A conspicuous feature of the values or of the base model's residuals, found before any cause is
// tried.
struct Finding {
  std::string id;        // "clipping", "grid", "runs", "autocorrelation", "bound", "n_below_1", ...
  std::string sentence;  // with its numbers
  std::vector<int> points;  // positions in Diagnosis::points; may be empty
};

// Properties of the readings and of the base model's residuals, before any cause is tried.
struct Evidence {
  std::string kind;              // text such as "one sweep from 0 V to beyond Voc"
  double noise_constant_A = 0;   // standard deviation, constant part (lit curves)
  double noise_relative = 0;     // fraction of |current|
  double noise_voltage_V = 0;    // of the voltage readings; 0 unless the data clearly show it
  double noise_dark_A = 0;       // constant part of dark curves; 0 without dark curves
  double noise_stated_A = 0;     // median of stated sigmas, if they replace the estimate; else 0
  double noise_path_A = 0;       // rough path along the sweep, shared by neighbours; 0: none
  double misfit_ratio = 0;       // deviation of base residuals / of noise from second differences
  double autocorrelation = 0;    // lag 1, of the noise (smooth misfit removed)
  double grid_step_A = 0;        // common step of the currents; 0: none found
  double grid_step_V = 0;        // common step of the voltages; 0: none found
  int clipped_points = 0;        // readings at a limit of the instrument
  double clip_level_A = 0;       // that limit; 0 without clipped readings
  ResidualStatistics residuals;  // of the base model
  double whiteness_p_value = 1;  // portmanteau of the base residuals
  double whiteness_after_p_value = 1;  // portmanteau of the extended model's residuals
  std::vector<Finding> findings;
};

// Result of trying one effect of the catalogue.
struct Trial {
  std::string effect;  // its id
  std::string title;
  bool tried = false;        // false: not tried, see why_not
  std::string why_not;       // reason if it was not tried
  double rmse_A = kUnknown;  // base model with this one effect
  double misfit = kUnknown;  // norm of the reduction of the residuals, in noise deviations
  // ln of the marginal likelihood of the base model with this effect over that without it.
  double log_evidence = kUnknown;
  double probability = kUnknown;  // of this effect as the only cause, among none and all effects
  double probability_material = kUnknown;  // that its size, if it acts, exceeds a floor
  double delta_aicc = kUnknown;            // with the effect minus without; negative is better
  double held_out_rmse_A = kUnknown;
  double kept = kUnknown;  // fraction of the effect's signature that the base model cannot absorb
  std::vector<CauseParameter> parameters;  // fitted together with the base model
};

// A hypothesis that could stand in the place of a cause.
struct Alternative {
  std::string id;  // of an effect; "none": no cause; "unknown_structure": none of the known
  std::string title;
  double probability = kUnknown;  // those of a cause and of all its alternatives add up to 1
};

// An effect that explains a deviation of the data from the base model.
struct Cause {
  std::string id;      // of the finding, which may have several mechanisms
  std::string effect;  // id of the effect that is fitted: its most probable mechanism
  std::string title;
  std::string sentence;                   // for a technician, with size
  std::vector<std::string> in_words;      // meaning here: light in %, heat of a hot cell in W
  Sized current_effect;                   // on the curve, root mean square, fraction of Isc
  Sized power_effect;                     // relative error of Pmax of a model without the effect
  Sized recoverable_power_W;              // additional Pmax of the device without the effect
  bool at_least = false;                  // that power is a lower limit: only low_95 is known
  double probability = kUnknown;          // of the finding, against the alternatives
  std::vector<Alternative> alternatives;  // above 0.5 %, most probable first
  std::vector<Alternative> mechanisms;    // effects of the same finding, likewise; empty: only one
  std::string group;                      // "device", "wiring", "sweep", "instrument", "unknown"
  std::string action;                     // the next thing to do about it
  std::string fact_sheet;                 // of IEA-PVPS T13-30:2025; may be empty
  std::vector<std::string>
      equivalents;  // ids that these data cannot separate from it, with its mechanisms
  std::vector<std::string> separate_by;  // measurements that would separate them
  std::vector<CauseParameter> strength;  // its parameters with intervals
  std::string evidence;                  // "fit" or "values"
  std::string acts;                      // region of the curve in which it acts, as text
  std::vector<int> points;               // where it acts most: positions in Diagnosis::points
};

// The alternatives that the verdict's sentence says beside a cause, most probable first: as many as
// reach `probability` (DiagnoseOptions) together with it, two at most. Empty: it is named alone.
std::vector<Alternative> SaidBeside(const Cause& cause, double probability);

// An effect that may be present undetected, since these data cannot show it.
struct CannotBeExcluded {
  std::string id;
  std::string biases;  // symbols of the parameters that it biases
  std::string sentence;
  std::string separate_by;
};

// A parameter of the device outside the range of devices without a fault.
struct DeviceFinding {
  std::string id;                   // "leak", "ideality" or "series_resistance"
  std::string symbol;               // "Voc/(Rsh Isc)"
  Sized value;                      // under standard light
  double healthy_limit = kUnknown;  // largest value of devices without a fault
  double power_loss = kUnknown;     // part of Pmax that the healthy limit would give more
  std::string sentence;             // without its subject: "leaks 3.1 % ..."
  bool if_silicon = false;          // within range of other technologies; nobody stated which it is
  Sized recoverable_power_W;        // additional Pmax of the device with the healthy limit
};

// What a module loses of its fill factor to series resistance.
struct ResistanceLoss {
  Sized part;               // of the fill factor: pseudo fill factor less fill factor
  double usual = kUnknown;  // of new modules under the same light
  double most = kUnknown;   // the most that new ones lose
  Sized beyond_W;           // of Pmax, beyond what new ones lose; below 0: it loses less
  // Largest height by which a chord over the sweep exceeds a reading, in Isc. Diodes and resistances
  // give none: where there is one, a bypass diode or a cell in breakdown conducts.
  double rise = 0;
};

// The fill factor of a module beside that of modules without a fault of the same Voc, number of cells,
// temperature and light.
struct FillFactor {
  Sized value;              // without the causes that are named, resistances excepted
  double usual = kUnknown;  // of modules without a fault
  double least = kUnknown;  // the least that they have
  Sized lost_W;             // of Pmax, against the usual one; below 0: it has more
  Sized lost;               // the same as a part of the Pmax that the usual one would give
  // No technology is stated, and a thin film may have it without a fault.
  bool if_silicon = false;
};

// Conclusion of a diagnosis.
struct Verdict {
  bool found = false;  // at least one cause is in `causes`
  // Structure is present that no known cause fits. Without a named cause: the base model misses the
  // data by more than it misses modules without a fault.
  bool unexplained = false;
  std::vector<Cause> causes;  // largest effect on the curve first
  // Significant effects that are too small to act on.
  std::vector<Cause> below_floor;
  Sized lack_of_fit;                   // of the base model beyond noise, rms in fractions of Isc
  double probability_none = kUnknown;  // that no cause above the floors acts
  // Of modules of silicon in one sweep; the first by a Suns-Voc trace beside it only.
  std::optional<ResistanceLoss> resistance_loss;
  std::optional<FillFactor> fill_factor;
  Sized recoverable_power_W;  // additional Pmax of the device without all causes
  Sized remaining;            // the same of the extended model
  std::string comparison;     // of both with modules without a fault; empty if nothing was found
  std::vector<CannotBeExcluded> cannot_be_excluded;  // effects that the data cannot show
  std::string not_shown;                             // the commonest of these in a few words
  std::string sentence;
};

// Change of a base parameter or of the maximum power when the causes are modelled.
struct ParameterShift {
  std::string symbol;
  std::string name;  // name in code and JSON
  std::string unit;
  double before = kUnknown;          // of the base model
  double after = kUnknown;           // of the extended model
  double standard_error = kUnknown;  // of `after`
};

// Improvement by modelling the causes, on fitted readings and on held-out ones.
struct Gain {
  double rmse_before_A = kUnknown;
  double rmse_after_A = kUnknown;
  double held_out_before_A = kUnknown;  // blocks or curves left out, selection repeated
  double held_out_after_A = kUnknown;
  double held_out_gain_A2 = kUnknown;        // mean difference of squares over the blocks
  double held_out_gain_error_A2 = kUnknown;  // its standard error
  bool gain = false;                         // larger than its standard error
  int folds = 0;                             // number of parts that were left out in turn
  bool by_sweeps = false;                    // the parts were whole sweeps
  std::string sentence;
  std::vector<ParameterShift> shifts;
};

// The setup in which a measurement was judged, which decides what could disturb it.
struct JudgedSetup {
  Setup setup = Setup::kUnknown;  // unknown: judged as outdoors
  std::string from = "assumed";   // "assumed", "stated" by an option, or in the "file"
  std::string source;             // the option, or where the file says it; empty: assumed
};

// Result of a diagnosis, with the evidence for it.
struct Diagnosis {
  std::string version;        // of lyrefit
  std::string name;           // of the curve or of the set
  std::string source;         // file of the readings
  std::string base;           // "sd" or "dd"
  std::string base_sentence;  // assumptions of the base model
  std::uint64_t seed = 0;
  double probability = 0.8;  // smallest probability at which a cause is named
  double floor_current = 0;  // smallest effect that is named, rms in fractions of Isc
  double floor_power = 0;    // or in fractions of Pmax
  int cells_in_series = 1;
  JudgedSetup setup;
  std::vector<DiagnosedCurve> curves;  // in the set's order
  std::vector<DiagnosedPoint> points;
  Evidence evidence;                           // before any cause is tried
  std::vector<Trial> trials;                   // in the order of the catalogue
  Verdict verdict;                             // conclusion
  std::vector<DeviceFinding> device_findings;  // parameters of the device that are out of range
  Gain gain;                                   // improvement by the causes
  // The extended model (the base model if nothing was found) as a FitReport. With
  // DiagnoseOptions::extend it is searched and polished. Otherwise only `model`, `estimates`,
  // `causes`, `curves`, `usable`, `nNsVth` and the refined RMSE are filled, and `device` is empty:
  // the law is then defined by the catalogue.
  FitReport extended;
  std::vector<OptionEcho> non_default_options;
  std::vector<std::string> assumptions;  // made when the files were read
  std::vector<std::string> doubts;       // about the readings, before any fit; see check_readings.h
  std::vector<std::string> warnings;     // including these doubts
  double seconds = 0;
  bool interrupted = false;
};

// A parameter out of range as a cause: with id, title, sentence, group ("device"; "conditions" of an ideality
// below that of any junction, whose id is then "low_ideality"), action and what would separate it.
Cause CauseOf(const DeviceFinding& finding);

// The one cause that a row, a summary or a page of many curves names: the first of the verdict that
// belongs to the device, else of the findings, unless the light or the conditions changed, else the
// first of the verdict. Its group is what it belongs to: "device"; "sweep", "instrument" or
// "conditions", which call for a new measurement; or "unknown". An empty id: neither.
Cause MainCause(const Diagnosis& diagnosis);

}  // namespace lyrefit
