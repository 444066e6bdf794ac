#pragma once
// Elements shared by the documents on comparisons.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// A column of a table: its head, and the text of a row's cell. The first one is left-aligned.
template <class Row>
struct ColumnOf {
  std::string head;
  std::function<std::string(const Row&)> cell;
  bool shown = true;  // columns that are not shown are not chosen
};

// Appends the rows' cells of the chosen columns.
template <class Row>
void AddRows(const std::vector<Row>& rows, const std::vector<ColumnOf<Row>>& columns,
             block::Table* table) {
  for (const Row& row : rows) {
    block::Table::Row line;
    for (const ColumnOf<Row>& column : columns) {
      if (column.shown) line.push_back(column.cell(row));
    }
    table->rows.push_back(std::move(line));
  }
}

// A table of the rows in the chosen columns.
template <class Row>
block::Table TableOf(const std::vector<Row>& rows, const std::vector<ColumnOf<Row>>& columns,
                     std::string caption = {}) {
  block::Table table = {"", {{}}, {}, std::move(caption)};
  for (const ColumnOf<Row>& column : columns) {
    if (!column.shown) continue;
    table.alignment += table.alignment.empty() ? 'l' : 'r';
    table.heads[0].push_back(column.head);
  }
  AddRows(rows, columns, &table);
  return table;
}

// The objective and the effects of all models: "measured-current, ...".
std::string ObjectiveText(const CompareOptions& options);

// "rtc_france, double-diode model, bounds literature"
std::string ProblemTitle(const ProblemResult& problem);

// Number of runs behind the figures of a problem: "50", or "12 to 13 of 50" if it was stopped
// early.
std::string RunsText(const Comparison& comparison, const ProblemResult& problem);

// Warnings about the readings, and about bounds that are searched in part only.
std::vector<std::string> CompareWarnings(const Comparison& comparison);

// Warnings about the readings, and whether the study was stopped early.
std::vector<std::string> CompareBanners(const Comparison& comparison);

// Adds the fields that apply to every table: objective, budget, seed.
void AddSetUp(const Comparison& comparison, Section* section);

// A section titled with the problem, with a field that describes the reference.
Section ProblemSection(const Comparison& comparison, const ProblemResult& problem);

// Friedman's and Wilcoxon's tests of one problem, and one sentence on
// the ranking after the polish. Each has no blocks if there is no result.
Section RankSection(const ProblemResult& problem);
Section PolishVerdict(const ProblemResult& problem);

// Figures of a comparison, one panel for each problem; documents.h describes them. At least one
// problem is required.
Figure BoxFigure(const Comparison& comparison);
Figure ConvergenceFigure(const Comparison& comparison);

}  // namespace lyrefit
