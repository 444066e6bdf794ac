#include "lyrefit/report/healthy_text.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/version.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

std::string TableSection(const HealthyComparison& comparison) {
  TextTable table("lrrlrrl");
  table.Add({"", "now", "expected", "95 % interval", "z", "Pmax", ""});
  for (const HealthyRow& row : comparison.rows) {
    const std::string label = row.name + (row.unit.empty() ? "" : " (" + row.unit + ")");
    table.Add({label, Significant(row.now, 4), Significant(row.expected, 4),
               Range(row.low_95, row.high_95), fmt::format("{:+.1f}", row.z),
               std::isfinite(row.power) ? fmt::format("{:+.2f} %", 100 * row.power) : "",
               row.differs ? "differs" : ""});
  }
  return "Now and as expected\n" + table.Text() +
         Wrap("  ",
              "95 % interval: of what a healthy sweep shows; z: difference in standard deviations "
              "of "
              "its prediction; Pmax: what the difference "
              "alone gives of it or costs; parameters make up for one another, the causes do not");
}

std::string ComparedWith(const HealthyComparison& comparison) {
  std::string text = Plural(comparison.references.size(), "healthy sweep");
  if (comparison.regressed_on.empty()) return text + ", their mean";
  text += ", brought to this sweep's";
  for (std::size_t i = 0; i < comparison.regressed_on.size(); ++i) {
    text += (i > 0 ? " and " : " ") + comparison.regressed_on[i];
  }
  return text;
}

std::string CauseSection(const HealthyComparison& comparison) {
  if (comparison.causes.empty()) return "";
  TextTable table("lrlrr");
  table.Add({"cause", "size", "95 % interval", "Pmax", "explains"});
  for (const HealthyCause& cause : comparison.causes) {
    table.Add({cause.id, fmt::format("{} {}", Significant(cause.size, 3), cause.unit),
               Range(cause.low_95, cause.high_95), fmt::format("{:+.2f} %", 100 * cause.power),
               fmt::format("{:.0f} %", 100 * cause.explained)});
  }
  const bool several = comparison.causes.size() > 1;
  return "\nWhat would make the difference\n" + table.Text() +
         (several ? Wrap("  ", "these sweeps cannot tell one from the other") : std::string());
}

// Without the head.
std::string Body(const HealthyComparison& comparison) {
  std::string text =
      Wrap("  ", comparison.sentence) + "\n" + TableSection(comparison) + CauseSection(comparison);
  for (const auto& [title, list] :
       {std::pair{"Not compared with", comparison.left_out}, {"Warnings", comparison.warnings}}) {
    if (!list.empty()) text += "\n" + List(title, list);
  }
  return text;
}

}  // namespace

std::string HealthyText(const HealthyComparison& comparison) {
  std::string text =
      fmt::format("lyrefit {}: {} against healthy sweeps\n", Version(), comparison.name);
  text += Field("compared with", ComparedWith(comparison));
  if (!comparison.without_common.voltage_V.empty()) {
    text += Field("in common", fmt::format("a single diode misses {} % of Isc in all of them; it "
                                           "is taken off the readings before they are diagnosed",
                                           Significant(100 * comparison.common, 2)));
  }
  return text + "\n" + Body(comparison);
}

std::string BriefHealthy(const HealthyComparison& comparison) {
  return comparison.name + ": " + comparison.sentence + "\n";
}

std::string BriefOddSweeps(const OddSweeps& odd) {
  std::string text;
  for (const HealthyComparison& sweep : odd.sweeps) {
    if (sweep.differs) text += BriefHealthy(sweep);
  }
  return text + fmt::format("{} of {} odd\n", odd.odd, Plural(odd.sweeps.size(), "sweep"));
}

std::string OddSweepsText(const OddSweeps& odd) {
  std::string text =
      fmt::format("lyrefit {}: the sweeps of one module against each other\n", Version());
  text += Field("compared", fmt::format("{}, each with the nearest of the others in Isc and Voc; "
                                        "p-values count them all",
                                        Plural(odd.sweeps.size(), "sweep")));
  text += Field("odd", odd.odd == 0 ? "none" : std::to_string(odd.odd));
  for (const HealthyComparison& sweep : odd.sweeps) {
    if (sweep.differs) text += "\n" + sweep.name + "\n" + Body(sweep);
  }
  return text + (odd.rejected.empty() ? "" : "\n" + List("Not compared", odd.rejected));
}

}  // namespace lyrefit
