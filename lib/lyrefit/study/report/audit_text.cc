#include "lyrefit/study/report/audit_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/audit_sentence.h"

namespace lyrefit {
namespace {

constexpr int kAuditDigits = 7;
constexpr std::size_t kLongestAlgorithm = 17;  // in a table; the remarks below it have all of it

std::string Rows(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "row" : "rows");
}

// "Table 10, rtc_france: 33 C, 1 cell in series"
std::string AuditTitle(const AuditFinding& finding) {
  const AuditReading& stated = finding.stated;
  const std::string& source = finding.row.source;
  return fmt::format("{}{}{}: {:g} C, {} {} in series", source, source.empty() ? "" : ", ",
                     stated.curve, std::round(stated.temperature_C * 1e4) / 1e4, stated.cells,
                     stated.cells == 1 ? "cell" : "cells");
}

// The head of the column that the claims are of has a star.
std::string Head(const AuditReport& report, Objective objective) {
  return ToText(objective) + (report.options.objective == objective ? " *" : "");
}

std::string Name(const AuditFinding& finding) {
  return finding.row.algorithm.empty() ? fmt::format("line {}", finding.row.line)
                                       : finding.row.algorithm;
}

std::string ShortName(const AuditFinding& finding) {
  std::string name = Name(finding);
  if (name.size() <= kLongestAlgorithm) return name;
  std::size_t end = kLongestAlgorithm - 2;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
  return name.substr(0, end) + "..";
}

std::string BoundsSentence(const AuditFinding& finding) {
  const auto leaves = [&](const char* when, const AuditReading& reading) {
    return fmt::format(" {} it leaves bounds-{}.json: {}.", when, finding.bounds_name,
                       LeftBoundsText(reading.left_bounds));
  };
  if (finding.explanations.empty()) {
    return finding.stated.left_bounds.empty() ? "" : leaves("As printed", finding.stated);
  }
  const AuditReading& changed = finding.explanations[0].reading;
  return changed.left_bounds.empty() ? "" : leaves("So changed", changed);
}

// What is to be said about a row below its table; nothing about one without fault.
std::string Remark(const AuditFinding& finding) {
  const bool plain = finding.verdict == AuditVerdict::kReproduces;
  const std::string text = (plain ? "" : finding.sentence) + BoundsSentence(finding);
  return text.empty() ? "" : Wrap("  - ", Name(finding) + ": " + text);
}

// One table, from `begin` to `end`.
std::string CurveRows(const AuditReport& report, std::size_t begin, std::size_t end) {
  TextTable table("llrrrl");
  table.Add({"row", "model", "claimed", Head(report, Objective::kMeasuredCurrent),
             Head(report, Objective::kSolvedCurrent), "verdict"});
  std::string remarks;
  for (std::size_t i = begin; i < end; ++i) {
    const AuditFinding& finding = report.findings[i];
    table.Add({ShortName(finding), ToText(finding.row.model), finding.row.rmse.text,
               Scientific(finding.stated.rmse.measured_current_A, kAuditDigits),
               Scientific(finding.stated.rmse.solved_current_A, kAuditDigits),
               ToText(finding.verdict)});
    remarks += Remark(finding);
  }
  return AuditTitle(report.findings[begin]) + "\n" + table.Text() + remarks;
}

std::string Legend(const AuditReport& report) {
  const std::string constants =
      report.options.constants ? "the constants " + ToText(*report.options.constants)
                               : "the constants that bring the claim back, or codata where none do";
  return fmt::format(
      "RMSE in A of the rows as stated, with {}; the claims are of the RMSE marked *.", constants);
}

std::string BadRows(const AuditReport& report) {
  if (report.bad_rows.empty()) return "";
  std::string text = fmt::format("{} could not be audited\n", Rows(report.bad_rows.size()));
  for (const Error& error : report.bad_rows) text += Wrap("  - ", error.ToString());
  return text;
}

// How many claims that reproduce do so with each set of constants, where none was stated.
std::string ConstantsSummary(const AuditReport& report) {
  const bool open =
      std::any_of(report.findings.begin(), report.findings.end(),
                  [](const AuditFinding& finding) { return finding.stated.any_constants; });
  if (!open) return "";
  std::string text;
  for (const auto& row : EnumTable<ConstantSet>::kRows) {
    int count = 0;
    for (const AuditFinding& finding : report.findings) {
      const AuditReading& reading =
          finding.explanations.empty() ? finding.stated : finding.explanations[0].reading;
      if (!reading.any_constants) continue;
      count += static_cast<int>(
          std::count(reading.constants.begin(), reading.constants.end(), row.value));
    }
    text += fmt::format("{}{} with {}", text.empty() ? "" : ", ", count, row.text);
  }
  return Wrap("", fmt::format("Claims that reproduce, by constants: {}.", text));
}

std::string Summary(const AuditReport& report) {
  std::string text = Rows(report.findings.size()) + ": ";
  bool first = true;
  for (const auto& row : EnumTable<AuditVerdict>::kRows) {
    const int count = CountFindings(report, row.value);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", first ? "" : ", ", row.text, count);
    first = false;
  }
  if (report.findings.empty()) text += "none audited";
  if (!report.bad_rows.empty()) {
    text += fmt::format("; {} more could not be audited", report.bad_rows.size());
  }
  return Wrap("", text + ".") + ConstantsSummary(report);
}

}  // namespace

std::string AuditText(const AuditReport& report) {
  std::string text = fmt::format("lyrefit {}: audit of {}\n", report.version, report.path);
  text += Wrap("", Legend(report));
  const std::vector<AuditFinding>& findings = report.findings;
  for (std::size_t begin = 0; begin < findings.size();) {
    std::size_t end = begin + 1;
    while (end < findings.size() && AuditTitle(findings[end]) == AuditTitle(findings[begin])) ++end;
    text += "\n" + CurveRows(report, begin, end);
    begin = end;
  }
  const std::string bad = BadRows(report);
  if (!bad.empty()) text += "\n" + bad;
  return text + "\n" + Summary(report);
}

std::string BriefAudit(const AuditReport& report) {
  std::string text;
  for (const AuditFinding& finding : report.findings) {
    text += fmt::format(
        "{}{}{}, {} of {}: claimed {} A, {} A measured-current, {} A "
        "solved-current: {}\n",
        finding.row.source, finding.row.source.empty() ? "" : ", ", Name(finding),
        ToText(finding.row.model), finding.stated.curve, finding.row.rmse.text,
        Scientific(finding.stated.rmse.measured_current_A, kAuditDigits),
        Scientific(finding.stated.rmse.solved_current_A, kAuditDigits), ToText(finding.verdict));
  }
  for (const Error& error : report.bad_rows) text += error.ToString() + "\n";
  return text + Summary(report);
}

}  // namespace lyrefit
