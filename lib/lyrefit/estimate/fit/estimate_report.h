#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
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

// What an estimate says of a model and a measurement, whatever these are: a curve, a family of
// curves, two junctions, the measurements of a cell.
struct EstimateReport {
  std::string version;                    // of lyrefit
  std::vector<Estimate> estimates;        // in reporting units
  std::vector<Correlation> correlations;  // |value| > 0.9, strongest first
  RmseTable rmse;                         // RMSEs of search and polish
  SearchOptions search_options;           // options of the search
  SearchSummary search;                   // result of the search
  // Evaluations of all readings by the search: those of its candidates, and of a curve with
  // Algorithm::kMloShape those that rank the points it begins with.
  std::int64_t curve_evaluations = 0;
  RefineReport refine;               // starts and end of the polish
  double interval_seconds = 0;       // for profiles and intervals
  InformationCriteria criteria;      // of the parameters
  bool usable = true;                // finite and near the readings; see WhyNotUsable
  std::string not_usable_because;    // empty: usable
  std::string no_intervals_because;  // empty: present, or not requested
  std::vector<OptionEcho> non_default_options;
  std::vector<std::string> warnings;  // sentences
  bool interrupted = false;
};

}  // namespace lyrefit
