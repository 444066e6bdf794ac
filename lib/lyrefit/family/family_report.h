#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/translation.h"
#include "lyrefit/refine/error_terms.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// A value with its standard error and 95 % interval; NaN where not known.
struct Interval {
  double value = kUnknown;  // the estimate
  double standard_error = kUnknown;
  double low_95 = kUnknown;
  double high_95 = kUnknown;
};

// What a curve was used for.
enum class CurveRole {
  kFitted,
  kHeldOut,  // not fitted, only tested
  kLeftOut,  // neither: see `reason`
};

template <>
struct EnumTable<CurveRole> {
  static constexpr EnumText<CurveRole> kRows[] = {{CurveRole::kFitted, "fitted"},
                                                  {CurveRole::kHeldOut, "held-out"},
                                                  {CurveRole::kLeftOut, "left-out"}};
};

// One curve under the joint parameters.
struct FamilyCurve {
  std::string id;
  CurveRole role = CurveRole::kFitted;  // what it was used for
  std::string reason;                   // why left out
  std::size_t points = 0;
  double irradiance_W_m2 = 0;  // as stated (a start where nobody stated it)
  double temperature_C = 0;
  bool irradiance_known = true;   // stated by somebody
  bool temperature_known = true;  // the same
  // What the fit adds to the stated values for this curve alone; all NaN without such unknowns.
  Interval irradiance_offset_W_m2;
  Interval temperature_offset_K;
  double short_circuit_current_A = kUnknown;  // measured
  // Of the translated device, n at its own temperature; without effects.
  std::vector<double> parameters;
  RmsePair rmse;
  double mean_residual_A = kUnknown;  // solved-current
  std::vector<double> residual_A;     // model - measured, solved-current
  // The same curve fitted alone by the same number of diodes, and its solved-current RMSE.
  std::vector<double> free_parameters;   // empty: not done
  std::vector<Estimate> individual_estimates;  // of these, with their intervals; empty: not asked for
  // The same with intervals under the errors its residuals show; empty where those are believed to
  // be independent, or the fit was weighed by them.
  std::vector<Estimate> individual_under_errors;
  std::optional<ErrorReport> free_errors;
  RmsePair individual_rmse;
  // Isc and Voc of that fit beside those of the shared parameters: what the stated conditions miss.
  double isc_excess = kUnknown;  // relative
  double voc_excess_V = kUnknown;
  bool outlier = false;  // does not belong to the device of the others
};

// The errors of a joint fit on its way, over all points of the curves named.
struct FamilyRmseTable {
  RmsePair random_baseline;  // on the curves of the search
  RmsePair searched;         // on the curves of the search
  RmsePair searched_all;     // the same candidate on all fitted curves
  // On all fitted curves that candidate after one bounded solve and after its own joint fit, if asked
  // for.
  RmsePair plain_polished;
  RmsePair refined_best_candidate;
  RmsePair refined;  // on all fitted curves
};

// Errors of whole curves that were not fitted.
struct HeldOut {
  std::string how;                  // "548 curves not fitted", "5 folds of whole curves"
  int curves = 0;                   // how many were tested
  RmsePair rmse;                    // over all points
  double median_rmse_A = kUnknown;  // of the curves, solved-current
  double largest_rmse_A = kUnknown;
  std::string largest_id;                // of the curve with that
  std::vector<double> curve_rmse_A;      // of every curve tested, solved-current
  double median_individual_rmse_A = kUnknown;  // the same curves fitted one by one: the floor
};

// Parameters from elsewhere, tested on the same curves at their stated conditions.
struct Against {
  std::string name;  // of the file
  std::string law;   // "De Soto", "PVsyst"
  HeldOut result;
};

// What one law says, beside others.
struct FamilyCandidate {
  TranslationLaw law = TranslationLaw::kDeSoto;
  Model model = Model::kSingleDiode;
  RmsePair rmse;
  double held_out_median_A = kUnknown;
  double held_out_rmse_A = kUnknown;  // solved-current
  // Held-out mean square beyond that of the best law, in standard errors of the difference from
  // curve to curve: below 1 the curves do not tell the two apart.
  double behind_best = kUnknown;
  int free_parameters = 0;  // of the joint fit
  bool chosen = false;      // the answer has this law
};

// The fit without the curves that look like another device's.
struct WithoutOutliers {
  std::vector<std::string> ids;  // the curves that were left out
  RmsePair rmse;
  std::vector<double> shared;  // parameters of the others, in the translation's order
};

// A temperature coefficient of the device at the reference, from its own model.
struct Coefficient {
  std::string name;  // "alpha_sc", "beta_oc", "gamma_pmp"
  std::string unit;  // "A/K", "V/K", "%/K"
  Interval value;
};

// Whose likelihood chose the kind of errors.
enum class FamilyErrorJudge {
  kFitted,   // that of the curves they were found from
  kHalves,   // each half of the curves, under sizes of the other
  kHeldOut,  // curves that were not fitted
};

template <>
struct EnumTable<FamilyErrorJudge> {
  static constexpr EnumText<FamilyErrorJudge> kRows[] = {{FamilyErrorJudge::kFitted, "fitted"},
                                                         {FamilyErrorJudge::kHalves, "halves"},
                                                         {FamilyErrorJudge::kHeldOut, "held out"}};
};

// How large the errors of a family's readings are and what hangs together in them.
struct FamilyErrors {
  FamilyErrorKind kind = FamilyErrorKind::kIndependent;
  FamilyErrorSizes sizes;  // the path as at the brightest of the curves they were found from
  double path_power = 1;   // of the light that it grows with from curve to curve
  FamilyErrorJudge judge = FamilyErrorJudge::kFitted;
  int tested_curves = 0;  // that chose the kind under sizes of others; 0: none
  double gain = 0;        // twice that in ln likelihood over independent errors
};

// Everything that a joint fit of many curves can say.
struct FamilyReport {
  std::string version;
  std::string name;    // the set's
  std::string source;  // the file or folder it was read from
  bool free = false;   // every curve on its own: no shared parameters
  Translation translation;
  Objective objective = Objective::kSolvedCurrent;
  int cells_in_series = 1;
  // Shared parameters in the translation's order, those of effects in numbers of their own;
  // estimates, jackknife and all else quote them in the units of people.
  std::vector<double> searched;
  std::vector<double> refined;
  std::vector<double> refined_best_candidate;  // in the units of reports; empty: not asked for
  std::vector<Estimate> estimates;         // shared parameters, same order
  Interval irradiance_offset_W_m2;  // of the sensor, common to all curves; NaN where not asked for
  Interval temperature_offset_K;
  std::vector<Coefficient> coefficients;
  KeyPoints reference;                  // of the model at 1000 W/m2 and 25 C
  FamilyRmseTable rmse;                 // of search and joint fit
  double noise_A = kUnknown;            // residual standard deviation (weighted, scaled to ampere)
  std::vector<FamilyCurve> curves;      // in the set's order
  std::vector<std::string> search_ids;  // the curves that the search looked at
  std::optional<HeldOut> held_out;
  std::vector<Against> against;  // on the curves of `held_out`; without it on those fitted
  // The joint fit on the curves it was fitted to, where nothing else stands beside `against`.
  std::optional<HeldOut> in_sample;
  std::optional<WithoutOutliers> without_outliers;
  std::vector<FamilyCandidate> candidates;  // of auto
  std::vector<Correlation> correlations;    // |value| > 0.9 among shared parameters
  // How the curves counted in the residuals.
  FamilyWeights weights = FamilyWeights::kEqual;
  // Twice what the ln likelihood of the residuals gains by weights relative to Isc over equal ones.
  // None: nothing to choose; NaN: the residuals are more than noise.
  std::optional<double> weights_gain;
  // Half width of the shared intervals when whole curves, not points, are taken as independent
  // (delete-one-curve jackknife); in the order of `estimates`, empty where not done.
  std::vector<Interval> jackknife;
  // The same when points are what varies, under the errors found; empty where those are
  // independent.
  std::optional<FamilyErrors> errors;
  std::vector<Interval> under_errors;
  SearchOptions search_options;
  SearchSummary search;
  std::string termination;               // of the joint fit
  double projected_gradient = kUnknown;  // as in RefineReport
  double seconds = 0;
  double individual_seconds = 0;              // of the fits one by one
  double joint_seconds = 0;             // of the joint fit, from all its starts
  double plain_seconds = kUnknown;      // of the best candidate's plain solve
  double best_candidate_seconds = kUnknown;  // and of its own joint fit
  // Effects beside the diodes, and the curves as they were taken, in which they act.
  std::vector<EffectUse> with;
  std::shared_ptr<const CurveSet> taken;  // none: no effects
  std::vector<RejectedCurve> rejected;    // files or curves that could not be read
  std::vector<OptionEcho> non_default_options;
  std::vector<std::string> assumptions;  // what the reader had to assume
  std::vector<std::string> doubts;       // of the readings, before any fit; see CheckReadings
  std::vector<std::string> warnings;     // these doubts among them
  bool interrupted = false;
  bool usable = true;
};

}  // namespace lyrefit
