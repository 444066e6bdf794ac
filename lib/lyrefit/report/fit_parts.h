#pragma once
// Functions shared by the documents, tables and pictures of fits, and by those of other records that
// show the same things.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/estimate/fit/estimate_report.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

// Parameters of the largest model; smaller models have the first of them.
std::vector<ParameterInfo> LargestModel(const std::vector<FittedFile>& fits);

// Final value and standard error of the parameter with this symbol.
std::pair<double, double> ValueAndError(const FitReport& report, const ParameterInfo& info);

// fit_parts.cc: conclusions of one or two sentences.
std::string ResidualVerdict(const ResidualStatistics& residuals);
std::string FitVerdict(const FitReport& report);
// Distance of the result from the floor, which is that of any number of diodes. A gap below three
// digits counts as closed.
std::string FloorText(const FitReport& report);
// What residuals hold, for the middle of a sentence.
std::string LeftWords(const FitReport& report);
// Adds what was assumed as one field "assumed" of a few lines; what does not fit is counted. Of
// readings, those of values first.
void AddAssumed(const std::vector<Assumption>& assumptions, Section* section);
void AddAssumed(const std::vector<std::string>& sentences, Section* section);
// A part of Isc such as ", 0.10 % of Isc"; empty if Isc is unknown.
std::string PartOfIsc(double rmse_A, double isc_A);

// fit_plot.cc: the picture of a fit for pages, with a caption and a table of its numbers. A
// figure without panels if there is nothing to draw.
block::Figure FigureBlock(const FitReport& report);

// Digits of tables of readings.
constexpr int kReadingDigits = 6;
constexpr int kResidualDigits = 3;
// Indices of the readings that a table shows; the caption states where the others are.
std::vector<std::size_t> RowsShown(const std::vector<double>& voltage_V,
                                   const std::vector<double>& current_A, std::string* caption);

// Of every estimate, of whatever measurement: a column of a table. `alignment` as in block::Table.
struct EstimateColumn {
  std::string head;
  char alignment = 'r';
  std::function<std::string(const Estimate&)> cell;
};

EstimateColumn SearchedColumn();
// The refined value with so many digits.
EstimateColumn RefinedColumn(int digits = 6);
EstimateColumn ErrorColumn();
EstimateColumn IntervalColumn();

// A row for each estimate: its label, these columns, its marks.
block::Table EstimateTable(const std::vector<Estimate>& estimates,
                           const std::vector<EstimateColumn>& columns);

// How the estimate was found: search, polish, starts, intervals, the further fields, options.
Section CourseSection(const EstimateReport& report,
                      const std::vector<std::pair<std::string, std::string>>& further = {});

// JSON of correlations, search, polish and intervals.
Json CourseJson(const EstimateReport& report);

}  // namespace lyrefit
