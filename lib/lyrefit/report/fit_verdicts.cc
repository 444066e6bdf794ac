#include <fmt/format.h>

#include <cmath>

#include "lyrefit/curve/dark.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// Limits for the wording on residuals; no decision depends on them.
constexpr char kTooFew[] = "too few points to say";
constexpr double kSurprising = 0.05;
constexpr double kCertain = 0.01;  // also that of the warning on residuals
constexpr double kDurbinWatsonLow = 1.0;
constexpr double kDurbinWatsonHigh = 3.0;

}  // namespace

std::string ResidualVerdict(const ResidualStatistics& r) {
  if (std::isnan(r.runs_p_value) && std::isnan(r.durbin_watson)) return kTooFew;
  const bool surprising = r.runs_p_value < kSurprising;
  if ((surprising && r.runs < r.expected_runs) || r.durbin_watson < kDurbinWatsonLow) {
    return "neighbouring residuals go together: the curve holds a shape that the model lacks, or "
           "the readings drifted";
  }
  if ((surprising && r.runs > r.expected_runs) || r.durbin_watson > kDurbinWatsonHigh) {
    return "neighbouring residuals alternate more than chance allows: look at the instrument or at "
           "how the points were sorted";
  }
  return "consistent with independent noise: no pattern beyond chance";
}

std::string LeftWords(const FitReport& report) {
  const bool dark = IsDark(report.curve);
  if (report.errors && report.errors->sizes.path > 0 && report.errors->believed) {
    return fmt::format(
        "not noise alone, neighbouring residuals go together: {}, or the device departs from the "
        "model; the 95 % intervals allow for it",
        dark ? "the device warmed" : "the light wandered");
  }
  const std::string words = ResidualVerdict(report.residuals);
  if (words == kTooFew) return "not judged, for too few points";
  // What a test of the path denies, one of twenty tests of runs finds by chance.
  const bool denied = report.errors && report.residuals.runs_p_value > kCertain &&
                      report.residuals.durbin_watson > kDurbinWatsonLow &&
                      report.residuals.durbin_watson < kDurbinWatsonHigh;
  if (words.find("consistent") != 0 && !denied) return "not noise alone, " + words;
  if (!report.errors || !report.errors->believed || report.errors->stated) {
    return "consistent with independent noise: no pattern beyond chance";
  }
  return fmt::format("independent noise ({}), for which the 95 % intervals allow",
                     WhatScatters(*report.errors, dark));
}

std::string PartOfIsc(double rmse_A, double isc_A) {
  if (!(isc_A > 0) || !std::isfinite(rmse_A)) return "";
  return fmt::format(", {} % of Isc", Significant(100 * rmse_A / isc_A, 2));
}

std::string FitVerdict(const FitReport& report) {
  if (!report.usable) return FullSentence("Not to be used: " + report.not_usable_because);
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  return FullSentence(fmt::format(
      "The {} model{} follows the curve to {} A (solved-current RMSE{}). What it leaves is {}",
      ModelTitle(report.model), PlusEffects(EffectsOf(report.device)),
      Scientific(rmse.solved_current_A, 3),
      PartOfIsc(rmse.solved_current_A, report.simulated.short_circuit_current_A),
      LeftWords(report)));
}

std::string FloorText(const FitReport& report) {
  constexpr double kClosed = 1e-5;
  const FloorReport& floor = *report.floor;
  const std::string range =
      fmt::format("n in [{:g}, {:g}]{}", floor.n_lower, floor.n_upper,
                  report.steepest_n > 0 ? ", the part of the bounds that is searched," : "");
  const std::string rmse = ToText(floor.objective) + " RMSE";
  const bool closed = floor.gap <= kClosed;
  const double within = floor.above + floor.gap;
  std::string above =
      fmt::format("the refined answer is {} % above it", Significant(100 * floor.above, 3));
  if (floor.above <= kCertifiedGap) above = "the refined answer is as low";
  if (closed && within <= kClosed) {
    above = "the refined answer attains it";
    if (within > kCertifiedGap) above += fmt::format(" to within {:.1g} of itself", within);
  }
  if (!floor.minimised) above += ", but it was not fitted for the least RMSE";
  // A floor that is missed says nothing of what this number of diodes can do.
  std::string own;
  if (floor.above > kCertifiedGap && within > kClosed && floor.minimised) {
    own = fmt::format(
        " How low the {} model itself can go, lyrefit certify --models {} --objective {} proves "
        "within the same bounds.",
        ModelTitle(report.model), ToText(report.model), ToText(floor.objective));
  }
  if (closed) {
    return fmt::format("Floor: no number of diodes with {} brings the {} below {} A, and {}.{}",
                       range, rmse, BoundText(floor.lower_bound_A), above, own);
  }
  const std::string proved = floor.lower_bound_A > 0
                                 ? fmt::format("only that nothing lies below {} A is proved",
                                               BoundText(floor.lower_bound_A))
                                 : std::string("no lower bound is proved");
  return fmt::format("Floor, not settled: diodes with {} reach a {} of {} A, and {}; {}.{}", range,
                     rmse, Scientific(floor.rmse_A, 10), above, proved, own);
}

void AddAssumed(const std::vector<Assumption>& assumptions, Section* section) {
  std::vector<std::string> of_values, of_reading;
  for (const Assumption& one : assumptions) {
    (one.about == About::kReading ? of_reading : of_values).push_back(one.sentence);
  }
  of_values.insert(of_values.end(), of_reading.begin(), of_reading.end());
  AddAssumed(of_values, section);
}

void AddAssumed(const std::vector<std::string>& sentences, Section* section) {
  constexpr std::size_t kMostLetters = 240;  // about three lines
  std::string text;
  std::size_t shown = 0;
  for (const std::string& sentence : sentences) {
    if (shown > 0 && text.size() + sentence.size() > kMostLetters) break;
    text += (shown++ > 0 ? "; " : "") + sentence;
  }
  if (shown < sentences.size()) {
    text += fmt::format("; {} more in the whole report (--verbose)", sentences.size() - shown);
  }
  if (shown > 0) AddField("assumed", text, section);
}

}  // namespace lyrefit
