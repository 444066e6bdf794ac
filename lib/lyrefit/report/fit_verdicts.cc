#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// Limits for the wording on residuals; no decision depends on them.
constexpr double kSurprising = 0.05;
constexpr double kDurbinWatsonLow = 1.0;
constexpr double kDurbinWatsonHigh = 3.0;

}  // namespace

std::string ResidualVerdict(const ResidualStatistics& r) {
  if (std::isnan(r.runs_p_value) && std::isnan(r.durbin_watson)) return "too few points to say";
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

std::string LeftWords(const ResidualStatistics& residuals) {
  std::string words = ResidualVerdict(residuals);
  if (words.find("consistent") == 0) return words;
  return "not noise alone, " + words;
}

std::string PartOfIsc(double rmse_A, double isc_A) {
  if (!(isc_A > 0) || !std::isfinite(rmse_A)) return "";
  return fmt::format(", {} % of Isc", Significant(100 * rmse_A / isc_A, 2));
}

std::string FitVerdict(const FitReport& report) {
  if (!report.usable) return FullSentence("Not to be used: " + report.not_usable_because);
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  return FullSentence(fmt::format(
      "The {} model{} follows the curve to {} A (solved-current RMSE{}): what it leaves is {}",
      ModelTitle(report.model), PlusEffects(EffectsOf(report.device)),
      Scientific(rmse.solved_current_A, 3),
      PartOfIsc(rmse.solved_current_A, report.simulated.short_circuit_current_A),
      LeftWords(report.residuals)));
}

}  // namespace lyrefit
