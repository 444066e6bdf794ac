// Curves whose conditions and whose curve under other conditions are both known, carried from one
// to the other by every procedure: how far off each is, and how far off it says it may be.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/prepare.h"
#include "lyrefit/translate/recommend.h"

namespace shown {

// A curve made ready, and what it is known to give where it was taken.
struct Sweep {
  lyrefit::Preparation made;
  lyrefit::KeyPoints key;
  lyrefit::KeyPointNoise noise;
};

// How sure the conditions of a set are, expanded (k = 2).
struct Conditions {
  double light_percent = 0;
  double temperature_K = 0;
  double beta_percent = 5;  // below 0: as where nobody stated beta
  double alpha_percent = 20;
  double epsilon_percent = lyrefit::UncertaintyOptions().epsilon_percent;
};

// One procedure from one sweep to one place. Of Pmax, in parts.
struct Carried {
  // Of Isc, Voc, Imp, Vmp, Pmax, FF: errors and expanded uncertainties (k = 2), in parts.
  std::array<double, 6> errors{};
  std::array<double, 6> expandeds{};
  lyrefit::Procedure procedure = lyrefit::Procedure::kIec1;
  bool recommended = false;
  double error = 0;
  double expanded = 0;      // k = 2, of everything
  double of_procedure = 0;  // k = 2, of the procedure itself: in `expanded` too
  double folds = 0;         // |ln(G2 / G1)|
  double heat = 0;          // |T2 - T1| / 10 K
  int from = 0;
  int to = 0;
};

// The options that all sweeps of a set are made ready with: no diagnosis unless asked for.
lyrefit::TranslateOptions ReadyOptions(bool diagnosed);

// In parallel; those that cannot be made ready are left out.
std::vector<Sweep> MakeReady(const std::vector<lyrefit::IvCurve>& curves,
                             const lyrefit::TranslateOptions& options, int threads);

// One sweep to one place of which the truth is known. `light_too`: the light is doubted on both
// ends, as where both were measured.
std::vector<Carried> CarryOne(const Sweep& from, const lyrefit::TranslationTarget& target,
                              const lyrefit::KeyPoints& truth, const Conditions& at);

struct Pairing {
  int pairs = 1500;
  unsigned seed = 1;
  int threads = 0;
  // Both ends must be in it; empty: all.
  std::vector<bool> allowed;
};

// Pairs drawn at random, each carried from the first to the second. Sizes of light and temperature
// are of both ends together.
std::vector<Carried> CarryPairs(const std::vector<Sweep>& sweeps, const Conditions& at,
                                const Pairing& how);

struct Tally {
  int count = 0;
  double bias = 0;
  double rms = 0;
  double expanded = 0;   // mean
  double within = 0;     // part of the errors
  double within_se = 0;  // standard error, by leaving out a tenth of the sweeps at a time
};

Tally TallyOf(const std::vector<Carried>& all, std::optional<lyrefit::Procedure> procedure,
              bool recommended);

// The same with another size of the procedure's own error, per e-fold and per 10 K (k = 2, parts).
struct Sizes {
  double light = 0;
  double temperature = 0;
};
std::vector<Carried> WithSizes(const std::vector<Carried>& all, const Sizes& sizes);

// The sizes that make the errors of one procedure likeliest: normal, variances in proportion to the
// step.
Sizes FittedSizes(const std::vector<Carried>& all, lyrefit::Procedure procedure);

// Markdown: a row a procedure, the recommended ones last.
void PrintTable(const std::vector<Carried>& all);

// Markdown: how many of Isc, Voc and Pmax lie within U, with exact 95 % limits (Clopper and Pearson
// 1934), and the mean of U; a row a procedure, the recommended ones last.
void PrintHeld(const std::vector<Carried>& all);

}  // namespace shown
