#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/document.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "studies/truth.h"

namespace lyrefit {
namespace {

std::string SignedPart(double value) {
  if (std::isnan(value)) return "-";
  return fmt::format("{}{:.2e}", value < 0 ? "" : "+", value);
}

std::string Part(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2e}", value); }

std::string CountText(int hits, int of) { return of > 0 ? fmt::format("{} of {}", hits, of) : "-"; }

block::Table ErrorTable(const TruthComparison& comparison) {
  block::Table table = {"lrlrrr",
                        {{"parameter", "worst", "of curve", "median", "in the plain 95 % interval",
                          "in the one to believe"}}};
  for (const TruthParameter& p : comparison.parameters) {
    table.rows.push_back({p.info.symbol, Part(p.worst), p.worst_id, Part(p.median),
                          CountText(p.covered, p.intervals),
                          CountText(p.covered_believed, p.intervals)});
  }
  return table;
}

block::Table MeanTable(const TruthComparison& comparison) {
  block::Table table = {
      "lrrrr", {{"parameter", "truth", "mean of the fits", "its error", "rms error of one fit"}}};
  table.caption = "The fits together; Rsh is averaged, and its errors are taken, as a conductance";
  for (const TruthParameter& p : comparison.parameters) {
    table.rows.push_back({p.info.symbol, Significant(p.truth, 7), Significant(p.mean, 7),
                          SignedPart(p.mean_error), Part(p.root_mean_square)});
  }
  return table;
}

// "7.998 .. 8.001", with "NO" if the true value is outside.
std::string IntervalText(const Interval& interval, double truth) {
  if (std::isnan(interval.low_95) || std::isnan(interval.high_95)) return "-";
  const bool holds = truth >= interval.low_95 && truth <= interval.high_95;
  return Range(interval.low_95, interval.high_95) + (holds ? "" : "  NO");
}

block::Table JointTable(const TruthComparison& comparison) {
  block::Table table = {
      "lrrrll",
      {{"parameter", "truth", "joint fit", "its error", "95 % by points", "by whole curves"}}};
  table.caption = "One set of parameters for all curves";
  for (const TruthParameter& p : comparison.parameters) {
    table.rows.push_back({p.info.symbol, Significant(p.truth, 7), Significant(p.joint, 7),
                          SignedPart(p.joint_error), IntervalText(p.by_points, p.truth),
                          IntervalText(p.by_curves, p.truth)});
  }
  return table;
}

bool HasJoint(const TruthComparison& comparison) {
  for (const TruthParameter& p : comparison.parameters) {
    if (!std::isnan(p.joint)) return true;
  }
  return false;
}

}  // namespace

std::string TruthText(const TruthComparison& comparison) {
  const std::string rows = comparison.one_truth
                               ? "one device"
                               : Plural(static_cast<std::size_t>(comparison.rows), "row");
  Document document;
  Section& head = document.head;
  head.heading = fmt::format("Truth ({}): {} fitted alone, errors relative to the truth", rows,
                             Plural(static_cast<std::size_t>(comparison.curves), "curve"));
  if (!comparison.parameters.empty()) {
    AddTable(ErrorTable(comparison), &head);
    if (comparison.one_truth) AddTable(MeanTable(comparison), &head);
  }
  if (HasJoint(comparison)) {
    AddTable(JointTable(comparison), &head);
    AddSentence("NO: the interval does not hold the truth.", &head);
  }
  if (comparison.unmatched > 0) {
    AddSentence(fmt::format("{} without a row of truth left out.",
                            Plural(static_cast<std::size_t>(comparison.unmatched), "curve")),
                &head);
  }
  for (const std::string& warning : comparison.warnings) {
    head.blocks.push_back(block::Warning{warning + "."});
  }
  return DrawText(document);
}

}  // namespace lyrefit
