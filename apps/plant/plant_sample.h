#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

constexpr std::size_t kPlantMostSampled = 20000;
constexpr std::size_t kPlantMostSpreads = 6;

// Numbers of the rows that have a result: of all, or of kPlantMostSampled that are chosen at random.
struct PlantSample {
  struct Column {
    std::string name;
    std::string unit;
    std::vector<double> values = {};  // by row; NaN: unknown
  };
  std::vector<Column> spreads;     // at most kPlantMostSpreads that tell most of a string
  std::vector<Column> neighbours;  // deviations from the strings of the same combiner
  std::vector<bool> differs;       // by row: whether it differs from them
};

// Takes the sample in constant memory.
class PlantSampler {
 public:
  explicit PlantSampler(const std::vector<ResultColumn>& columns);
  void Add(const ResultRow& row, bool differs);
  const PlantSample& sample() const { return sample_; }

 private:
  RowReader reader_;
  PlantSample sample_;
  std::int64_t seen_ = 0;
  RandomStream random_{1};
};

}  // namespace lyrefit
