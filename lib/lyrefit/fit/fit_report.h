#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/law/device.h"
#include "lyrefit/refine/error_terms.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

enum class BoundSide { kNone, kLower, kUpper };  // Which bound a parameter is pressed against.

template <>
struct EnumTable<BoundSide> {
  static constexpr EnumText<BoundSide> kRows[] = {
      {BoundSide::kNone, "none"}, {BoundSide::kLower, "lower"}, {BoundSide::kUpper, "upper"}};
};

// How an interval was found.
enum class IntervalMethod {
  kNone,       // fixed, or not asked for
  kSymmetric,  // estimate -+ t x standard error on the parameter's own scale, cut at the bounds
  kProfile,    // where the refitted sum of squares crosses the F threshold, or a bound
  kUnsettled,  // a profile that did not meet the threshold on a side: its ends lie outside of it
};

template <>
struct EnumTable<IntervalMethod> {
  static constexpr EnumText<IntervalMethod> kRows[] = {
      {IntervalMethod::kNone, "none"},
      {IntervalMethod::kSymmetric, "symmetric"},
      {IntervalMethod::kProfile, "profile"},
      {IntervalMethod::kUnsettled, "unsettled profile"}};
};

// One parameter, searched and refined side by side. NaN: not known (no polish, or no spread to be
// had).
struct Estimate {
  ParameterInfo info;
  ParameterBounds bounds;
  bool fixed = false;
  bool free() const { return !fixed && bounds.whole == 0; }  // a whole number is settled by trying
  double searched = kUnknown;
  double refined = kUnknown;
  double standard_error = kUnknown;
  double low_95 = kUnknown;
  double high_95 = kUnknown;
  IntervalMethod interval = IntervalMethod::kNone;  // how low_95 and high_95 were found
  BoundSide at_bound = BoundSide::kNone;
  bool identifiable = true;
  std::string reason;  // why not identifiable, in plain words
};

// Root mean square errors of one parameter vector, in ampere, each under its label.
struct RmsePair {
  double measured_current_A = kUnknown;
  double solved_current_A = kUnknown;
  // That of one objective, in ampere.
  double Of(Objective objective) const {
    return objective == Objective::kMeasuredCurrent ? measured_current_A : solved_current_A;
  }
};

// The errors of one fit on its way: by search alone, polished, and best of all.
struct RmseTable {
  RmsePair random_baseline;  // best of as many uniform random points as the search evaluated
  RmsePair searched;         // the metaheuristic's best candidate as it is
  RmsePair plain_polished;   // that candidate after one bounded solve in all parameters, if asked for
  // That candidate after its own polish; with effects as far as that was worth it, unless it was asked
  // for (FitOptions::plain_polish).
  RmsePair refined_best_candidate;
  RmsePair refined;  // the best end of all starts
};

// The lowest RMSE (unweighted) that any number of diodes in parallel can reach, n, Rs, Iph and Rsh
// within the bounds of the fit (see certify/certify.h).
struct FloorReport {
  Objective objective = Objective::kSolvedCurrent;  // that of the fit
  double rmse_A = kUnknown;                         // attained by diodes
  double lower_bound_A = kUnknown;                  // proved; 0: nothing is
  double gap = kUnknown;                            // (rmse - lower bound) / rmse
  double n_lower = kUnknown;                        // range of the ideality
  double n_upper = kUnknown;                        // that was allowed
  double above = kUnknown;  // refined RMSE of the same objective / rmse_A - 1; 0: only rounding
  // Whether the fit minimises this RMSE: false where it weighs its residuals, or bends their squares.
  bool minimised = true;
};

// One start of the polish and where it ended. Starts whose descents come to the same curve, to a
// thousandth of its RMSE, are polished once and share that end.
struct StartReport {
  std::string origin;  // "best candidate", "elite 2", "grid n = 1.25, 2; Rs = 0.036 ohm", ...
  double start_rmse_A = kUnknown;  // both of the objective that was fitted
  double end_rmse_A = kUnknown;
  bool agrees = false;  // shares the best end, or its own is within 1e-9 relative of it
};

// Of the starts of one polish that went to their end: in how many local optima, and how many there may be
// besides. A start beside an earlier end (one cell more, the next setting) comes back to its local optimum
// sooner than another, and is in no estimate.
struct OptimumCount {
  int ends = 0;  // starts that came to one
  int local_optima = 0;
  int best_visits = 0;  // ends in the best one
  struct Independent {  // of the starts that were not beside an earlier end
    int ends = 0;       // starts that came to one
    int local_optima = 0;
    int best_visits = 0;  // ends in the best one
    int once = 0;         // local optima with one end
    int twice = 0;        // with two
  };
  Independent independent;  // starts that did not begin beside an earlier end
  // Chao's lower estimate, bias-corrected: once (once - 1) / (2 (twice + 1)),
  // doi:10.2307/2531532; unknown where `independent` has less than three ends.
  double unseen = kUnknown;
};

// The best fit in one of several variants that effects can have (law/variants.h).
struct VariantReport {
  std::string what;          // "d, Vb, m, A free; chains = 2"
  int free = 0;              // parameters of the effects
  double rmse_A = kUnknown;  // solved-current
  double bic_above = 0;      // Bayesian information criterion, above the chosen one's
  bool finished = false;     // false: given up as out of reach; its figures are upper limits
  bool chosen = false;       // the answer has this variant
};

// How the polish went.
struct RefineReport {
  std::string termination = "not run";  // "converged", "no convergence", "interrupted", "not run"
  std::string message;
  std::vector<StartReport> starts;  // in the order tried; enough that agree end the trying
  int winner = -1;                  // index into starts
  int agreeing = 0;                 // starts for which `agrees` holds
  // Largest cosine between the residual and a column of the Jacobian whose parameter is free to
  // move downhill: 0 at an exact optimum, at most 1.
  double projected_gradient = kUnknown;
  double condition = kUnknown;  // of the scaled Jacobian in the free parameters
  double seconds = 0;
  double best_candidate_seconds = kUnknown;  // of the best candidate's own polish, where it was asked for
  std::optional<OptimumCount> local_optima;     // of a model with effects
};

// Two parameters that the data hardly tell apart.
struct Correlation {
  std::string first;   // symbols
  std::string second;  // the other one
  double value = 0;    // -1 to 1
};

// What the fit costs in parameters: lower is better, on the same readings alone.
struct InformationCriteria {
  int points = 0;
  int parameters = 0;  // free ones; the noise variance is counted on top
  double aicc = kUnknown;
  double bic = kUnknown;
};

// Whether the residuals look like noise.
struct ResidualStatistics {
  double largest_A = kUnknown;  // largest |model - measured|, solved-current
  double largest_at_V = kUnknown;
  double mean_A = kUnknown;
  int runs = 0;                     // of one sign, in order of voltage
  double expected_runs = kUnknown;  // of as many residuals in random order
  double runs_p_value = kUnknown;   // two-sided, Wald-Wolfowitz
  double durbin_watson = kUnknown;  // 2 for noise, towards 0 for a misfit
};

// What `auto` says of one candidate.
struct CandidateReport {
  Model model = Model::kSingleDiode;
  double rmse_A = kUnknown;           // refined, of the objective that was fitted
  double held_out_rmse_A = kUnknown;  // contiguous blocks left out in turn, same objective
  double aicc = kUnknown;
  double f_p_value = kUnknown;  // against the next simpler model
  bool identifiable = true;     // no diode may be absent
};

// What `auto` chose among one, two and three diodes, and why.
struct ModelChoice {
  Model chosen = Model::kSingleDiode;
  std::vector<CandidateReport> candidates;  // SD, DD, TD
  std::string sentence;
};

// The errors of the readings as their residuals, or somebody, say they are.
struct ErrorReport {
  ErrorSizes sizes;
  bool stated = false;          // by whoever asked for the fit
  bool current_stated = false;  // current_A is the readings' own sigma_A
  double gain = kUnknown;       // see FoundErrors; NaN where stated
  bool weighed = false;         // the estimates are weighed by them
  // They say clearly more than independent errors: intervals under them are those to believe.
  bool believed = false;
  RmsePair least_squares;  // where weighed: of the fit with the lowest RMSE
};

// Everything that a fit of one curve can say.
struct FitReport {
  std::string version;  // of lyrefit
  IvCurve curve;
  Model model = Model::kSingleDiode;
  Objective objective = Objective::kSolvedCurrent;
  ConstantSet constants = ConstantSet::kCodata;
  std::string bounds_name;  // "physical", "paper", "literature", "wide" or the file's name
  // Where the range of n begins if its bounds begin lower: below, a diode's exponent is cut at a
  // reading. NaN: it begins where they do.
  double steepest_n = kUnknown;
  Device device;
  std::vector<double> searched;            // parameter vectors in the device's order
  std::vector<double> refined_best_candidate;  // after its own polish; empty: not asked for
  std::vector<double> refined;             // equal to `searched` where there was no polish
  bool polished = false;
  std::vector<Estimate> estimates;    // in the device's order
  std::optional<ErrorReport> errors;  // none: not looked for, or too few readings
  // The estimates with intervals under these errors, beside those that take them for independent.
  // Empty where they are not believed, or where `estimates` have them already.
  std::vector<Estimate> under_errors;
  double nNsVth = kUnknown;  // modified ideality of the first diode, in volt, as pvlib wants it
  RmseTable rmse;            // of search and polish
  std::optional<FloorReport> floor;  // where it was asked for
  KeyPoints measured;
  KeyPoints simulated;                    // of the refined model
  std::vector<double> model_current_A;    // I(V) of the refined model at the measured voltages
  std::vector<double> residual_A;         // model_current_A - current_A
  InformationCriteria criteria;           // of the refined parameters
  ResidualStatistics residuals;           // of the refined model, solved-current
  std::vector<Correlation> correlations;  // |value| > 0.9, strongest first
  SearchOptions search_options;           // as the search had them
  SearchSummary search;                   // how the search went
  // Evaluations of the whole curve, with or without derivatives, that the search cost: as many as
  // its own, unless each candidate solves for parameters (FitOptions::candidates).
  std::int64_t curve_evaluations = 0;
  RefineReport refine;
  // What the RMSE is multiplied by where variants are weighed against each other as BIC does it:
  // points ^ (free parameters beyond those of the smallest variant / 2 points). Of the answer, and of
  // the best candidate and its own polish; 1 where there is one variant.
  double variant_penalty = 1;
  double best_candidate_penalty = 1;
  std::vector<VariantReport> variants;      // of effects that have several; one is chosen
  double interval_seconds = 0;        // of profiles and intervals
  double plain_seconds = kUnknown;    // of the best candidate's plain solve
  std::string no_intervals_because;   // empty: they are there, or were not asked for
  std::optional<ModelChoice> choice;  // of `auto`
  // Of an extended model: ids of the effects beside the diodes, and how many curves under
  // conditions of their own it describes. What reads a fit back must know them.
  std::vector<std::string> causes;
  int curves = 1;  // under one law
  std::vector<OptionEcho> non_default_options;
  std::vector<std::string> doubts;    // of the readings, before any fit; see CheckReadings
  std::vector<std::string> warnings;  // plain words, these doubts among them
  bool interrupted = false;
  bool usable = true;              // finite, and near enough to the readings; see WhyNotUsable
  std::string not_usable_because;  // empty: usable
};

// A file and what came of it: its fit, or why there is none.
struct FittedFile {
  std::string file;            // as it was given
  Expected<FitReport> report;  // or why there is none
};

}  // namespace lyrefit
