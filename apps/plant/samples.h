#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/report/csv.h"
#include "plant/additions.h"
#include "plant/sample_summary.h"

namespace lyrefit {

// Collects the statistics of samples from the rows of task `cell`. It keeps ten numbers a pixel, as
// quartiles need them.
class SampleCounter {
 public:
  explicit SampleCounter(const std::vector<ResultColumn>& columns) : reader_(columns) {}

  // Whether the rows have the columns of task `cell`.
  bool counts() const { return reader_.Has("sample") && reader_.Has("state"); }
  void Count(const ResultRow& row);
  // In the order of the samples' first rows.
  std::vector<SampleSummary> Summaries() const;

 private:
  struct Direction {
    std::array<std::vector<double>, kSampleQuantities.size()> values;
    SampleDirection found;
  };
  struct Sample {
    SampleSummary summary;
    std::array<Direction, 2> directions;
  };
  // `prefix`: of the names of the columns of the direction.
  void CountDirection(const ResultRow& row, const std::string& id, const std::string& prefix,
                      Direction* direction) const;

  RowReader reader_;
  std::map<std::string, std::size_t> places_;  // of the samples, by name
  std::vector<Sample> samples_;
};

// Adds the files of the samples, a row for each sample and direction, to the results of task `cell`.
class SampleAddition final : public BatchAddition {
 public:
  explicit SampleAddition(PlantResults* results) : results_(results) {}

  std::vector<std::string> FileNames() const override;
  Expected<void> Open(const RowsInput& input) override;
  Expected<void> Add(RowGroup* group) override;
  AddedReport Report() const override;
  std::vector<ResultFile> Files() const override;
  void AddToSchema(BatchJson* schema) const override;

 private:
  PlantResults* const results_;
  // What is learned of one run.
  std::optional<SampleCounter> counter_;  // empty: the rows are not those of task `cell`
  std::string working_pixel_;             // PixelCriterion() of the run
  CsvTexts texts_ = CsvTexts::kSafe;
};

}  // namespace lyrefit
