// Translation of curves to conditions at which the true curve is known, by every procedure.
// Compares the errors with the stated uncertainties.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/prepare.h"
#include "lyrefit/translate/recommend.h"

namespace shown {

// A prepared curve, with the key points at its own conditions and their noise.
struct Sweep {
  lyrefit::Preparation made;
  lyrefit::KeyPoints key;
  lyrefit::KeyPointNoise noise;
};

// Expanded uncertainties (k = 2) of the conditions and coefficients of a set.
struct Conditions {
  double light_percent = 0;
  double temperature_K = 0;
  double beta_percent = 5;  // below 0: beta is not stated
  double alpha_percent = 20;
  double epsilon_percent = lyrefit::UncertaintyOptions().epsilon_percent;
};

// Result of one procedure for one sweep and target. `error` and the uncertainties are relative, of
// Pmax.
struct Carried {
  // Relative errors and expanded uncertainties (k = 2) of Isc, Voc, Imp, Vmp, Pmax and FF.
  std::array<double, 6> errors{};
  std::array<double, 6> expandeds{};
  lyrefit::Procedure procedure = lyrefit::Procedure::kIec1;
  bool recommended = false;
  double error = 0;
  double expanded = 0;      // k = 2, from all sources
  double of_procedure = 0;  // k = 2, of the procedure itself; `expanded` includes it
  double folds = 0;         // |ln(G2 / G1)|
  double heat = 0;          // |T2 - T1| / 10 K
  int from = 0;
  int to = 0;
};

// Preparation options of all sweeps of a set. `diagnosed`: compute all procedures, with the
// diagnosis.
lyrefit::TranslateOptions ReadyOptions(bool diagnosed);

// Prepares the curves in parallel. Curves that cannot be prepared are left out, with a message on
// standard error.
std::vector<Sweep> MakeReady(const std::vector<lyrefit::IvCurve>& curves,
                             const lyrefit::TranslateOptions& options, int threads);

// Translates a sweep to a target with known key points `truth`, by every procedure.
std::vector<Carried> CarryOne(const Sweep& from, const lyrefit::TranslationTarget& target,
                              const lyrefit::KeyPoints& truth, const Conditions& at);

struct Pairing {
  int pairs = 1500;
  unsigned seed = 1;
  int threads = 0;
  // One flag per sweep: whether a pair may contain it. Empty: all.
  std::vector<bool> allowed;
};

// Draws random pairs and translates the first sweep to the conditions of the second. `at` states
// the combined uncertainty of the conditions of both sweeps.
std::vector<Carried> CarryPairs(const std::vector<Sweep>& sweeps, const Conditions& at,
                                const Pairing& how);

struct Tally {
  int count = 0;
  double bias = 0;
  double rms = 0;
  double expanded = 0;   // mean
  double within = 0;     // fraction of errors within U
  double within_se = 0;  // standard error, by a jackknife over tenths of the sweeps
};

Tally TallyOf(const std::vector<Carried>& all, std::optional<lyrefit::Procedure> procedure,
              bool recommended);

// Uncertainty of the procedure itself in Pmax, relative, k = 2: per e-fold of light and per 10 K.
// WithSizes returns the results with these values instead.
struct Sizes {
  double light = 0;
  double temperature = 0;
};
std::vector<Carried> WithSizes(const std::vector<Carried>& all, const Sizes& sizes);

// Maximum-likelihood values for the errors of one procedure. The errors are normal; the variance of
// the procedure is proportional to the step.
Sizes FittedSizes(const std::vector<Carried>& all, lyrefit::Procedure procedure);

// Prints a Markdown table: one row per procedure, then the recommended ones.
void PrintTable(const std::vector<Carried>& all);

// Prints a Markdown table of how many values of Isc, Voc and Pmax lie within U, and of the mean U.
// Limits are exact at 95 % (Clopper and Pearson 1934). One row per procedure, then the recommended
// ones.
void PrintHeld(const std::vector<Carried>& all);

}  // namespace shown
