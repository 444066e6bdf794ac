#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/count_rows.h"
#include "plant/additions.h"
#include "plant/scale_judge.h"

namespace lyrefit {

// Adds the judgement of the scale to rows that have what it needs: those of WithPlan.
class ScaleAddition final : public BatchAddition {
 public:
  explicit ScaleAddition(PlantResults* results) : results_(results) {}

  Expected<void> Open(const RowsInput& input) override;
  std::vector<ResultColumn> Columns() const override;
  void Learn(const RowGroup& group) override;
  Expected<void> Add(RowGroup* group) override;
  AddedReport Report() const override;

 private:
  std::vector<std::vector<ScaleMember>> MembersOf(const RowGroup& group) const;

  PlantResults* const results_;
  // What is learned of one run.
  std::optional<RowReader> reader_;  // empty: the rows lack what is needed
  double level_ = 0;
  ScaleScatter scatter_;
  std::int64_t rows_ = 0;
  std::map<std::string, std::int64_t> causes_;  // number of rows for each
};

}  // namespace lyrefit
