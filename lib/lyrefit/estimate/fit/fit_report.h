#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/refine/error_terms.h"
#include "lyrefit/estimate/refine/estimate.h"
#include "lyrefit/model/device.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// Root mean square errors (RMSE) of one parameter vector, in ampere, by both definitions.
// Measured-current: of the measured current inserted into the right-hand side of the diode
// equation. Solved-current: of the current that solves the equation.
struct RmsePair {
  double measured_current_A = kUnknown;
  double solved_current_A = kUnknown;
  // The RMSE of one objective, in ampere.
  double Of(Objective objective) const {
    return objective == Objective::kMeasuredCurrent ? measured_current_A : solved_current_A;
  }
};

// RMSEs at the stages of one fit.
struct RmseTable {
  RmsePair random_baseline;  // best of as many uniform random points as the search evaluated
  RmsePair searched;         // best candidate of the search, not polished
  RmsePair plain_polished;   // best candidate after one bounded solve (FitOptions::plain_polish)
  // Best candidate after its own polish. With effects this polish ends early where another start is
  // better, unless FitOptions::plain_polish is set.
  RmsePair refined_best_candidate;
  RmsePair refined;  // best end of all starts
};

// Largest (rmse - lower bound) / rmse that counts as a proof.
constexpr double kCertifiedGap = 1e-9;

// Lowest RMSE (unweighted) of any number of diodes in parallel, with n, Rs, Iph and Rsh within the
// bounds of the fit (see certify/certify.h).
struct FloorReport {
  Objective objective = Objective::kSolvedCurrent;  // objective of the fit
  double rmse_A = kUnknown;                         // upper bound, reached by a set of diodes
  double lower_bound_A = kUnknown;                  // proved lower bound; 0: none proved
  double gap = kUnknown;                            // (rmse - lower bound) / rmse
  double n_lower = kUnknown;                        // allowed range of n: lower end
  double n_upper = kUnknown;                        // and upper end
  double above = kUnknown;                          // refined RMSE / rmse_A - 1; 0: within rounding
  // Whether the fit minimises this RMSE. False for weighted residuals and for robust losses.
  bool minimised = true;
};

// One start of the polish and its end. Starts whose descents reach the same curve, within a
// thousandth of its RMSE, are polished once and share that end.
struct StartReport {
  std::string origin;  // "best candidate", "elite 2", "grid n = 1.25, 2; Rs = 0.036 ohm", ...
  double start_rmse_A = kUnknown;  // RMSEs of the fitted objective
  double end_rmse_A = kUnknown;
  bool agrees = false;  // its end is the best one or within 1e-9 (relative) of it
};

// Local optima of one polish: how many the finished starts reached, and an estimate of the number
// not found. A start near an earlier end (one cell more, the next setting) returns to its local
// optimum more often than an independent one, so the estimate leaves it out.
struct OptimumCount {
  int ends = 0;  // starts that reached a local optimum
  int local_optima = 0;
  int best_visits = 0;  // ends in the best local optimum
  struct Independent {  // counts of the starts that were not near an earlier end
    int ends = 0;       // starts that reached a local optimum
    int local_optima = 0;
    int best_visits = 0;  // ends in the best local optimum
    int once = 0;         // local optima with one end
    int twice = 0;        // local optima with two ends
  };
  Independent independent;  // starts that were not near an earlier end
  // Estimate of the local optima not found: Chao's lower estimate, bias-corrected, once (once - 1)
  // / (2 (twice + 1)), doi:10.2307/2531532. NaN where `independent` has fewer than three ends.
  double unseen = kUnknown;
};

// Best fit of one model variant of the effects (model/variants.h).
struct VariantReport {
  std::string what;          // "d, Vb, m, A free; chains = 2"
  int free = 0;              // free parameters of the effects
  double rmse_A = kUnknown;  // solved-current
  double bic_above = 0;      // BIC minus the BIC of the chosen variant
  bool finished = false;     // false: stopped early; its figures are upper limits
  bool chosen = false;       // the reported fit has this variant
};

// Course and diagnostics of the polish.
struct RefineReport {
  std::string termination = "not run";  // "converged", "no convergence", "interrupted", "not run"
  std::string message;
  std::vector<StartReport> starts;  // in order; the polish stops after enough agree
  int winner = -1;                  // index into starts
  int agreeing = 0;                 // starts for which `agrees` holds
  // Largest cosine between the residual and a column of the Jacobian whose parameter is free to
  // move downhill: 0 at an exact optimum, at most 1.
  double projected_gradient = kUnknown;
  double condition = kUnknown;  // condition number of the scaled Jacobian, free parameters
  double seconds = 0;
  double best_candidate_seconds = kUnknown;  // plain_polish: full polish of the best candidate
  std::optional<OptimumCount> local_optima;  // only with effects
};

// Information criteria of the fit. Lower is better; compare fits of the same readings only.
struct InformationCriteria {
  int points = 0;
  int parameters = 0;  // free ones; the criteria also count the noise variance
  double aicc = kUnknown;
  double bic = kUnknown;
};

// Statistics of the residuals, to detect systematic misfit.
struct ResidualStatistics {
  double largest_A = kUnknown;  // largest |model - measured|, solved-current
  double largest_at_V = kUnknown;
  double mean_A = kUnknown;
  int runs = 0;                     // sequences of one sign, in order of voltage
  double expected_runs = kUnknown;  // for as many residuals in random order
  double runs_p_value = kUnknown;   // two-sided, Wald-Wolfowitz
  double durbin_watson = kUnknown;  // 2 for independent residuals, near 0 for a misfit
};

// Figures of one candidate model of FitAuto().
struct CandidateReport {
  Model model = Model::kSingleDiode;
  double rmse_A = kUnknown;           // refined, of the fitted objective
  double held_out_rmse_A = kUnknown;  // cross-validated over contiguous blocks, same objective
  double aicc = kUnknown;
  double f_p_value = kUnknown;  // F-test against the next simpler model
  bool identifiable = true;     // false: the data allow a diode to be absent
};

// Choice of FitAuto() among one, two and three diodes, with its reasons.
struct ModelChoice {
  Model chosen = Model::kSingleDiode;
  std::vector<CandidateReport> candidates;  // SD, DD, TD
  std::string sentence;
};

// What the believed intervals take the errors of the readings for.
enum class ErrorsTaken {
  kEqual,    // independent, of one size
  kUnequal,  // independent, of sizes that differ: noise of the voltage, or in proportion to current
  kPath,     // these, and a path that neighbours share
};

template <>
struct EnumTable<ErrorsTaken> {
  static constexpr EnumText<ErrorsTaken> kRows[] = {{ErrorsTaken::kEqual, "equal"},
                                                    {ErrorsTaken::kUnequal, "unequal"},
                                                    {ErrorsTaken::kPath, "path"}};
};

// Sizes of the errors of the readings, estimated from the residuals or stated.
struct ErrorReport {
  ErrorSizes sizes;
  double voltage_effect_A = kUnknown;  // largest effect of the voltage noise on one current
  double part_effect_A = kUnknown;     // the same of the error in proportion to the current
  bool stated = false;                 // stated in the options, not estimated
  bool current_stated = false;         // current_A is the sigma_A of the readings
  double gain = kUnknown;              // see FoundErrors; NaN if stated
  double path_gain = kUnknown;         // of the path alone; NaN if it was not tested
  bool weighed = false;                // the polish used them as weights
  // Whether the gain over independent errors of one size is significant. Intervals under these errors are then
  // the ones to use.
  bool believed = false;
  RmsePair least_squares;  // if weighed: RMSE of the least-squares fit

  // What the believed intervals take the errors for.
  ErrorsTaken Taken() const {
    if (!believed) return ErrorsTaken::kEqual;
    return sizes.path > 0 ? ErrorsTaken::kPath : ErrorsTaken::kUnequal;
  }
};

// Covariance of the parameters of a fit, for intervals of what is computed from them.
struct FitCovariance {
  // One row and column for each parameter, in the order of the device and in reporting units. NaN
  // for parameters without a standard error (at a bound, fixed or not determined).
  std::vector<std::vector<double>> values;
  double t_95 = kUnknown;  // quantile of Student's t of a 95 % interval

  // Whether there are values.
  bool known() const { return !values.empty(); }
};

// Results that follow from the refined parameters. Vectors are of currents in ampere, one value for
// each reading of the curve.
struct ModelResults {
  double nNsVth = kUnknown;             // n Ns Vth of the first diode, in volt; pvlib's nNsVth
  KeyPoints measured;                   // of the readings
  KeyPoints simulated;                  // of the model
  std::vector<double> model_current_A;  // I(V) of the model at the measured voltages
  std::vector<double> residual_A;       // model_current_A - current_A
  InformationCriteria criteria;         // of the parameters
  ResidualStatistics residuals;         // solved-current
  bool usable = true;                   // finite and near the readings; see WhyNotUsable
  std::string not_usable_because;       // empty: usable
};

// Report of a fit of one curve. Vectors of parameters are in the order of `device`.
struct FitReport : ModelResults {
  std::string version;  // of lyrefit
  IvCurve curve;
  Model model = Model::kSingleDiode;
  Objective objective = Objective::kSolvedCurrent;
  ConstantSet constants = ConstantSet::kCodata;
  std::string bounds_name;  // "physical", "paper", "literature", "wide" or the file's name
  // Raised lower bound of n: below it the exponent of a diode would be cut off at a reading. NaN:
  // the bound was not raised.
  double steepest_n = kUnknown;
  Device device;
  std::vector<double> searched;                // best candidate of the search, internal units
  std::vector<double> refined_best_candidate;  // after its own polish; empty: not requested
  std::vector<double> refined;                 // equal to `searched` without a polish
  bool polished = false;
  std::vector<Estimate> estimates;    // in reporting units
  std::optional<ErrorReport> errors;  // none: not requested, or too few readings
  // Estimates with intervals under `errors`, in addition to those that assume independent errors.
  // Empty if `errors` are not believed, or if `estimates` already have such intervals.
  std::vector<Estimate> under_errors;
  // Of `under_errors`, or of `estimates` where that is empty.
  FitCovariance covariance;
  RmseTable rmse;                         // RMSEs of search and polish
  std::optional<FloorReport> floor;       // only if requested
  std::vector<Correlation> correlations;  // |value| > 0.9, strongest first
  SearchOptions search_options;           // options of the search
  SearchSummary search;                   // result of the search
  // Evaluations of the whole curve by the search: those of its candidates, and with
  // Algorithm::kMloShape those that rank the points it begins with.
  std::int64_t curve_evaluations = 0;
  RefineReport refine;
  // Factors on the RMSE for the comparison of model variants by BIC: points ^ ((free parameters -
  // those of the smallest variant) / (2 points)). `variant_penalty` is that of the reported fit,
  // the other that of the best candidate and its own polish. Both are 1 if there is one variant.
  double variant_penalty = 1;
  double best_candidate_penalty = 1;
  std::vector<VariantReport> variants;  // of effects with several; one is chosen
  double interval_seconds = 0;          // for profiles and intervals
  double plain_seconds = kUnknown;      // for the plain solve of the best candidate
  std::string no_intervals_because;     // empty: present, or not requested
  std::optional<ModelChoice> choice;    // only from FitAuto()
  // Of a device with effects: ids of the effects, and number of curves that the model describes
  // under individual conditions. Readers of a stored report need both.
  std::vector<std::string> causes;
  int curves = 1;  // described by one law
  std::vector<OptionEcho> non_default_options;
  std::vector<std::string> doubts;    // about the readings, before any fit; see JudgeReadings
  std::vector<std::string> warnings;  // sentences; include the doubts
  bool interrupted = false;
};

// A file and its fit or error.
struct FittedFile {
  std::string file;            // path as passed
  Expected<FitReport> report;  // the fit, or why there is none
};

}  // namespace lyrefit
