#include <fmt/format.h>

#include <cmath>

#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/two_junction_report.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/estimate_parts.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kJunctionSearchedDigits = 5;
constexpr int kJunctionRmseDigits = 7;

std::string ShareText(double share) {
  return std::isnan(share) ? "not stated" : fmt::format("{:.4g}", share);
}

Section TwoJunctionHead(const TwoJunctionReport& report) {
  Section head = {
      fmt::format("lyrefit {}: two junctions in series behind {}", report.version, report.name)};
  AddField("set",
           fmt::format("{}, {:.6g} C", Plural(report.curves.size(), "curve"),
                       report.temperature_K - kZeroCelsius_K),
           &head);
  AddField("junctions",
           report.interchangeable
               ? "the data do not tell top from bottom: junction 1 is the one with the lower "
                 "photocurrent, Iph2 = Iph1 (1 + x2)"
               : "1 is the top one, 2 the bottom one; Iph1 and Iph2 under the reference light",
           &head);
  AddField("objective",
           fmt::format("solved-current; constants {}; seed {}", ToText(report.constants),
                       report.search_options.seed),
           &head);
  return head;
}

Section TwoJunctionParameters(const TwoJunctionReport& report) {
  Section section = {"Parameters"};
  AddTable(EstimateTable(report.estimates,
                         {SearchedColumn(), RefinedColumn(), ErrorColumn(), IntervalColumn()}),
           &section);
  AddUnidentifiable(report.estimates, &section);
  if (!report.correlations.empty()) {
    AddSentence("Correlations above 0.9: " + CorrelationsText(report.correlations), &section);
  }
  return section;
}

Section CurveSection(const TwoJunctionReport& report) {
  block::Table table = {"lrrrrrrrr",
                        {{"curve", "light of 1", "light of 2", "limits", "Iph1 (A)", "Iph2 (A)",
                          "Voc (V)", "Pmp (W)", "RMSE (A)"}}};
  for (const TwoJunctionCurveReport& one : report.curves) {
    table.rows.push_back(
        {one.curve.name, ShareText(one.light.top), ShareText(one.light.bottom),
         std::to_string(one.limiting),
         Significant(one.parameters[JunctionPhotocurrent(0)], kJunctionSearchedDigits),
         Significant(one.parameters[JunctionPhotocurrent(1)], kJunctionSearchedDigits),
         Significant(one.simulated.open_circuit_voltage_V, kJunctionSearchedDigits),
         Significant(one.simulated.max_power_W, kJunctionSearchedDigits),
         Scientific(one.rmse_A, 3)});
  }
  return {"Curves (solved-current)", {table}};
}

Section RmseSection(const TwoJunctionReport& report) {
  block::Table table = {"lr", {{"", "solved-current *"}}};
  table.rows = {{"searched (best candidate)",
                 Scientific(report.rmse.searched.solved_current_A, kJunctionRmseDigits)},
                {"refined (best of all starts)",
                 Scientific(report.rmse.refined.solved_current_A, kJunctionRmseDigits)}};
  return {"RMSE in A", {table}};
}

std::string TwoJunctionVerdict(const TwoJunctionReport& report) {
  std::string open;
  for (const Estimate& e : report.estimates) {
    if (!e.identifiable) open += (open.empty() ? "" : ", ") + e.info.symbol;
  }
  return fmt::format(
      "RMSE {} A (solved-current); {}", Scientific(report.rmse.refined.solved_current_A, 4),
      open.empty() ? "every parameter is identifiable" : "not identifiable: " + open);
}

}  // namespace

Document TwoJunctionDocument(const TwoJunctionReport& report) {
  Document document;
  document.banners = Banners(report.interrupted, report.usable, report.not_usable_because, {});
  document.verdict = TwoJunctionVerdict(report);
  document.head = TwoJunctionHead(report);
  AddFigure({"Measured points and model of each curve; residuals below them.", "",
             TwoJunctionFigure(report)},
            &document.head);
  AddSections({{"", {block::Conclusion{document.verdict}}},
               TwoJunctionParameters(report),
               ListSection("What would decide", report.decided_by),
               RmseSection(report),
               WarningSection(report.warnings),
               Further(CurveSection(report)),
               Further(CourseSection(report))},
              &document);
  return document;
}

std::string TwoJunctionText(const TwoJunctionReport& report, Length length) {
  return DrawText(TwoJunctionDocument(report), length);
}

std::string BriefTwoJunctions(const TwoJunctionReport& report) {
  return fmt::format("{}: two junctions, {}{}\n", report.name, TwoJunctionVerdict(report),
                     BriefMarks(report.interrupted, report.usable, report.warnings.size(),
                                report.not_usable_because));
}

}  // namespace lyrefit
