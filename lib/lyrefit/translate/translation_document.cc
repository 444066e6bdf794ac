#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/diagnosis_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translation_documents.h"
#include "lyrefit/translate/translation_parts.h"
#include "lyrefit/translate/translation_report.h"

namespace lyrefit {
namespace {

constexpr int kDigits = 4;

std::string TargetWords(const TranslationTarget& target) {
  return fmt::format("{:g} W/m2, {:g} C", target.irradiance_W_m2, target.temperature_C);
}

// A value with its uncertainty, "248.3 +- 4.1", to two significant digits of the uncertainty.
std::string WithUncertainty(double value, double expanded) {
  if (!std::isfinite(value)) return "-";
  if (!(expanded > 0)) return Significant(value, kDigits);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(expanded))));
  return fmt::format("{:.{}f} +- {:.{}f}", value, decimals, expanded, decimals);
}

double ExpandedOf(const TranslatedResult& result, std::size_t k) {
  return k < result.budget.outputs.size() ? result.budget.outputs[k].expanded_uncertainty
                                          : kUnknown;
}

const std::vector<OutputQuantity>& Quantities() {
  static const std::vector<OutputQuantity> quantities = KeyPointQuantities();
  return quantities;
}

std::string HeadOf(const OutputQuantity& quantity) {
  return quantity.unit.empty() ? quantity.title : quantity.title + " (" + quantity.unit + ")";
}

void AddHead(const TranslationReport& report, Section* head) {
  head->heading = fmt::format("{} at {}", report.curve.name, TargetWords(report.target));
  AddMeasurement(report, head);
  const std::vector<std::string> read = SentencesOf(report.curve.assumptions);
  std::vector<std::string> assumed;
  for (const std::string& sentence : report.assumptions) {
    if (std::find(read.begin(), read.end(), sentence) == read.end()) assumed.push_back(sentence);
  }
  AddAssumed(assumed, head);
  const TranslationInputs& at = report.inputs.values;
  if (at.rear_irradiance_W_m2 > 0) {
    AddField(
        "light",
        fmt::format("{:.4g} W/m2 in front, {:.4g} W/m2 behind, bifaciality {:.3g}: {:.5g} W/m2 "
                    "in all (IEC TS 60904-1-2)",
                    at.irradiance_W_m2, at.rear_irradiance_W_m2, at.bifaciality_isc,
                    report.equivalent_irradiance_W_m2),
        head);
  }
  if (at.lead_resistance_ohm > 0) {
    AddField("leads", fmt::format("{:.4g} ohm, taken off before all else", at.lead_resistance_ohm),
             head);
  }
}

Section RunSection(const TranslationReport& report) {
  Section section = {"How it was made"};
  AddField("lyrefit", report.version, &section);
  AddField("seed", std::to_string(report.seed), &section);
  AddField("options", OptionsText(report.non_default_options), &section);
  return section;
}

// The largest line of a budget: "78 % of the variance of Pmax comes of: irradiance, ...".
std::string LargestPart(const UncertaintyBudget& budget, std::size_t output) {
  const BudgetLine* largest = nullptr;
  for (const BudgetLine& line : budget.lines) {
    if (output >= line.entries.size() || !(line.entries[output].share > 0)) continue;
    if (largest == nullptr || line.entries[output].share > largest->entries[output].share) {
      largest = &line;
    }
  }
  if (largest == nullptr) return "";
  return fmt::format("{:.0f} % of the variance of {} comes of: {}.",
                     100 * largest->entries[output].share, budget.outputs[output].quantity.title,
                     largest->title);
}

// The recommended result.
Section AnswerSection(const TranslationReport& report) {
  Section section = {"At " + TargetWords(report.target)};
  const TranslatedResult* best = report.Recommended();
  if (best == nullptr) {
    section.blocks.emplace_back(block::Warning{FullSentence(report.reason)});
    return section;
  }
  const std::vector<double> source = KeyPointVector(report.source);
  const std::vector<double> target = KeyPointVector(best->key_points);
  block::Table table = {"lrrrrrr", {{""}}, {{"measured"}, {"here, k = 2"}}};
  for (std::size_t k = 0; k < Quantities().size(); ++k) {
    table.heads[0].push_back(HeadOf(Quantities()[k]));
    table.rows[0].push_back(Significant(source[k], kDigits + 1));
    table.rows[1].push_back(WithUncertainty(target[k], ExpandedOf(*best, k)));
  }
  AddTable(std::move(table), &section);
  AddSentence(fmt::format("Recommended is {}: {}.", best->title, report.reason), &section);
  const std::string largest = LargestPart(best->budget, kMaxPowerOutput);
  if (!largest.empty()) AddSentence(largest, &section);
  for (const UncertainOutput& output : best->budget.outputs) {
    if (output.agreement == Agreement::kDisagree)
      AddSentence(FullSentence(output.sentence), &section);
  }
  return section;
}

// All procedures side by side.
Section ProcedureSection(const TranslationReport& report) {
  Section section = {"Procedures"};
  block::Table table = {"lrrrrrr", {{"", "Isc", "Voc", "Imp", "Vmp", "Pmax", "FF"}}};
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const TranslatedResult& result = report.results[i];
    if (!result.computed()) {
      missing.push_back(result.title + ": " + result.why_not);
      continue;
    }
    const bool best = static_cast<int>(i) == report.recommended;
    block::Table::Row row = {(best ? "* " : "  ") + result.title};
    const std::vector<double> values = KeyPointVector(result.key_points);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool power = k == kMaxPowerOutput;
      row.push_back(power ? WithUncertainty(values[k], ExpandedOf(result, k))
                          : Significant(values[k], kDigits));
    }
    table.rows.push_back(std::move(row));
  }
  if (!table.rows.empty()) {
    AddTable(std::move(table), &section);
    AddSentence("* recommended; Pmax +- its expanded uncertainty, k = 2", &section);
  }
  // The sentence on Pmax is in its budget; those of ends that disagree stand with the answer.
  const TranslatedResult* best = report.Recommended();
  for (std::size_t k = 0; best != nullptr && k < best->budget.outputs.size(); ++k) {
    const UncertainOutput& output = best->budget.outputs[k];
    const bool said = k == kMaxPowerOutput || output.agreement == Agreement::kDisagree;
    if (!said && !output.sentence.empty()) AddSentence(FullSentence(output.sentence), &section);
  }
  if (!missing.empty()) {
    for (std::string& sentence : missing) sentence.insert(0, "not computed: ");
    AddList(std::move(missing), &section);
  }
  return section;
}

// The verdict of the diagnosis and which causes were kept or removed; other sections show the
// causes.
Section DiagnosisSection(const TranslationReport& report) {
  Section section = {"What the diagnosis says"};
  if (report.verdict.empty()) return section;
  AddSentence(FullSentence(report.verdict), &section);
  const auto add = [&](const char* what, const std::vector<std::string>& titles) {
    for (const std::string& title : titles) AddField(what, title, &section);
  };
  add("acts there too", report.kept);
  add("taken out", report.removed);
  return section;
}

std::vector<Section> CausesOf(const TranslationReport& report) {
  std::vector<Section> sections = {DiagnosisSection(report)};
  if (!report.diagnosis) return sections;
  for (Section& cause : CauseSections(*report.diagnosis)) {
    cause.depth = 1;
    sections.push_back(std::move(cause));
  }
  return sections;
}

Section CoefficientSection(const TranslationReport& report) {
  Section section = {"Coefficients"};
  block::Table table = {"lrl", {{"", "value", "unit"}}};
  const auto first = std::find_if(std::begin(kTranslationInputs), std::end(kTranslationInputs),
                                  [](const TranslationInput& input) {
                                    return input.field == &TranslationInputs::alpha_sc_A_K;
                                  });
  for (auto input = first; input != std::end(kTranslationInputs); ++input) {
    table.rows.push_back(
        {input->title, Significant(report.inputs.values.*input->field, kDigits), input->unit});
  }
  AddTable(std::move(table), &section);
  return section;
}

}  // namespace

Document TranslationDocument(const TranslationReport& report) {
  Document document;
  document.banners =
      Banners(report.interrupted, report.Recommended() != nullptr, report.reason, report.doubts);
  document.verdict = TranslationVerdict(report);
  AddHead(report, &document.head);
  AddSections({{"", {block::Conclusion{document.verdict}}}, AnswerSection(report)}, &document);
  std::vector<Section> tested;
  if (report.field_test) tested = FieldTestSections(*report.field_test);
  if (!tested.empty()) AddSections({Further(tested.front())}, &document);
  Section curve = {"The curve"};
  AddFigure(FigureBlock(report), &curve);
  AddSections({std::move(curve)}, &document);
  for (Section& section : CausesOf(report)) AddSections({Further(std::move(section))}, &document);
  const TranslatedResult* best = report.Recommended();
  const UncertaintyBudget budget = best == nullptr ? UncertaintyBudget{} : best->budget;
  AddSections({Further(ProcedureSection(report)),
               Further(BudgetSection("Budget of Pmax", budget, kMaxPowerOutput))},
              &document);
  if (tested.size() > 1) AddSections({Further(std::move(tested[1]))}, &document);
  AddSections({Further(ChecklistSection(report.checklist)), Further(CoefficientSection(report)),
               Further(ListSection("Assumptions", report.assumptions)), Further(RunSection(report)),
               WarningSection(report.warnings)},
              &document);
  document.signatures = {"Measured by, date", "Approved by, date"};
  return document;
}

std::string TranslationText(const TranslationReport& report, Length length) {
  return DrawText(TranslationDocument(report), length);
}

std::string BriefTranslation(const TranslationReport& report) {
  const TranslatedResult* best = report.Recommended();
  std::string line = fmt::format("{}: ", report.curve.name);
  if (best == nullptr) return line + report.reason + "\n";
  line +=
      fmt::format("Pmax {} W at {} (k = 2, {})",
                  WithUncertainty(best->key_points.max_power_W, ExpandedOf(*best, kMaxPowerOutput)),
                  TargetWords(report.target), best->title);
  if (report.field_test) line += fmt::format(", {}", ToText(report.field_test->zone));
  if (!report.causes.empty()) {
    line += "; ";
    for (std::size_t i = 0; i < report.causes.size(); ++i) {
      line += (i > 0 ? ", " : "") + report.causes[i];
    }
  }
  return line + BriefMarks(report.interrupted, true, report.warnings.size()) + "\n";
}

namespace {

Series Drawn(const CurvePoints& points, SeriesKind kind, const Look& look,
             const std::string& name) {
  Series series;
  series.kind = kind;
  series.look = look;
  series.name = name;
  for (std::size_t i = 0; i < points.voltage_V.size(); ++i) {
    // Points outside the first quadrant are omitted: the device delivers no power there.
    if (points.voltage_V[i] < 0 || points.current_A[i] < 0) continue;
    series.Add(points.voltage_V[i], points.current_A[i]);
  }
  return series;
}

}  // namespace

Figure TranslationFigure(const TranslationReport& report) {
  Figure figure;
  figure.title = fmt::format("{} at {:g} W/m2, {:g} C", report.curve.name,
                             report.target.irradiance_W_m2, report.target.temperature_C);
  Panel panel;
  panel.x.label = "Voltage (V)";
  panel.y.label = "Current (A)";
  panel.x.low = panel.y.low = 0;
  const Look measured = {kGrey, 1, 7};
  figure.legend.push_back({"measured", measured, LegendMark::kPoint});
  panel.series.push_back(Drawn({report.curve.voltage_V, report.curve.current_A},
                               SeriesKind::kPoints, measured, "measured"));
  Series peaks;
  peaks.kind = SeriesKind::kPoints;
  peaks.size = 1.5;
  peaks.name = "maximum power";
  peaks.Add(report.source.max_power_voltage_V, report.source.max_power_current_A);
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const TranslatedResult& result = report.results[i];
    if (!result.computed()) continue;
    const bool best = static_cast<int>(i) == report.recommended;
    const Look look = LookOf(static_cast<int>(i));
    panel.series.push_back(Drawn(result.curve, SeriesKind::kLine, look, result.title));
    panel.series.back().width = best ? 2.5 : 1;
    figure.legend.push_back(
        {result.title + (best ? " (recommended)" : ""), look, LegendMark::kLine});
    peaks.Add(result.key_points.max_power_voltage_V, result.key_points.max_power_current_A);
  }
  double largest_V = 0;
  for (const Series& series : panel.series) {
    for (const auto& row : series.rows) largest_V = std::max(largest_V, row[0]);
  }
  panel.series.push_back(std::move(peaks));
  panel.x.high = 1.03 * largest_V;
  if (report.diagnosis) MarkCauses(*report.diagnosis, &panel);
  figure.panels.push_back(std::move(panel));
  return figure;
}

Expected<void> PlotTranslation(const TranslationReport& report, const std::string& path,
                               PlotPoints points) {
  return DrawFigure(TranslationFigure(report), path, points);
}

}  // namespace lyrefit
