#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/family_sections.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostNamed = 10;  // of a list of curves; the JSON report has them all

std::string BothLabelled(const RmsePair& rmse) {
  return fmt::format("{} A measured-current, {} A solved-current",
                     Scientific(rmse.measured_current_A, 4), Scientific(rmse.solved_current_A, 4));
}

// The first of many sentences, and how many there are beyond them.
std::string ShortList(const std::string& title, std::vector<std::string> sentences) {
  const std::size_t all = sentences.size();
  if (all > kMostNamed) {
    sentences.resize(kMostNamed);
    sentences.push_back(
        fmt::format("and {} more; all are in the JSON report (--json FILE)", all - kMostNamed));
  }
  return List(title, sentences);
}

}  // namespace

std::string FamilyCandidateSection(const FamilyReport& report) {
  if (report.candidates.empty()) return "";
  TextTable table("llrrrrrr");
  table.Add({"", "", "RMSE (A)", "RMSE (A)", "held out", "median", "behind", ""});
  table.Add({"law", "model", "measured-current", "solved-current", "solved-current",
             "solved-current", "best (SE)", "free"});
  for (const FamilyCandidate& c : report.candidates) {
    table.Add({ToText(c.law), ToText(c.model) + (c.chosen ? " <-" : ""),
               Scientific(c.rmse.measured_current_A, 4), Scientific(c.rmse.solved_current_A, 4),
               Scientific(c.held_out_rmse_A, 4), Scientific(c.held_out_median_A, 4),
               std::isnan(c.behind_best) ? "-" : fmt::format("{:.1f}", c.behind_best),
               std::to_string(c.free_parameters)});
  }
  return "Choice of the law\n" + table.Text() +
         Wrap("  ",
              "Held out: on whole curves that the fit did not see. Behind: the mean square beyond "
              "that of the best, in standard errors of the difference from curve to curve. Chosen "
              "is the law with the fewest free parameters that is less than one behind.");
}

std::string FamilyOddSection(const FamilyReport& report) {
  std::vector<std::string> ids;
  std::vector<std::string> sentences;
  for (const FamilyCurve& curve : report.curves) {
    if (!curve.odd) continue;
    ids.push_back(curve.id);
    sentences.push_back(fmt::format(
        "curve {} looks like another device: solved-current RMSE {} A under the shared parameters, "
        "{} A on its own",
        curve.id, Scientific(curve.rmse.solved_current_A, 3),
        Scientific(curve.free_rmse.solved_current_A, 3)));
  }
  if (ids.empty()) return "";
  std::string text = ShortList("Odd curves", sentences);
  if (report.without_odd) {
    const WithoutOdd& without = *report.without_odd;
    const char* const them = without.ids.size() == 1 ? "it" : "them";
    text += Wrap("  ", fmt::format("Without {}: RMSE {}.", them, BothLabelled(without.rmse)));
    std::string values;
    for (std::size_t i = 0; i < without.shared.size() && i < report.estimates.size(); ++i) {
      const ParameterInfo& info = report.estimates[i].info;
      values +=
          fmt::format("{}{} {}{}", values.empty() ? "" : ", ", info.symbol,
                      Significant(without.shared[i], 5), info.unit.empty() ? "" : " " + info.unit);
    }
    if (!values.empty())
      text += Wrap("  ", "Parameters without " + std::string(them) + ": " + values);
    ids = without.ids;
  }
  return text + Wrap("  ", fmt::format("To fit without: --leave-out {}", fmt::join(ids, ",")));
}

std::string FamilyOutSection(const FamilyReport& report) {
  std::vector<std::string> left_out;
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role != CurveRole::kLeftOut) continue;
    left_out.push_back(curve.reason.empty() ? curve.id
                                            : fmt::format("{}: {}", curve.id, curve.reason));
  }
  std::vector<std::string> rejected;
  for (const RejectedCurve& curve : report.rejected) {
    rejected.push_back(fmt::format("{}: {}", curve.id, curve.error.ToString()));
  }
  const std::string first = ShortList("Left out", left_out);
  const std::string second = ShortList("Rejected: could not be read", rejected);
  return first + (first.empty() || second.empty() ? "" : "\n") + second;
}

std::string FamilySearchSection(const FamilyReport& report) {
  std::string text = "How it was found\n";
  if (!OneByOne(report)) {
    text += Field("search",
                  SearchText(report.search_options, report.search, report.search.evaluations));
    text +=
        Field("joint fit", fmt::format("{}; projected gradient {}",
                                       report.termination.empty() ? "not run" : report.termination,
                                       Significant(report.projected_gradient, 2)));
  }
  if (report.free_seconds > 0) text += Field("one by one", Duration(report.free_seconds));
  text += Field("time", Duration(report.seconds));
  return text + Field("options", OptionsText(report.non_default_options));
}

}  // namespace lyrefit
