#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/record_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// Limits for the wording on residuals; no decision depends on them.
constexpr double kSurprising = 0.05;
constexpr double kDurbinWatsonLow = 1.0;
constexpr double kDurbinWatsonHigh = 3.0;

// The residual verdict in words for the middle of a sentence.
std::string LeftWords(const ResidualStatistics& residuals) {
  std::string words = ResidualVerdict(residuals);
  if (words.find("consistent") == 0) return words;
  return "not noise alone, " + words;
}

// A part of Isc such as ", 0.10 % of Isc"; empty if Isc is unknown.
std::string PartOfIsc(double rmse_A, double isc_A) {
  if (!(isc_A > 0) || !std::isfinite(rmse_A)) return "";
  return fmt::format(", {} % of Isc", Significant(100 * rmse_A / isc_A, 2));
}

// How well a fit of key points gives the power of the conditions.
std::string KeyPointWords(const KeyPointSummary& found) {
  const auto percent = [](double part) { return Significant(100 * part, 2); };
  std::string words = fmt::format(": Pmp within {} % of nominal power (rms)",
                                  percent(found.max_power_of_reference));
  if (found.held_out > 0) {
    words += fmt::format(", {} % where a condition is held out",
                         percent(found.held_out_max_power_of_reference));
  }
  return words;
}

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

std::string FamilyVerdict(const FamilyReport& report) {
  if (!report.usable) return "Not to be used: the fit came to no device that could be one.";
  const TranslationSpec& spec = report.translation.spec;
  const double rmse_A = report.rmse.refined.solved_current_A;
  std::size_t outlier = 0;
  for (const FamilyCurve& curve : report.curves) outlier += curve.outlier ? 1 : 0;
  std::string text =
      OneByOne(report)
          ? fmt::format("Every curve has a {} model of its own", ModelTitle(spec.model))
          : fmt::format("One {} device by the law of {} explains the {}", ModelTitle(spec.model),
                        LawTitle(spec.law), report.key_points ? "key points" : "curves");
  text += report.key_points
              ? KeyPointWords(*report.key_points)
              : fmt::format(": solved-current RMSE {} A{}", Scientific(rmse_A, 3),
                            PartOfIsc(rmse_A, report.reference.short_circuit_current_A));
  if (outlier > 0) {
    text += fmt::format("; {} look{} like another device", Plural(outlier, "curve"),
                        outlier == 1 ? "s" : "");
  }
  return FullSentence(text);
}

}  // namespace lyrefit
