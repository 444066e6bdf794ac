#include "lyrefit/study/report/truth_text.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

std::string SignedPart(double value) {
  if (std::isnan(value)) return "-";
  return fmt::format("{}{:.2e}", value < 0 ? "" : "+", value);
}

std::string Part(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2e}", value); }

std::string CountText(int hits, int of) { return of > 0 ? fmt::format("{} of {}", hits, of) : "-"; }

std::string ErrorTable(const TruthComparison& comparison) {
  TextTable table("lrlrrr");
  table.Add({"parameter", "worst", "of curve", "median", "in the plain 95 % interval",
             "in the one to believe"});
  for (const TruthParameter& p : comparison.parameters) {
    table.Add({p.info.symbol, Part(p.worst), p.worst_id, Part(p.median),
               CountText(p.covered, p.intervals), CountText(p.covered_believed, p.intervals)});
  }
  return table.Text();
}

std::string MeanTable(const TruthComparison& comparison) {
  TextTable table("lrrrr");
  table.Add({"parameter", "truth", "mean of the fits", "its error", "rms error of one fit"});
  for (const TruthParameter& p : comparison.parameters) {
    table.Add({p.info.symbol, Significant(p.truth, 7), Significant(p.mean, 7),
               SignedPart(p.mean_error), Part(p.root_mean_square)});
  }
  return table.Text();
}

// "7.998 .. 8.001", with "NO" where the truth lies outside.
std::string IntervalText(const Interval& interval, double truth) {
  if (std::isnan(interval.low_95) || std::isnan(interval.high_95)) return "-";
  const bool holds = truth >= interval.low_95 && truth <= interval.high_95;
  return Range(interval.low_95, interval.high_95) + (holds ? "" : "  NO");
}

std::string JointTable(const TruthComparison& comparison) {
  TextTable table("lrrrll");
  table.Add({"parameter", "truth", "joint fit", "its error", "95 % by points", "by whole curves"});
  for (const TruthParameter& p : comparison.parameters) {
    table.Add({p.info.symbol, Significant(p.truth, 7), Significant(p.joint, 7),
               SignedPart(p.joint_error), IntervalText(p.by_points, p.truth),
               IntervalText(p.by_curves, p.truth)});
  }
  return table.Text() + Wrap("  ", "NO: the interval does not hold the truth.");
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
  std::string text =
      fmt::format("Truth ({}): {} fitted alone, errors relative to the truth\n", rows,
                  Plural(static_cast<std::size_t>(comparison.curves), "curve"));
  if (!comparison.parameters.empty()) text += ErrorTable(comparison);
  if (comparison.one_truth && !comparison.parameters.empty()) {
    text += "\n  The fits together; Rsh is averaged, and its errors are taken, as a conductance\n";
    text += MeanTable(comparison);
  }
  if (HasJoint(comparison)) {
    text += "\n  One set of parameters for all curves\n";
    text += JointTable(comparison);
  }
  if (comparison.unmatched > 0) {
    text +=
        Wrap("  ", fmt::format("{} without a row of truth left out.",
                               Plural(static_cast<std::size_t>(comparison.unmatched), "curve")));
  }
  for (const std::string& warning : comparison.warnings) text += Wrap("  ! ", warning + ".");
  return text;
}

}  // namespace lyrefit
