#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/translate/translation_parts.h"

namespace lyrefit {
namespace {

constexpr double kWorthALine = 5e-4;  // smallest share of the variance with its own line

std::string PerCent(double part, int decimals) {
  return std::isfinite(part) ? fmt::format("{:.{}f} %", 100 * part, decimals) : "-";
}

block::Table::Row LineRow(const BudgetLine& line, const UncertainOutput& of, std::size_t output) {
  const BudgetEntry& entry = line.entries[output];
  std::string size;
  if (std::isfinite(line.standard_uncertainty)) {
    size = Significant(line.standard_uncertainty, 2);
    if (!line.unit.empty()) size += " " + line.unit;
  }
  return {line.title, size, PerCent(std::fabs(entry.contribution / of.value), 2),
          PerCent(entry.share, 1), line.source};
}

// Adds the lines of a budget, the largest first, and returns the number of the smaller ones.
std::size_t AddLines(const UncertaintyBudget& budget, std::size_t output, block::Table* table) {
  std::vector<const BudgetLine*> lines;
  for (const BudgetLine& line : budget.lines) {
    if (line.entries[output].share >= kWorthALine) lines.push_back(&line);
  }
  std::stable_sort(lines.begin(), lines.end(), [&](const BudgetLine* a, const BudgetLine* b) {
    return a->entries[output].share > b->entries[output].share;
  });
  for (const BudgetLine* line : lines) {
    table->rows.push_back(LineRow(*line, budget.outputs[output], output));
  }
  return budget.lines.size() - lines.size();
}

std::string InUnit(const std::string& text, const OutputQuantity& quantity) {
  return quantity.unit.empty() ? text : text + " " + quantity.unit;
}

std::string WattRange(double low_W, double high_W) {
  return fmt::format("{:.1f} .. {:.1f} W", low_W, high_W);
}

}  // namespace

Section BudgetSection(const std::string& heading, const UncertaintyBudget& budget,
                      std::size_t output) {
  Section section = {heading};
  if (output >= budget.outputs.size()) return section;
  const UncertainOutput& of = budget.outputs[output];
  block::Table table = {"lrrrw", {{"", "u (k = 1)", "in parts", "share", "from"}}};
  const std::size_t small = AddLines(budget, output, &table);
  AddTable(std::move(table), &section);
  std::string text = fmt::format(
      "Together {} of {}, expanded (k = {:g}) {}", PerCent(of.standard_uncertainty / of.value, 2),
      of.quantity.title, budget.coverage_factor, PerCent(of.expanded_uncertainty / of.value, 2));
  if (small > 0) text += fmt::format("; {} of less than 0.05 % each", Plural(small, "line"));
  AddSentence(FullSentence(text), &section);
  if (budget.draws > 0 && std::isfinite(of.drawn.low)) {
    AddSentence(
        FullSentence(fmt::format(
            "Linear propagation {}, {} draws (seed {}) {}: {}",
            InUnit(Range(of.value - of.expanded_uncertainty, of.value + of.expanded_uncertainty),
                   of.quantity),
            budget.draws, budget.seed, InUnit(Range(of.drawn.low, of.drawn.high), of.quantity),
            ToText(of.agreement))),
        &section);
  }
  if (!of.sentence.empty()) AddSentence(FullSentence(of.sentence), &section);
  return section;
}

std::vector<Section> FieldTestSections(const FieldTest& test) {
  Section section = {"Field test"};
  section.blocks.emplace_back(block::Conclusion{FullSentence(test.sentence)});
  block::Table table = {"lrr", {{"", "value", "k = 2"}}};
  table.rows = {
      {"rating", fmt::format("{:.1f} W", test.rated_W), ""},
      {"least allowed (" + test.tolerance + ")", fmt::format("{:.1f} W", test.lowest_W), ""},
      {"Pmax at 1000 W/m2, 25 C", fmt::format("{:.1f} W", test.standard_W),
       WattRange(test.standard_low_W, test.standard_high_W)},
      {"Pmax measured", fmt::format("{:.1f} W", test.measured_W), ""},
      {"Pmax predicted there", fmt::format("{:.1f} W", test.predicted_W), ""},
      {"performance factor", fmt::format("{:.3f}", test.performance_factor),
       fmt::format("{:.3f} .. {:.3f}", test.performance_low, test.performance_high)},
      {"probability of conformity", ConformityText(test), ""}};
  AddTable(std::move(table), &section);
  AddSentence(
      fmt::format("Predicted by {}. The probability of conformity (JCGM 106) is that of the true "
                  "power being at least the least allowed one, where nothing is known of the "
                  "string but this measurement (flat prior); from 20 to 80 % is undecided",
                  test.predicted_by),
      &section);
  if (!test.notes.empty()) AddList(test.notes, &section);
  Section budget = BudgetSection("Budget of the performance factor", test.performance_budget, 0);
  return {std::move(section), std::move(budget)};
}

Section ChecklistSection(const Checklist& checklist) {
  Section section = {"Conditions of the measurement"};
  if (checklist.conditions.empty()) return section;
  AddSentence(FullSentence(checklist.sentence), &section);
  block::Table table = {"llw", {{"", "", "found"}}};
  std::vector<std::string> cures;
  for (const CheckedCondition& each : checklist.conditions) {
    const std::string asked = each.clause.empty() ? "" : " (" + each.clause + ")";
    const std::string from = each.source.empty() ? "" : " (" + each.source + ")";
    table.rows.push_back({each.title + asked, ToText(each.state), each.found + from});
    if (!each.cure.empty()) cures.push_back(each.title + ": " + each.cure);
  }
  AddTable(std::move(table), &section);
  if (!cures.empty()) AddList(std::move(cures), &section);
  return section;
}

}  // namespace lyrefit
