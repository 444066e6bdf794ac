#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/plan.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/law/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Everything in a diagnosis is of the solved-current objective, r = I_model(V) - I_measured, but the
// proofs that say otherwise.

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

// One curve of a diagnosis.
struct DiagnosedCurve {
  std::string name;  // the curve's
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
  bool dark = false;  // taken without light
  int points = 0;
};

// Something seen in the values or the base model's residuals, before any cause is thought of.
struct Finding {
  std::string id;        // "clipping", "grid", "runs", "autocorrelation", "bound", "n_below_1", ...
  std::string sentence;  // with its figures
  std::vector<int> points;  // positions in Diagnosis::points it is about; may be empty
};

// What the readings say before any cause is tried.
struct Evidence {
  std::string kind;             // "one sweep from 0 V to beyond Voc", in words
  double noise_constant_A = 0;  // standard deviation, constant part (lit curves)
  double noise_relative = 0;    // part of |current|
  double noise_voltage_V = 0;   // of the voltage readings, where the data insist on it
  double noise_dark_A = 0;      // constant part of dark curves; 0 without
  double noise_stated_A = 0;    // median of what is stated and believed instead; 0: nothing is
  double noise_path_A = 0;      // of a rough path along the sweep that readings share; 0 without
  double misfit_ratio = 0;  // base residual's standard deviation / noise's from second differences
  double autocorrelation = 0;          // lag 1, of the noise (smooth misfit removed)
  double grid_step_A = 0;              // greatest common step of the currents; 0: none seen
  double grid_step_V = 0;              // the same of the voltages
  int clipped_points = 0;              // readings at a limit of the instrument
  double clip_level_A = 0;             // that limit; 0 without such readings
  ResidualStatistics residuals;        // of the base model
  double whiteness_p_value = 1;        // portmanteau of the base residuals
  double whiteness_after_p_value = 1;  // of the extended model's
  std::vector<Finding> findings;
};

// A parameter of an effect as it was fitted.
struct CauseParameter {
  std::string symbol;
  std::string name;  // as code and JSON spell it
  std::string unit;
  double value = kUnknown;  // in `unit`
  double low_95 = kUnknown;
  double high_95 = kUnknown;
  bool at_bound = false;
};

// What became of one effect of the catalogue.
struct Trial {
  std::string effect;  // its id
  std::string title;
  bool tried = false;             // false: these data cannot show it
  std::string why_not;            // where it was not
  double rmse_A = kUnknown;       // base model with this one effect
  double misfit = kUnknown;       // norm of what it takes away, in noise units
  double p_value = kUnknown;      // all of the effect's probes counted
  double corrected_p = kUnknown;  // the whole catalogue counted
  double delta_aicc = kUnknown;   // with the effect minus without: negative is better
  double held_out_rmse_A = kUnknown;
  double kept = kUnknown;  // part of the effect's signature the base model cannot absorb
  std::vector<CauseParameter> parameters;  // as fitted beside the base model
};

// A size with its 95 % interval.
struct Sized {
  double value = kUnknown;  // in the unit that its field says
  double low_95 = kUnknown;
  double high_95 = kUnknown;
};

// An effect that explains what the base model gets wrong.
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
  double corrected_p = kUnknown;          // p-value of the effect, the whole catalogue counted
  std::string evidence;                   // "fit" or "values"
  std::string acts;                       // where on the curve, in words
  std::vector<int> points;                // where it acts most: positions in Diagnosis::points
};

// An effect that may be there unseen, since these data cannot show it.
struct CannotBeExcluded {
  std::string id;
  std::string biases;  // symbols
  std::string sentence;
  std::string separate_by;
};

// What the diagnosis comes to.
struct Verdict {
  bool found = false;  // at least one cause is named
  // Something is there that no known cause fits; without a cause, the base model misses the data by
  // more than it misses modules without a fault.
  bool unexplained = false;
  std::vector<Cause> causes;  // the most certain first
  // There beyond doubt, but too small to act on.
  std::vector<Cause> below_floor;
  Sized lack_of_fit;  // of the data from the base model beyond noise, rms in parts of Isc
  std::vector<CannotBeExcluded> cannot_be_excluded;  // what the data cannot show
  std::string sentence;
};

// How the base model's parameters and the maximum power move when the causes are allowed for.
struct ParameterShift {
  std::string symbol;
  std::string name;  // as code and JSON spell it
  std::string unit;
  double before = kUnknown;          // of the base model
  double after = kUnknown;           // with the causes allowed for
  double standard_error = kUnknown;  // of `after`
};

// What the model wins by allowing for the causes, on readings that were not fitted too.
struct Gain {
  double rmse_before_A = kUnknown;
  double rmse_after_A = kUnknown;
  double held_out_before_A = kUnknown;  // whole blocks or curves left out, selection repeated
  double held_out_after_A = kUnknown;
  double held_out_gain_A2 = kUnknown;        // mean difference of squares over the blocks
  double held_out_gain_error_A2 = kUnknown;  // its standard error
  bool gain = false;                         // more than its standard error
  int folds = 0;                             // parts that were left out in turn
  bool by_sweeps = false;                    // what was held out were whole sweeps
  std::string sentence;
  std::vector<ParameterShift> shifts;
};

// How much of what the base model misses a cause can explain, proved. All its figures are of one
// objective and of the readings that the diagnosis fitted, unweighted.
struct CauseProof {
  std::string effect;  // its id
  std::string title;
  bool named = false;  // it is the verdict's, or part of it
  Objective objective = Objective::kMeasuredCurrent;
  double base_A = kUnknown;  // RMSE that the base model attains
  double lower_bound_A =
      kUnknown;                  // proved: none with the cause, whatever its parameters, is lower
  double upper_bound_A = kUnknown;  // with the cause, by a fit
  double explains_at_most = kUnknown;  // part of the base model's sum of squares
  std::string holds_for;               // which models the bound holds for, in words
};

// Of several causes, or why there are none.
struct Proofs {
  std::vector<CauseProof> causes;  // within one objective those that can explain most first
  std::string sentence;
};

// What a diagnosis found, with all that it rests on.
struct Diagnosis {
  std::string version;        // of lyrefit
  std::string name;           // the curve's, or the set's
  std::string source;         // the file it was read from
  std::string base;           // "sd" or "dd"
  std::string base_sentence;  // what the base model assumes
  std::uint64_t seed = 0;
  double level = 0.05;       // of significance: a cause has a smaller corrected p-value
  double floor_current = 0;  // smallest effect that is named, rms in parts of Isc
  double floor_power = 0;    // or in parts of Pmax
  int cells_in_series = 1;
  std::vector<DiagnosedCurve> curves;  // in the set's order
  std::vector<DiagnosedPoint> points;
  Evidence evidence;             // before any cause was tried
  std::vector<Trial> trials;     // in the order of the catalogue
  Verdict verdict;               // what it comes to
  Gain gain;                     // what the causes are worth
  std::optional<Plan> plan;      // where it was asked for
  std::optional<Proofs> proofs;  // the same
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
