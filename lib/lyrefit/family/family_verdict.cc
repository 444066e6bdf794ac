#include <fmt/format.h>

#include "lyrefit/family/family_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

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

std::string FamilyVerdict(const FamilyReport& report) {
  if (!report.usable) return "Not to be used: the fit came to no device that could be one.";
  const TranslationSpec& spec = report.translation.spec;
  const double rmse_A = report.rmse.refined.solved_current_A;
  std::size_t outliers = 0;
  for (const FamilyCurve& curve : report.curves) outliers += curve.outlier ? 1 : 0;
  std::string text =
      OneByOne(report)
          ? fmt::format("Every curve has a {} model of its own", ModelTitle(spec.model))
          : fmt::format("One {} device by the law of {} explains the {}", ModelTitle(spec.model),
                        LawTitle(spec.law), report.key_points ? "key points" : "curves");
  text += report.key_points
              ? KeyPointWords(*report.key_points)
              : fmt::format(": solved-current RMSE {} A{}", Scientific(rmse_A, 3),
                            PartOfIsc(rmse_A, report.reference.short_circuit_current_A));
  if (outliers > 0) {
    text += fmt::format("; {} look{} like another device", Plural(outliers, "curve"),
                        outliers == 1 ? "s" : "");
  }
  return FullSentence(text);
}

}  // namespace lyrefit
