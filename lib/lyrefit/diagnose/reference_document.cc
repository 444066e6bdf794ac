#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/version.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

Section NowSection(const ReferenceComparison& comparison) {
  block::Table table = {"lrrlrr", {{"", "now", "expected", "95 % interval", "z", "Pmax"}}};
  for (const ReferenceRow& row : comparison.rows) {
    const std::string label =
        row.name + (row.unit.empty() ? "" : " (" + row.unit + ")") + (row.differs ? " <-" : "");
    table.rows.push_back(
        {label, Significant(row.now, 4), Significant(row.expected, 4),
         Range(row.low_95, row.high_95), fmt::format("{:+.1f}", row.z),
         std::isfinite(row.power) ? fmt::format("{:+.2f} %", 100 * row.power) : ""});
  }
  Section section = {"Now and as expected"};
  AddTable(std::move(table), &section);
  AddSentence(
      "<- marks what differs. The 95 % interval is that of what a reference sweep shows. z is the "
      "difference in standard deviations of its prediction. Pmax is what the difference alone adds "
      "or costs. Parameters can make up for one another, causes cannot.",
      &section);
  return section;
}

std::string ComparedWith(const ReferenceComparison& comparison) {
  std::string text = Plural(comparison.references.size(), "reference sweep");
  if (comparison.regressed_on.empty()) return text + ", their mean";
  text += ", brought to this sweep's";
  for (std::size_t i = 0; i < comparison.regressed_on.size(); ++i) {
    text += (i > 0 ? " and " : " ") + comparison.regressed_on[i];
  }
  return text;
}

Section CauseSection(const ReferenceComparison& comparison) {
  Section section = {"What would make the difference"};
  if (comparison.causes.empty()) return section;
  block::Table table = {"lrlrr", {{"cause", "size", "95 % interval", "Pmax", "explains"}}};
  for (const ReferenceCause& cause : comparison.causes) {
    const CauseParameter& size = cause.strength.front();
    table.rows.push_back({cause.id, fmt::format("{} {}", Significant(size.value, 3), size.unit),
                          Range(size.low_95, size.high_95),
                          fmt::format("{:+.2f} %", -100 * cause.power_effect.value),
                          fmt::format("{:.0f} %", 100 * cause.explained)});
  }
  AddTable(std::move(table), &section);
  if (comparison.causes.size() > 1) {
    AddSentence("these sweeps cannot tell one from the other", &section);
  }
  return section;
}

// Adds the sections of one sweep, below `heading` if it is not empty.
void AddSweep(const ReferenceComparison& comparison, const std::string& heading,
              Document* document) {
  std::vector<Section> details = {NowSection(comparison), CauseSection(comparison),
                                  ListSection("Not compared with", comparison.left_out),
                                  ListSection("Warnings", comparison.warnings)};
  for (Section& section : details) section.depth = heading.empty() ? 0 : 1;
  AddSections({{heading, {block::Sentence{comparison.sentence}}}}, document);
  AddSections(std::move(details), document);
}

}  // namespace

Document ReferenceDocument(const ReferenceComparison& comparison) {
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: {} against reference sweeps", Version(), comparison.name);
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

Document ReferenceDocument(const ReferenceComparison& comparison, const Diagnosis& diagnosis) {
  Document document = ReferenceDocument(comparison);
  Document below = DiagnosisDocument(diagnosis);
  document.verdict = FullSentence(comparison.sentence) + " " + below.verdict;
  document.banners.insert(document.banners.end(), below.banners.begin(), below.banners.end());
  for (block::Any& any : below.head.blocks) document.head.blocks.push_back(std::move(any));
  AddSections(std::move(below.sections), &document);
  return document;
}

std::string ReferenceText(const ReferenceComparison& comparison) {
  return DrawText(ReferenceDocument(comparison));
}

Document OutlierSweepsDocument(const OutlierSweeps& outliers) {
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: the sweeps of one module against each other", Version());
  AddField("compared",
           fmt::format("{}, each with the nearest of the others in Isc and Voc; p-values count "
                       "them all",
                       Plural(outliers.sweeps.size(), "sweep")),
           &document.head);
  AddField("outliers", outliers.outlier == 0 ? "none" : std::to_string(outliers.outlier),
           &document.head);
  for (const ReferenceComparison& sweep : outliers.sweeps) {
    if (sweep.differs) AddSweep(sweep, sweep.name, &document);
  }
  AddSections({ListSection("Not compared", outliers.rejected)}, &document);
  return document;
}

std::string OutlierSweepsText(const OutlierSweeps& outliers) {
  return DrawText(OutlierSweepsDocument(outliers));
}

std::string BriefReference(const ReferenceComparison& comparison) {
  return comparison.name + ": " + comparison.sentence + "\n";
}

std::string BriefOutlierSweeps(const OutlierSweeps& outliers) {
  std::string text;
  for (const ReferenceComparison& sweep : outliers.sweeps) {
    if (sweep.differs) text += BriefReference(sweep);
  }
  return text + fmt::format("outliers: {} of {}\n", outliers.outlier,
                            Plural(outliers.sweeps.size(), "sweep"));
}

}  // namespace lyrefit
