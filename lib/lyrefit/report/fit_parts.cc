#include "lyrefit/report/fit_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/version.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/report/documents.h"
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

std::vector<ParameterInfo> LargestModel(const std::vector<FittedFile>& fits) {
  const std::vector<Estimate>* largest = nullptr;
  for (const FittedFile& fit : fits) {
    if (!fit.report) continue;
    const bool larger = largest == nullptr || fit.report->estimates.size() > largest->size();
    if (larger) largest = &fit.report->estimates;
  }
  std::vector<ParameterInfo> parameters;
  if (largest == nullptr) return parameters;
  for (const Estimate& estimate : *largest) parameters.push_back(estimate.info);
  return parameters;
}

std::pair<double, double> ValueAndError(const FitReport& report, const ParameterInfo& info) {
  const auto found = std::find_if(report.estimates.begin(), report.estimates.end(),
                                  [&](const Estimate& e) { return e.info.symbol == info.symbol; });
  if (found == report.estimates.end()) return {kUnknown, kUnknown};
  return {report.polished ? found->refined : found->searched, found->standard_error};
}

namespace {

block::Table::Row TextRow(const FittedFile& fit, const std::vector<ParameterInfo>& parameters) {
  const FitReport& report = *fit.report;
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  block::Table::Row row = {fit.file, ToText(report.model) + PlusEffects(EffectsOf(report.device)),
                           std::to_string(report.curve.size()),
                           Scientific(rmse.measured_current_A, 4),
                           Scientific(rmse.solved_current_A, 4)};
  for (const ParameterInfo& info : parameters) {
    row.push_back(Significant(ValueAndError(report, info).first, 5));
  }
  const std::string marks = BriefMarks(report.interrupted, report.usable, 0);
  row.push_back(report.polished ? marks.substr(marks.empty() ? 0 : 2) : "not polished" + marks);
  return row;
}

}  // namespace

Document FitsDocument(const std::vector<FittedFile>& fits) {
  const std::vector<ParameterInfo> parameters = LargestModel(fits);
  block::Table table = {"llrrr" + std::string(parameters.size(), 'r') + "l",
                        {{"", "", "", "RMSE (A)", "RMSE (A)"},
                         {"file", "model", "points", "measured-current", "solved-current"}}};
  for (const ParameterInfo& info : parameters) {
    table.heads[0].push_back(info.symbol);
    table.heads[1].push_back(info.unit);
  }
  std::vector<std::string> without;
  std::vector<std::string> warnings;
  for (const FittedFile& fit : fits) {
    if (!fit.report) {
      without.push_back(fmt::format("{}: {}", fit.file, fit.report.error().ToString()));
      continue;
    }
    table.rows.push_back(TextRow(fit, parameters));
    for (const std::string& warning : fit.report->warnings) {
      warnings.push_back(fmt::format("{}: {}", fit.file, warning));
    }
  }
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: fits of {}", Version(), Plural(fits.size(), "curve"));
  Section answers = {"Parameters"};
  if (!table.rows.empty()) AddTable(std::move(table), &answers);
  AddSections(
      {answers, ListSection("Not fitted", std::move(without)), WarningSection(std::move(warnings))},
      &document);
  return document;
}

}  // namespace lyrefit
