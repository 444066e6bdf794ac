#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/fit/estimate_report.h"
#include "lyrefit/estimate/refine/error_terms.h"
#include "lyrefit/estimate/refine/estimate.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

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

// Best fit of one model variant of the effects (model/variants.h).
struct VariantReport {
  std::string what;          // "d, Vb, m, A free; chains = 2"
  int free = 0;              // free parameters of the effects
  double rmse_A = kUnknown;  // solved-current
  double bic_above = 0;      // BIC minus the BIC of the chosen variant
  bool finished = false;     // false: stopped early; its figures are upper limits
  bool chosen = false;       // the reported fit has this variant
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
  ResidualStatistics residuals;         // solved-current
};

// Report of a fit of one curve. Vectors of parameters are in the order of `device`. The warnings
// include the doubts.
struct FitReport : EstimateReport, ModelResults {
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
  std::optional<ErrorReport> errors;  // none: not requested, or too few readings
  // Estimates with intervals under `errors`, in addition to those that assume independent errors.
  // Empty if `errors` are not believed, or if `estimates` already have such intervals.
  std::vector<Estimate> under_errors;
  // Of `under_errors`, or of `estimates` where that is empty.
  FitCovariance covariance;
  std::optional<FloorReport> floor;  // only if requested
  // Factors on the RMSE for the comparison of model variants by BIC: points ^ ((free parameters -
  // those of the smallest variant) / (2 points)). `variant_penalty` is that of the reported fit,
  // the other that of the best candidate and its own polish. Both are 1 if there is one variant.
  double variant_penalty = 1;
  double best_candidate_penalty = 1;
  std::vector<VariantReport> variants;  // of effects with several; one is chosen
  double plain_seconds = kUnknown;      // for the plain solve of the best candidate
  std::optional<ModelChoice> choice;    // only from FitAuto()
  // Of a device with effects: ids of the effects, and number of curves that the model describes
  // under individual conditions. Readers of a stored report need both.
  std::vector<std::string> causes;
  int curves = 1;                   // described by one law
  std::vector<std::string> doubts;  // about the readings, before any fit; see JudgeReadings
};

// A file and its fit or error.
struct FittedFile {
  std::string file;            // path as passed
  Expected<FitReport> report;  // the fit, or why there is none
};

}  // namespace lyrefit
