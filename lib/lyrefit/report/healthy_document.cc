#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/version.h"
#include "lyrefit/diagnose/healthy.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

Section NowSection(const HealthyComparison& comparison) {
  block::Table table = {"lrrlrrl", {{"", "now", "expected", "95 % interval", "z", "Pmax", ""}}};
  for (const HealthyRow& row : comparison.rows) {
    const std::string label = row.name + (row.unit.empty() ? "" : " (" + row.unit + ")");
    table.rows.push_back({label, Significant(row.now, 4), Significant(row.expected, 4),
                          Range(row.low_95, row.high_95), fmt::format("{:+.1f}", row.z),
                          std::isfinite(row.power) ? fmt::format("{:+.2f} %", 100 * row.power) : "",
                          row.differs ? "differs" : ""});
  }
  Section section = {"Now and as expected"};
  AddTable(std::move(table), &section);
  AddSentence(
      "95 % interval: of what a healthy sweep shows; z: difference in standard deviations of its "
      "prediction; Pmax: what the difference alone gives of it or costs; parameters make up for "
      "one another, the causes do not",
      &section);
  return section;
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

Section CauseSection(const HealthyComparison& comparison) {
  Section section = {"What would make the difference"};
  if (comparison.causes.empty()) return section;
  block::Table table = {"lrlrr", {{"cause", "size", "95 % interval", "Pmax", "explains"}}};
  for (const HealthyCause& cause : comparison.causes) {
    table.rows.push_back({cause.id, fmt::format("{} {}", Significant(cause.size, 3), cause.unit),
                          Range(cause.low_95, cause.high_95),
                          fmt::format("{:+.2f} %", 100 * cause.power),
                          fmt::format("{:.0f} %", 100 * cause.explained)});
  }
  AddTable(std::move(table), &section);
  if (comparison.causes.size() > 1) {
    AddSentence("these sweeps cannot tell one from the other", &section);
  }
  return section;
}

// What there is to say of a sweep, below `heading` if there is one.
void AddSweep(const HealthyComparison& comparison, const std::string& heading, Document* document) {
  std::vector<Section> details = {NowSection(comparison), CauseSection(comparison),
                                  ListSection("Not compared with", comparison.left_out),
                                  ListSection("Warnings", comparison.warnings)};
  for (Section& section : details) section.depth = heading.empty() ? 0 : 1;
  AddSections({{heading, {block::Sentence{comparison.sentence}}}}, document);
  AddSections(std::move(details), document);
}

}  // namespace

Document HealthyDocument(const HealthyComparison& comparison) {
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: {} against healthy sweeps", Version(), comparison.name);
  AddField("compared with", ComparedWith(comparison), &document.head);
  if (!comparison.without_common.voltage_V.empty()) {
    AddField("in common",
             fmt::format("a single diode misses {} % of Isc in all of them; it is taken off the "
                         "readings before they are diagnosed",
                         Significant(100 * comparison.common, 2)),
             &document.head);
  }
  AddSweep(comparison, "", &document);
  return document;
}

Document HealthyDocument(const HealthyComparison& comparison, const Diagnosis& diagnosis) {
  Document document = HealthyDocument(comparison);
  Document below = DiagnosisDocument(diagnosis);
  document.verdict = FullSentence(comparison.sentence) + " " + below.verdict;
  document.banners.insert(document.banners.end(), below.banners.begin(), below.banners.end());
  for (block::Any& any : below.head.blocks) document.head.blocks.push_back(std::move(any));
  AddSections(std::move(below.sections), &document);
  return document;
}

std::string HealthyText(const HealthyComparison& comparison) {
  return DrawText(HealthyDocument(comparison));
}

Document OddSweepsDocument(const OddSweeps& odd) {
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: the sweeps of one module against each other", Version());
  AddField("compared",
           fmt::format("{}, each with the nearest of the others in Isc and Voc; p-values count "
                       "them all",
                       Plural(odd.sweeps.size(), "sweep")),
           &document.head);
  AddField("odd", odd.odd == 0 ? "none" : std::to_string(odd.odd), &document.head);
  for (const HealthyComparison& sweep : odd.sweeps) {
    if (sweep.differs) AddSweep(sweep, sweep.name, &document);
  }
  AddSections({ListSection("Not compared", odd.rejected)}, &document);
  return document;
}

std::string OddSweepsText(const OddSweeps& odd) { return DrawText(OddSweepsDocument(odd)); }

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

}  // namespace lyrefit
