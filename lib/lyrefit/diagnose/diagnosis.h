#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/plan.h"
#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// Everything in a diagnosis is of the solved-current objective: r = I_model(V) - I_measured.

// One reading as measured, as the base model has it and as the extended one has it, in the order
// taken.
struct DiagnosedPoint {
  int curve = 0;    // position among Diagnosis::curves
  int segment = 0;  // monotone stretches of voltage, counted through the set
  double voltage_V = 0;
  double current_A = 0;
  double sigma_A = 0;    // noise as estimated from the data
  double before_A = 0;   // base model
  double after_A = 0;    // extended model; equal to before_A where nothing was found
  double without_A = 0;  // the extended model with its causes taken out: as if nothing were wrong
  double time_s = 0;     // NaN where no times were recorded
};

struct DiagnosedCurve {
  std::string name;
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
  bool dark = false;
  int points = 0;
};

// Something seen in the values or the base model's residuals, before any cause is thought of.
struct Finding {
  std::string id;        // "clipping", "grid", "runs", "autocorrelation", "bound", "n_below_1", ...
  std::string sentence;  // with its figures
  std::vector<int> points;  // positions in Diagnosis::points it is about; may be empty
};

struct Evidence {
  std::string kind;             // "one sweep from 0 V to beyond Voc", in words
  double noise_constant_A = 0;  // standard deviation, constant part (lit curves)
  double noise_relative = 0;    // part of |current|
  double noise_voltage_V = 0;   // of the voltage readings, where the data insist on it
  double noise_dark_A = 0;      // constant part of dark curves; 0 without
  double noise_stated_A = 0;    // median of what is stated and believed instead; 0: nothing is
  double noise_path_A = 0;      // of a rough path along the sweep that readings share; 0 without
  double misfit_ratio = 0;  // base residual's standard deviation / noise's from second differences
  double autocorrelation = 0;  // lag 1, of the noise (smooth misfit removed)
  double grid_step_A = 0;      // greatest common step of the currents; 0: none seen
  double grid_step_V = 0;
  int clipped_points = 0;
  double clip_level_A = 0;
  ResidualStatistics residuals;        // of the base model
  double whiteness_p_value = 1;        // portmanteau of the base residuals
  double whiteness_after_p_value = 1;  // of the extended model's
  std::vector<Finding> findings;
};

struct CauseParameter {
  std::string symbol;
  std::string name;
  std::string unit;
  double value = kUnknown;
  double low_95 = kUnknown;
  double high_95 = kUnknown;
  bool at_bound = false;
};

struct Trial {
  std::string effect;
  std::string title;
  bool tried = false;
  std::string why_not;            // where it was not
  double rmse_A = kUnknown;       // base model with this one effect
  double misfit = kUnknown;       // norm of what it takes away, in noise units
  double p_value = kUnknown;      // all of the effect's probes counted
  double corrected_p = kUnknown;  // the whole catalogue counted
  double delta_aicc = kUnknown;   // with the effect minus without: negative is better
  double held_out_rmse_A = kUnknown;
  double kept = kUnknown;  // part of the effect's signature the base model cannot absorb
  std::vector<CauseParameter> parameters;
};

// A size with its 95 % interval.
struct Sized {
  double value = kUnknown;
  double low_95 = kUnknown;
  double high_95 = kUnknown;
};

struct Cause {
  std::string id;
  std::string title;
  std::string sentence;                   // what a technician understands, with size
  std::vector<std::string> in_words;      // lights in %, a hot cell's watts: what it means here
  Sized current_effect;                   // on the curve, root mean square in parts of Isc
  Sized power_effect;                     // on Pmax, in parts: what the model gets wrong without it
  double recoverable_power_W = kUnknown;  // what the device would give more without it
  std::vector<std::string> equivalents;   // other ids these data cannot separate from it
  std::vector<std::string> separate_by;   // measurements that would
  std::vector<CauseParameter> strength;   // with intervals
  double corrected_p = kUnknown;
  std::string evidence;     // "fit" or "values"
  std::string acts;         // where on the curve, in words
  std::vector<int> points;  // where it acts most: positions in Diagnosis::points
};

struct CannotBeExcluded {
  std::string id;
  std::string biases;  // symbols
  std::string sentence;
  std::string separate_by;
};

struct Verdict {
  bool found = false;
  bool unexplained = false;   // something is there that no known cause fits
  std::vector<Cause> causes;  // the most certain first
  // There beyond doubt, but too small to act on.
  std::vector<Cause> below_floor;
  Sized departure;  // of the data from the base model beyond noise, rms in parts of Isc
  std::vector<CannotBeExcluded> cannot_be_excluded;
  std::string sentence;
};

// How the base model's parameters and the maximum power move when the causes are allowed for.
struct ParameterShift {
  std::string symbol;
  std::string name;
  std::string unit;
  double before = kUnknown;
  double after = kUnknown;
  double standard_error = kUnknown;  // of `after`
};

struct Gain {
  double rmse_before_A = kUnknown;
  double rmse_after_A = kUnknown;
  double held_out_before_A = kUnknown;  // whole blocks or curves left out, selection repeated
  double held_out_after_A = kUnknown;
  double held_out_gain_A2 = kUnknown;        // mean difference of squares over the blocks
  double held_out_gain_error_A2 = kUnknown;  // its standard error
  bool gain = false;                         // more than its standard error
  int folds = 0;
  bool by_sweeps = false;  // what was held out were whole sweeps
  std::string sentence;
  std::vector<ParameterShift> shifts;
};

struct Diagnosis {
  std::string version;  // of lyrefit
  std::string name;
  std::string source;
  std::string base;           // "sd" or "dd"
  std::string base_sentence;  // what the base model assumes
  std::uint64_t seed = 0;
  double level = 0.05;
  double floor_current = 0;  // smallest effect that is named, rms in parts of Isc
  double floor_power = 0;    // or in parts of Pmax
  int cells_in_series = 1;
  std::vector<DiagnosedCurve> curves;
  std::vector<DiagnosedPoint> points;
  Evidence evidence;
  std::vector<Trial> trials;  // in the order of the catalogue
  Verdict verdict;
  Gain gain;
  std::optional<Plan> plan;  // where it was asked for
  // The extended model (the base model where nothing was found) as a fit like any other. With
  // DiagnoseOptions::extend it is searched and polished; without, only `model`,
  // `estimates`, `causes`, `curves`, `usable`, `nNsVth` and the refined RMSE are filled. `device` is empty: the law is the catalogue's.
  FitReport extended;
  std::vector<OptionEcho> non_default_options;
  std::vector<std::string> assumptions;  // what the reader of the files had to assume
  std::vector<std::string> doubts;       // of the readings, before any fit; see CheckReadings
  std::vector<std::string> warnings;     // these doubts among them
  double seconds = 0;
  bool interrupted = false;
};

}  // namespace lyrefit
