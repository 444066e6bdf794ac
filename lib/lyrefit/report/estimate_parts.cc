#include "lyrefit/report/estimate_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kEstimateSearchedDigits = 5;
constexpr int kEstimateErrorDigits = 2;

std::string PolishText(const RefineReport& refine) {
  std::string text = Duration(refine.seconds) + ": " + refine.termination;
  if (!refine.message.empty()) text += fmt::format(" ({})", refine.message);
  return text + fmt::format("; projected gradient {}; condition {}",
                            Significant(refine.projected_gradient, 2),
                            Significant(refine.condition, 2));
}

std::string Optima(int count) {
  return fmt::format("{} local {}", count, count == 1 ? "optimum" : "optima");
}

std::string BestVisits(int count) {
  if (count == 0) return "none of them the best";  // the fit was interrupted
  return "the best of them reached " + (count == 1 ? "once" : fmt::format("{} times", count));
}

// A sentence such as "14 of 49 went to their end, in 3 local optima, the best of them reached 6
// times; the other 35 were ..."
std::string DescentStarts(const OptimumCount& count, int starts) {
  if (count.ends == 0) return fmt::format("none of {} went to its end", starts);
  std::string text = fmt::format("{} of {} went to {} end, in {}, {}", count.ends, starts,
                                 count.ends == 1 ? "its" : "their", Optima(count.local_optima),
                                 BestVisits(count.best_visits));
  const int others = starts - count.ends;
  if (others > 0) {
    text += fmt::format(
        "; {} given up: out of reach of the best, or that had been reached often enough",
        others == 1 ? "the other one was" : fmt::format("the other {} were", others));
  }
  return text;
}

// An estimate of local optima that were not found.
std::string UnseenText(const OptimumCount& count) {
  const OptimumCount::Independent& of = count.independent;
  std::string text;
  if (of.ends < count.ends) {
    text = fmt::format(
        "{} of the {} did not begin beside an earlier end, {} of those in the best; ", of.ends,
        Plural(count.ends, "end"), of.best_visits == 0 ? "none" : std::to_string(of.best_visits));
  }
  if (!std::isfinite(count.unseen)) {
    return text + "too few descents to estimate how many local optima were not seen";
  }
  text += "by Chao's estimate (doi:10.2307/2531532) ";
  if (count.unseen > 0) {
    return text + fmt::format("{} more were probably not seen: {} of {} were reached just once",
                              Significant(count.unseen, 2), of.once, Optima(of.local_optima));
  }
  return text + fmt::format("none was left unseen: {} was reached just once",
                            of.once == 0 ? "none" : "only one");
}

std::string StartsText(const RefineReport& refine) {
  const int starts = static_cast<int>(refine.starts.size());
  std::string text = refine.local_optima
                         ? DescentStarts(*refine.local_optima, starts)
                         : fmt::format("{} of {} came to the same curve", refine.agreeing, starts);
  if (refine.winner >= 0 && refine.winner < starts) {
    text += fmt::format("; the best end came from start {}: {}", refine.winner + 1,
                        refine.starts[refine.winner].origin);
  }
  return text;
}

}  // namespace

EstimateColumn SearchedColumn() {
  return {"searched", 'r',
          [](const Estimate& e) { return Significant(e.searched, kEstimateSearchedDigits); }};
}

EstimateColumn RefinedColumn(int digits) {
  return {"refined", 'r', [digits](const Estimate& e) { return Significant(e.refined, digits); }};
}

EstimateColumn ErrorColumn() {
  return {"std err", 'r',
          [](const Estimate& e) { return Significant(e.standard_error, kEstimateErrorDigits); }};
}

EstimateColumn IntervalColumn() {
  return {"95 % interval", 'l', [](const Estimate& e) { return Range(e.low_95, e.high_95); }};
}

block::Table EstimateTable(const std::vector<Estimate>& estimates,
                           const std::vector<EstimateColumn>& columns) {
  block::Table table = {"l", {{"parameter"}}};
  for (const EstimateColumn& column : columns) {
    table.alignment += column.alignment;
    table.heads.front().push_back(column.head);
  }
  table.alignment += 'l';
  for (const Estimate& e : estimates) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(LabelWithUnit(e.info));
    for (const EstimateColumn& column : columns) row.push_back(column.cell(e));
    row.push_back(EstimateMarks(e));
  }
  return table;
}

Section CourseSection(const EstimateReport& report,
                      const std::vector<std::pair<std::string, std::string>>& further) {
  const RefineReport& refine = report.refine;
  const bool polished = refine.termination != "not run";
  Section section = {"How it was found"};
  AddField("search", SearchText(report.search_options, report.search, report.curve_evaluations),
           &section);
  AddField("polish", polished ? PolishText(refine) : "none", &section);
  if (!refine.starts.empty()) AddField("starts", StartsText(refine), &section);
  const bool counted = refine.local_optima && refine.local_optima->ends > 0;
  if (counted) AddField("local optima", UnseenText(*refine.local_optima), &section);
  if (report.interval_seconds > 0) {
    AddField("intervals", Duration(report.interval_seconds), &section);
  }
  for (const auto& [name, text] : further) AddField(name, text, &section);
  AddField("options", OptionsText(report.non_default_options), &section);
  return section;
}

Json CourseJson(const EstimateReport& report) {
  return {{"correlations", report.correlations},
          {"search", SearchJson(report.search_options, report.search, report.curve_evaluations)},
          {"refine", report.refine},
          {"intervals",
           {{"seconds", report.interval_seconds}, {"none_because", report.no_intervals_because}}}};
}

}  // namespace lyrefit
