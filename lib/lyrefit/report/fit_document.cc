#include <fmt/format.h>

#include <cmath>

#include "lyrefit/curve/dark.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kValueDigits = 6;
constexpr int kErrorDigits = 2;
constexpr int kRmseDigits = 7;
constexpr double kLargestPercent = 1000;  // above it a relative difference is meaningless

Section FitHead(const FitReport& report) {
  Section head = {fmt::format("lyrefit {}: {} model of {}", report.version,
                              ModelTitle(report.model), report.curve.name)};
  AddCurve(report.curve, &head);
  const std::string effects = EffectTitles(EffectsOf(report.device));
  if (!effects.empty()) AddField("effects", effects, &head);
  AddAssumed(report.curve.assumptions, &head);
  return head;
}

// The estimates whose intervals are to be believed.
const std::vector<Estimate>& Believed(const FitReport& report) {
  return report.under_errors.empty() ? report.estimates : report.under_errors;
}

// "95 % intervals: profile (Rs, n2), symmetric (Iph)".
std::string IntervalNote(const std::vector<Estimate>& estimates) {
  std::string note;
  for (const IntervalMethod method :
       {IntervalMethod::kSymmetric, IntervalMethod::kProfile, IntervalMethod::kUnsettled}) {
    std::string symbols;
    for (const Estimate& e : estimates) {
      if (e.interval == method) symbols += (symbols.empty() ? "" : ", ") + e.info.symbol;
    }
    if (symbols.empty()) continue;
    note += fmt::format("{}{} ({})", note.empty() ? "" : "; ", ToText(method), symbols);
  }
  return note;
}

std::string Difference(double measured, double simulated) {
  const double percent = 100 * (simulated / measured - 1);
  return std::abs(percent) < kLargestPercent ? fmt::format("{:+.3f} %", percent) : "-";
}

std::string Decimals(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.2f}", value);
}

// Sections of the results.

Section ChoiceSection(const FitReport& report) {
  if (!report.choice) return {};
  const std::string rmse = fmt::format("RMSE in A ({})", ToText(report.objective));
  block::Table table = {
      "lrrrrl", {{"model", rmse, "held out", "AICc", "F-test p", "every parameter identifiable"}}};
  for (const CandidateReport& c : report.choice->candidates) {
    table.rows.push_back({ToText(c.model) + (c.model == report.choice->chosen ? " <-" : ""),
                          Scientific(c.rmse_A, 6), Scientific(c.held_out_rmse_A, 3),
                          Decimals(c.aicc), Significant(c.f_p_value, 2),
                          c.identifiable ? "yes" : "no"});
  }
  return {"Choice of the model", {table, block::Sentence{report.choice->sentence}}};
}

// Model variants of the effects, if they were selected by the shape of the curve.
Section VariantSection(const FitReport& report) {
  if (report.variants.empty()) return {};
  block::Table table = {"rrw",
                        {{"RMSE in A (solved-current)", "BIC above the best", "of the effects"}}};
  for (const VariantReport& variant : report.variants) {
    const char* mark = variant.chosen     ? " <-"
                       : variant.finished ? ""
                                          : " (given up: at most this much)";
    table.rows.push_back(
        {Scientific(variant.rmse_A, 6), Decimals(variant.bic_above), variant.what + mark});
  }
  return {"Choice of the variant", {table}};
}

// The verdict, and what is not known or was not done.
Section VerdictSection(const FitReport& report) {
  Section section = {"", {block::Conclusion{FitVerdict(report)}}};
  AddUnidentifiable(report.estimates, &section);
  if (!report.polished) {
    AddSentence("No polish was done: the searched values are the answer.", &section);
  }
  if (!report.no_intervals_because.empty()) {
    AddSentence("95 % intervals: none, since " + report.no_intervals_because + ".", &section);
  }
  return section;
}

// The estimates as they are shown: with the errors that are to be believed, without refined values if
// there was no polish.
std::vector<Estimate> Shown(const FitReport& report) {
  std::vector<Estimate> shown = report.estimates;
  const std::vector<Estimate>& believed = Believed(report);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!report.polished) shown[i].refined = kUnknown;
    shown[i].standard_error = believed[i].standard_error;
    shown[i].low_95 = believed[i].low_95;
    shown[i].high_95 = believed[i].high_95;
  }
  return shown;
}

Section ParameterSection(const FitReport& report) {
  Section section = {"Parameters"};
  AddTable(EstimateTable(Shown(report),
                         {SearchedColumn(), RefinedColumn(), ErrorColumn(), IntervalColumn()}),
           &section);
  return section;
}

// How the intervals were found; of believed errors also those that take every reading for equal.
Section IntervalSection(const FitReport& report) {
  Section section = {"Intervals"};
  const std::string intervals = IntervalNote(Believed(report));
  if (!intervals.empty()) AddSentence("95 % intervals: " + intervals, &section);
  if (!report.under_errors.empty()) {
    block::Table table = {"lrl",
                          {{"parameter", "std err",
                            "95 % interval if errors were independent and "
                            "of one size"}}};
    for (const Estimate& e : report.estimates) {
      table.rows.push_back({LabelWithUnit(e.info), Significant(e.standard_error, kErrorDigits),
                            Range(e.low_95, e.high_95)});
    }
    AddTable(std::move(table), &section);
    AddSentence("95 % intervals: " + IntervalNote(report.estimates), &section);
  }
  AddSentence(fmt::format("nNsVth = {} V (n1 x cells in series x k T / q)",
                          Significant(report.nNsVth, kValueDigits)),
              &section);
  return section;
}

Section ErrorSection(const FitReport& report) {
  Section section = {"Errors of the readings"};
  if (!report.errors) return section;
  AddErrorSizes(*report.errors, IsDark(report.curve), &section);
  AddSentence(ErrorTests(*report.errors, IsDark(report.curve)), &section);
  return section;
}

block::Table HeadOfRmse(const FitReport& report) {
  const auto label = [&](Objective objective) {
    return ToText(objective) + (objective == report.objective ? " *" : "");
  };
  return {"lrr",
          {{"RMSE in A (* fitted)", label(Objective::kMeasuredCurrent),
            label(Objective::kSolvedCurrent)}}};
}

void AddRmse(const std::string& name, const RmsePair& rmse, block::Table* table,
             int digits = kRmseDigits) {
  table->rows.push_back({name, Scientific(rmse.measured_current_A, digits),
                         Scientific(rmse.solved_current_A, digits)});
}

bool IsWeighed(const FitReport& report) { return report.errors && report.errors->weighed; }

// The search's best and the answer.
void AddRmses(const FitReport& report, Section* section) {
  block::Table table = HeadOfRmse(report);
  const bool weighed = IsWeighed(report);
  AddRmse(fmt::format("searched ({}, seed {})", ToText(report.search_options.algorithm),
                      report.search_options.seed),
          report.rmse.searched, &table);
  AddRmse(weighed ? "refined, weighed by the errors" : "refined",
          report.polished ? report.rmse.refined : RmsePair{}, &table);
  AddTable(std::move(table), section);
  if (weighed) {
    AddSentence("The answer is weighed by the errors: its plain RMSE is not the lowest.", section);
  }
  if (report.floor) AddSentence(FloorText(report), section);
}

// RMSEs to compare these with, in as many digits as published ones have.
Section FurtherRmseSection(const FitReport& report) {
  constexpr int kDigits = 10;
  block::Table table = HeadOfRmse(report);
  const auto add = [&](const char* name, const RmsePair& rmse) {
    AddRmse(name, rmse, &table, kDigits);
  };
  add("random points, as many", report.rmse.random_baseline);
  add("searched", report.rmse.searched);
  if (report.polished) {
    add("best candidate polished", report.rmse.refined_best_candidate);
    add("refined", report.rmse.refined);
  }
  if (IsWeighed(report)) add("least squares", report.errors->least_squares);
  // The figures of most papers are of the other objective, each at its own optimum.
  const bool solved = report.objective == Objective::kSolvedCurrent;
  Section section = {
      fmt::format("Further RMSE{}", solved ? " (papers mostly fit measured-current)" : "")};
  AddTable(std::move(table), &section);
  return section;
}

void AddKeyPoints(const FitReport& report, Section* section) {
  if (IsDark(report.curve)) return;  // it has none
  const struct {
    const char* name;
    const char* unit;
    double KeyPoints::*field;
  } columns[] = {{"Isc", "A", &KeyPoints::short_circuit_current_A},
                 {"Voc", "V", &KeyPoints::open_circuit_voltage_V},
                 {"Vmp", "V", &KeyPoints::max_power_voltage_V},
                 {"Imp", "A", &KeyPoints::max_power_current_A},
                 {"Pmp", "W", &KeyPoints::max_power_W},
                 {"FF", "", &KeyPoints::fill_factor}};
  block::Table table = {"lrrrrrr", {{""}}, {{"measured"}, {"simulated"}, {"difference"}}};
  for (const auto& column : columns) {
    const double measured = report.measured.*column.field;
    const double simulated = report.simulated.*column.field;
    const std::string unit = column.unit;
    table.heads[0].push_back(column.name + (unit.empty() ? "" : " (" + unit + ")"));
    table.rows[0].push_back(Significant(measured, kValueDigits));
    table.rows[1].push_back(Significant(simulated, kValueDigits));
    table.rows[2].push_back(Difference(measured, simulated));
  }
  AddTable(std::move(table), section);
}

Section ResultSection(const FitReport& report) {
  Section section;
  AddRmses(report, &section);
  AddKeyPoints(report, &section);
  return section;
}

// Sections of the reliability of the results.

Section ResidualSection(const FitReport& report) {
  const ResidualStatistics& r = report.residuals;
  Section section = {"Residuals (model - measured, solved-current)"};
  AddField("largest error",
           fmt::format("{} A at {} V; mean {} A", Significant(r.largest_A, 3),
                       Significant(r.largest_at_V, 4), Significant(r.mean_A, 2)),
           &section);
  AddField("runs",
           fmt::format("{} of one sign, {} expected of independent noise (p = {}); "
                       "Durbin-Watson {}",
                       r.runs, Significant(r.expected_runs, 3), Significant(r.runs_p_value, 2),
                       Significant(r.durbin_watson, 3)),
           &section);
  AddField("information",
           fmt::format("AICc {}, BIC {} ({} points, {} free parameters)",
                       Decimals(report.criteria.aicc), Decimals(report.criteria.bic),
                       report.criteria.points, report.criteria.parameters),
           &section);
  const std::string correlations = CorrelationsText(report.correlations);
  if (!correlations.empty()) AddField("correlations", correlations + " (above 0.9)", &section);
  return section;
}

Section SearchSection(const FitReport& report) {
  return CourseSection(
      report, {{"objective", fmt::format("{}; bounds {}; constants {}", ToText(report.objective),
                                         report.bounds_name, ToText(report.constants))}});
}

}  // namespace

Document FitDocument(const FitReport& report) {
  Document document = {
      Banners(report.interrupted, report.usable, report.not_usable_because, report.doubts),
      FitHead(report)};
  AddSections({VerdictSection(report), ChoiceSection(report), ParameterSection(report),
               ResultSection(report), WarningSection(report.warnings),
               Further(VariantSection(report)), Further(IntervalSection(report)),
               Further(ErrorSection(report)), Further(FurtherRmseSection(report)),
               Further(ResidualSection(report)), Further(SearchSection(report)),
               Further(ListSection("Assumptions", SentencesOf(report.curve.assumptions)))},
              &document);
  document.verdict = FitVerdict(report);
  AddFigure(FigureBlock(report), &document.head);
  return document;
}

std::string ShortReport(const FitReport& report) {
  return DrawText(FitDocument(report), Length::kShort);
}

std::string FullReport(const FitReport& report) { return DrawText(FitDocument(report)); }

std::string BriefReport(const FitReport& report) {
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  const std::string model = ToText(report.model) + PlusEffects(EffectsOf(report.device));
  std::string text = fmt::format(
      "{}: {}, RMSE {} A measured-current, {} A solved-current (fitted: {}{})", report.curve.name,
      model, Scientific(rmse.measured_current_A, 10), Scientific(rmse.solved_current_A, 10),
      ToText(report.objective), report.polished ? "" : ", not polished");
  for (const Estimate& e : report.estimates) {
    text += fmt::format(", {} {}{}{}", e.info.symbol,
                        Significant(report.polished ? e.refined : e.searched, 6),
                        e.info.unit.empty() ? "" : " ", e.info.unit);
  }
  text += BriefMarks(report.interrupted, report.usable, report.warnings.size(),
                     report.not_usable_because);
  return text + "\n";
}

}  // namespace lyrefit
