#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/report/text_sections.h"

namespace lyrefit {
namespace {

// Where the words about residuals change. They are words only: nothing is decided by them.
constexpr double kSurprising = 0.05;
constexpr double kDurbinWatsonLow = 1.0;
constexpr double kDurbinWatsonHigh = 3.0;

std::string ResidualVerdict(const ResidualStatistics& r) {
  if (std::isnan(r.runs_p_value) && std::isnan(r.durbin_watson)) return "too few points to say";
  const bool surprising = r.runs_p_value < kSurprising;
  if ((surprising && r.runs < r.expected_runs) || r.durbin_watson < kDurbinWatsonLow) {
    return "neighbouring residuals go together: the curve holds a shape that the model lacks, or "
           "the "
           "readings drifted";
  }
  if ((surprising && r.runs > r.expected_runs) || r.durbin_watson > kDurbinWatsonHigh) {
    return "neighbouring residuals alternate more than chance allows: look at the instrument or at "
           "how "
           "the points were sorted";
  }
  return "consistent with independent noise: no pattern beyond chance";
}

std::string Decimals(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.2f}", value);
}

std::string PolishText(const RefineReport& refine) {
  std::string text = Duration(refine.seconds) + ": " + refine.termination;
  if (!refine.message.empty()) text += fmt::format(" ({})", refine.message);
  return text + fmt::format("; projected gradient {}; condition {}",
                            Significant(refine.projected_gradient, 2),
                            Significant(refine.condition, 2));
}

std::string BestVisits(int count) {
  if (count == 0) return "none of them the best";  // interrupted
  return "the best of them reached " + (count == 1 ? "once" : fmt::format("{} times", count));
}

// "14 of 49 went to their end, in 3 basins, the best of them reached 6 times; the other 35 were
// ..."
std::string BasinStarts(const BasinCount& count, int starts) {
  if (count.ends == 0) return fmt::format("none of {} went to its end", starts);
  std::string text = fmt::format("{} of {} went to {} end, in {}, {}", count.ends, starts,
                                 count.ends == 1 ? "its" : "their", Plural(count.basins, "basin"),
                                 BestVisits(count.best_visits));
  const int others = starts - count.ends;
  if (others > 0) {
    text += fmt::format(
        "; {} given up: out of reach of the best, or that had been reached often "
        "enough",
        others == 1 ? "the other one was" : fmt::format("the other {} were", others));
  }
  return text;
}

// What may have been missed.
std::string UnseenText(const BasinCount& count) {
  const BasinCount::Independent& of = count.independent;
  std::string text;
  if (of.ends < count.ends) {
    text = fmt::format(
        "{} of the {} did not begin beside an earlier end, {} of those in the best; ", of.ends,
        Plural(count.ends, "end"), of.best_visits == 0 ? "none" : std::to_string(of.best_visits));
  }
  if (!std::isfinite(count.unseen)) {
    return text + "too few descents to estimate how many basins were not seen";
  }
  text += "by Chao's estimate (doi:10.2307/2531532) ";
  if (count.unseen > 0) {
    return text + fmt::format("{} more were probably not seen: {} of {} were reached just once",
                              Significant(count.unseen, 2), of.once, Plural(of.basins, "basin"));
  }
  return text + fmt::format("none was left unseen: {} was reached just once",
                            of.once == 0 ? "none" : "only one");
}

std::string StartsText(const RefineReport& refine) {
  const int starts = static_cast<int>(refine.starts.size());
  std::string text = refine.basins
                         ? BasinStarts(*refine.basins, starts)
                         : fmt::format("{} of {} came to the same curve", refine.agreeing, starts);
  if (refine.winner >= 0 && refine.winner < starts) {
    text += fmt::format("; the best end came from start {}: {}", refine.winner + 1,
                        refine.starts[refine.winner].origin);
  }
  return text;
}

}  // namespace

std::string ChoiceSection(const FitReport& report) {
  if (!report.choice) return "";
  TextTable table("lrrrrl");
  const std::string rmse = fmt::format("RMSE in A ({})", ToText(report.objective));
  table.Add({"model", rmse, "held out", "AICc", "F-test p", "every parameter identifiable"});
  for (const CandidateReport& c : report.choice->candidates) {
    table.Add({ToText(c.model) + (c.model == report.choice->chosen ? " <-" : ""),
               Scientific(c.rmse_A, 6), Scientific(c.held_out_rmse_A, 3), Decimals(c.aicc),
               Significant(c.f_p_value, 2), c.identifiable ? "yes" : "no"});
  }
  return "Choice of the model\n" + table.Text() + Wrap("  ", report.choice->sentence);
}

// What of the effects is free, where that followed from the shape of the curve.
std::string FormSection(const FitReport& report) {
  if (report.forms.empty()) return "";
  const auto line = [](const std::string& rmse, const std::string& bic, const std::string& what) {
    return Wrap(fmt::format("  {:>26}  {:>18}  ", rmse, bic), what);
  };
  std::string text = "Choice of the form\n";
  text += line("RMSE in A (solved-current)", "BIC above the best", "of the effects");
  for (const FormReport& form : report.forms) {
    const char* mark = form.chosen ? " <-" : form.finished ? "" : " (given up: at most this much)";
    text += line(Scientific(form.rmse_A, 6), Decimals(form.bic_above), form.what + mark);
  }
  return text;
}

std::string ResidualSection(const FitReport& report) {
  const ResidualStatistics& r = report.residuals;
  std::string text = "Residuals (model - measured, solved-current)\n";
  text +=
      Field("largest error", fmt::format("{} A at {} V; mean {} A", Significant(r.largest_A, 3),
                                         Significant(r.largest_at_V, 4), Significant(r.mean_A, 2)));
  text +=
      Field("runs", fmt::format("{} of one sign, {} expected of independent noise (p = {}); "
                                "Durbin-Watson {}",
                                r.runs, Significant(r.expected_runs, 3),
                                Significant(r.runs_p_value, 2), Significant(r.durbin_watson, 3)));
  text += Field("verdict", ResidualVerdict(r));
  text += Field("information",
                fmt::format("AICc {}, BIC {} ({} points, {} free parameters)",
                            Decimals(report.criteria.aicc), Decimals(report.criteria.bic),
                            report.criteria.points, report.criteria.parameters));
  const std::string correlations = CorrelationsText(report.correlations);
  if (!correlations.empty()) text += Field("correlations", correlations + " (above 0.9)");
  return text;
}

std::string SearchSection(const FitReport& report) {
  std::string text = "How it was found\n";
  text +=
      Field("search", SearchText(report.search_options, report.search, report.curve_evaluations));
  text += Field("polish", report.polished ? PolishText(report.refine) : "none");
  if (report.polished) text += Field("starts", StartsText(report.refine));
  const bool counted = report.refine.basins && report.refine.basins->ends > 0;
  if (counted) text += Field("basins", UnseenText(*report.refine.basins));
  if (report.interval_seconds > 0) text += Field("intervals", Duration(report.interval_seconds));
  return text + Field("options", OptionsText(report.non_default_options));
}

}  // namespace lyrefit
