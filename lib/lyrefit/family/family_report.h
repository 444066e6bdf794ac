// Experimental: may change in a minor version (data/stable).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/refine/error_terms.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// A value with its standard error and 95 % interval; NaN if unknown.
struct Interval {
  double value = kUnknown;  // the estimate
  double standard_error = kUnknown;
  double low_95 = kUnknown;
  double high_95 = kUnknown;
};

// Use of a curve in a family fit.
enum class CurveRole {
  kFitted,
  kHeldOut,  // not fitted, only tested
  kLeftOut,  // neither fitted nor tested: see `reason`
};

template <>
struct EnumTable<CurveRole> {
  static constexpr EnumText<CurveRole> kRows[] = {{CurveRole::kFitted, "fitted"},
                                                  {CurveRole::kHeldOut, "held-out"},
                                                  {CurveRole::kLeftOut, "left-out"}};
};

// Key points of one curve that were fitted, beside those of the model.
struct KeyPointFit {
  KeyPoints measured;  // NaN: not stated
  KeyPoints model;     // under the shared parameters
  // Pmp by a fit that did not see this curve, and the 95 % interval in which a measurement is
  // expected: of that fit and of the errors of the key points. NaN: not tested.
  Interval held_out_power_W;
};

// Results of one curve under the joint parameters.
struct FamilyCurve {
  std::string id;
  CurveRole role = CurveRole::kFitted;  // use of the curve
  std::string reason;                   // reason of kLeftOut
  std::size_t points = 0;
  double irradiance_W_m2 = 0;  // as stated; a start value if not stated
  double temperature_C = 0;
  bool irradiance_known = true;   // stated in the data
  bool temperature_known = true;  // stated in the data
  // Offsets of the stated values, fitted for this curve alone; all NaN without such unknowns.
  Interval irradiance_offset_W_m2;
  Interval temperature_offset_K;
  double short_circuit_current_A = kUnknown;  // measured
  // Parameters of the translated device without effects; n is at the curve's temperature.
  std::vector<double> parameters;
  RmsePair rmse;
  double mean_residual_A = kUnknown;  // solved-current
  std::vector<double> residual_A;     // model - measured, solved-current
  // An individual fit of this curve with the same number of diodes: its parameters, estimates,
  // error model and RMSE.
  std::vector<double> individual_parameters;   // empty: no individual fit
  std::vector<Estimate> individual_estimates;  // with intervals; empty: not requested
  // `individual_estimates` with intervals under correlated errors, as the residuals show them.
  // Empty if the errors are taken as independent or the fit was weighted by them.
  std::vector<Estimate> individual_under_errors;
  std::optional<ErrorReport> free_errors;
  RmsePair individual_rmse;
  // Isc and Voc of the individual fit less those of the shared parameters: errors of the stated
  // conditions.
  double isc_excess = kUnknown;  // relative
  double voc_excess_V = kUnknown;
  std::optional<KeyPointFit> key_points;  // if the residuals are those of key points
  bool outlier = false;  // does not belong to the device of the others, or has a wrong key point
};

// Root mean squares of model / measured - 1 over the fitted curves of a joint fit of key points.
struct KeyPointSummary {
  KeyPointErrors errors;                    // that weighed the residuals
  std::optional<KeyPointErrors> found;      // as the residuals show them; none: no intervals
  double scale = 0;                         // residual standard deviation in units of these errors
  double short_circuit_current = kUnknown;  // of Isc
  double open_circuit_voltage = kUnknown;   // of Voc
  double max_power_current = kUnknown;      // of Imp
  double max_power_voltage = kUnknown;      // of Vmp
  double max_power = kUnknown;              // of Pmp
  // Pmp at 1000 W/m2 and 25 C: measured, or of the model if no such condition was measured.
  double reference_power_W = kUnknown;
  double max_power_of_reference = kUnknown;           // rms error of Pmp as a part of that
  double held_out_max_power_of_reference = kUnknown;  // of curves that the fit did not see
  int held_out = 0;                                   // curves that were tested so
  int covered = 0;                                    // of these, measured Pmp inside the interval
};

// Another device of the law that the curves allow as well.
struct EqualDevice {
  std::vector<double> shared;  // in the translation's order, in reporting units
  double rise = 0;             // of the sum of squares, as a part of what a 95 % interval allows
  double reference_power_W = kUnknown;  // at 1000 W/m2 and 25 C
  double low_light_power_W = kUnknown;  // at 200 W/m2 and 25 C
  double hot_power_W = kUnknown;        // at 1000 W/m2 and 75 C
};

// Devices that fit as well as the best one, over a parameter that the curves do not determine.
struct EqualDevices {
  std::string along;                 // symbol of that parameter
  std::vector<EqualDevice> devices;  // by its rising value
};

// Prediction errors on whole curves that were not fitted.
struct HeldOut {
  std::string how;                  // "548 curves not fitted", "5 folds of whole curves"
  int curves = 0;                   // number of curves tested
  RmsePair rmse;                    // over all points
  double median_rmse_A = kUnknown;  // of the curves, solved-current
  double largest_rmse_A = kUnknown;
  std::string largest_id;                      // id of the curve with largest_rmse_A
  std::vector<double> curve_rmse_A;            // of every curve tested, solved-current
  double median_individual_rmse_A = kUnknown;  // of individual fits of these curves: the floor
};

// Test of parameters from another source, on the tested curves at their stated conditions.
struct Against {
  std::string name;  // file name
  std::string law;   // "De Soto", "PVsyst"
  HeldOut result;
};

// Results of one law, for comparison with other laws.
struct FamilyCandidate {
  TranslationLaw law = TranslationLaw::kDeSoto;
  Model model = Model::kSingleDiode;
  RmsePair rmse;
  double held_out_median_A = kUnknown;
  double held_out_rmse_A = kUnknown;  // solved-current
  // Excess of the held-out mean square over that of the best law, in standard errors of the
  // difference over curves. Below 1 the curves do not distinguish the two laws.
  double behind_best = kUnknown;
  int free_parameters = 0;  // of the joint fit
  bool chosen = false;      // the report is of this law
};

// A stated key point that the others contradict.
struct OutlierCell {
  std::string id;              // of the condition
  std::string point;           // "Isc", "Voc", "Imp" or "Vmp"
  std::string unit;            // "A" or "V"
  double measured = kUnknown;  // in that unit
  double expected = kUnknown;  // by the fit without it
};

// The joint fit without the curves that appear to belong to another device, or of key points
// without the cells that look wrong.
struct WithoutOutliers {
  std::vector<std::string> ids;    // the curves that were left out, or that have such a cell
  std::vector<OutlierCell> cells;  // of key points
  RmsePair rmse;
  std::vector<double> shared;  // refitted, in the translation's order
};

// A temperature coefficient of the device at the reference, computed from the fitted model.
struct Coefficient {
  std::string name;  // "alpha_isc", "beta_voc", "gamma_pmp"
  std::string unit;  // "A/K", "V/K", "%/K"
  Interval value;
};

// Data whose likelihood selected the kind of errors.
enum class FamilyErrorJudge {
  kFitted,   // the curves that gave the error sizes
  kHalves,   // each half of the curves, with error sizes of the other half
  kHeldOut,  // curves that were not fitted
};

template <>
struct EnumTable<FamilyErrorJudge> {
  static constexpr EnumText<FamilyErrorJudge> kRows[] = {{FamilyErrorJudge::kFitted, "fitted"},
                                                         {FamilyErrorJudge::kHalves, "halves"},
                                                         {FamilyErrorJudge::kHeldOut, "held out"}};
};

// Sizes of the errors of a family's readings, and their correlation.
struct FamilyErrors {
  FamilyErrorKind kind = FamilyErrorKind::kIndependent;
  FamilyErrorSizes sizes;  // path at the largest irradiance of the curves used
  double path_power = 1;   // path error grows with this power of the irradiance
  FamilyErrorJudge judge = FamilyErrorJudge::kFitted;
  int tested_curves = 0;  // curves tested with the error sizes of others; 0: none
  double gain = 0;        // twice the gain in ln likelihood over independent errors
};

// Parameters, intervals and figures of a joint fit at its end.
struct JudgedFamily {
  // Shared parameters in the translation's order; those of effects are in internal units.
  std::vector<double> refined;
  Interval irradiance_offset_W_m2;  // of the sensor, common to all curves; NaN if not requested
  Interval temperature_offset_K;
  std::vector<Coefficient> coefficients;
  KeyPoints reference;        // of the model at 1000 W/m2 and 25 C
  double noise_A = kUnknown;  // residual standard deviation (weighted, scaled to ampere)
};

// Tests of a joint fit on whole curves.
struct FamilyTests {
  std::optional<HeldOut> held_out;
  std::vector<Against> against;  // on the curves of `held_out`, or on the fitted ones without it
  // Of the residuals of key points: Pmp of curves that a fit did not see, by position in the set.
  std::vector<std::pair<int, Interval>> held_out_power_W;
  // Joint fit on the fitted curves, for comparison with `against` if there is no `held_out`.
  std::optional<HeldOut> in_sample;
};

// Errors of the readings, and shared intervals under them if they are correlated.
struct FamilyErrorIntervals {
  std::optional<FamilyErrors> errors;
  std::vector<Interval> under_errors;  // empty if the errors are independent
};

// All results of a joint fit of many curves. Estimates are those of the shared parameters, in the
// translation's order; RMSEs are those over all points, of random points and the search on the
// curves of the search, of the others on all fitted curves. The warnings include the doubts.
struct FamilyReport : EstimateReport, JudgedFamily, FamilyTests, FamilyErrorIntervals {
  std::string name;    // of the set
  std::string source;  // file or folder that the set was read from
  bool free = false;   // individual fits of every curve, no shared parameters
  Translation translation;
  Objective objective = Objective::kSolvedCurrent;
  int cells_in_series = 1;
  // As `refined`. All other fields are in reporting units.
  std::vector<double> searched;
  std::vector<double> refined_best_candidate;  // in reporting units; empty: not requested
  RmsePair searched_all;                       // the searched parameters on all fitted curves
  // Root mean square of the residuals of key points on all fitted curves, in units of their errors
  // (KeyPointErrors). NaN: not fitted.
  double searched_key_points = kUnknown;
  double refined_key_points = kUnknown;
  std::vector<FamilyCurve> curves;            // in the set's order
  std::vector<std::string> search_ids;        // curves of the search
  std::optional<KeyPointSummary> key_points;  // if the residuals are those of key points
  std::optional<EqualDevices> equal_devices;  // none: the curves determine the parameters
  std::optional<WithoutOutliers> without_outliers;
  std::vector<FamilyCandidate> candidates;  // of FitFamilyAuto
  // The weights of the curves in the residuals.
  FamilyWeights weights = FamilyWeights::kEqual;
  // Twice the gain in ln likelihood of weights relative to Isc over equal weights. None: no
  // selection was made; NaN: the residuals exceed noise.
  std::optional<double> weights_gain;
  // Shared intervals if whole curves, not points, are independent (delete-one-curve jackknife). In
  // the order of `estimates`; empty if not computed.
  std::vector<Interval> jackknife;
  double seconds = 0;
  double individual_seconds = 0;    // of the individual fits
  double plain_seconds = kUnknown;  // of the best candidate's plain solve
  // Effects added to the diodes, and the curves that they were evaluated on.
  std::vector<EffectUse> with;
  std::shared_ptr<const CurveSet> taken;  // none: no effects
  std::vector<RejectedCurve> rejected;    // files or curves that could not be read
  std::vector<std::string> assumptions;   // assumptions of the reader
  std::vector<std::string> doubts;        // about the readings, before any fit; see CheckReadings
};

}  // namespace lyrefit
