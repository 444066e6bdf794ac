#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/result_row.h"
#include "plant/plant_losses.h"
#include "plant/plant_sample.h"
#include "plant/string_verdict.h"

namespace lyrefit {

// Summary of the rows of a plant, in constant memory. Columns are found by their names
// (batch/plant_page.h). Members of missing columns stay empty.

// A row as listed in the tables that need no script.
struct PlantRow {
  std::string id, reason, page, sparkline, onset_date, largest_loss;
  StringVerdict verdict;
  double performance_factor = kUnknown;
  double Pmax_stc_W = kUnknown;
  double below_rating_W = kUnknown;
  double deviation_percent = kUnknown;
  double lost_now_percent = kUnknown;  // of a trend

  // What the string gives less by its cause, else than its rating.
  double lost_W() const { return LostBy(verdict, below_rating_W); }
};

struct PlantShare {
  std::int64_t rows = 0;
  double recoverable_power_W = 0;
  double below_rating_W = 0;
  std::string title;  // title of a cause, if the rows have one
};

// A node of the plant's tree: site, inverter, combiner.
struct PlantNode {
  std::int64_t rows = 0;
  std::int64_t in_need = 0;  // number of strings that need work
  double lowest_performance = kUnknown;
  std::map<std::string, PlantShare> causes = {};  // of strings that need work, by title
};

struct PlantSummary {
  std::int64_t rows = 0;
  std::int64_t fine = 0;           // number of rows with the status "fine"
  std::int64_t passed = 0;         // number of rows with a passing zone
  std::int64_t in_need = 0;        // number of rows that need work, or their plan
  std::int64_t to_repeat = 0;      // number of rows with a cause of the measurement alone
  double recoverable_power_W = 0;  // sum over rows that need work
  double below_rating_W = 0;       // shortfall of rows that need work and are below their rating
  double power_W = 0;              // sum of the known power at standard conditions over all rows
  std::string judged_by;           // the column that determines who needs work: zone, cause or none
  std::string titled_by;           // the column of the causes' titles, or none
  bool tells_what_to_do = false;   // whether there is a column string_to_do
  std::map<std::string, PlantShare> status, zones, causes;  // causes of rows that need work
  std::map<std::string, PlantShare> causes_of_passed;
  std::map<std::string, PlantShare> causes_to_repeat;
  std::map<std::string, PlantShare> reasons;  // of rows that are not fine
  // Number of rows that need no work but differ from their neighbours.
  std::int64_t passed_outlier = 0;
  std::string first_date, last_date;
  std::vector<PlantRow> worst;     // at most kPlantWorst, the worst first
  std::string worst_by;            // the column that ranks them
  std::vector<PlantRow> broken;    // the first kPlantListed rows that are not fine
  std::vector<PlantRow> outliers;  // at most kPlantListed that differ from their neighbours, those
                                   // that differ most first
  // Nodes by depth: [0] the first levels of the ids, [1] the first two, ... A depth with more than
  // kPlantMostNodes nodes is dropped.
  std::vector<std::map<std::string, PlantNode>> levels;
  PlantSample sample;
  PlantLossSummary losses;  // of trends
};

constexpr std::size_t kPlantWorst = 100;
constexpr std::size_t kPlantListed = 25;
constexpr std::size_t kPlantMostNodes = 2000;
// Different statuses, causes, ...; further ones are counted as "others".
constexpr std::size_t kPlantMostWords = 200;

// Key among the causes for strings that need work without a cause.
constexpr char kNoCause[] = "no cause found";

class PlantCounter {
 public:
  explicit PlantCounter(const std::vector<ResultColumn>& columns);
  void Add(const ResultRow& row);
  // Summary of the rows added so far.
  PlantSummary Summary() const;

 private:
  // Rows with what ranks them, the first of it first; a heap with the smallest on top.
  using Rank = std::array<double, 3>;
  using Ranked = std::vector<std::pair<Rank, PlantRow>>;
  double Badness(const ResultRow& row) const;
  void CountWords(const PlantRow& row, const std::string& status);
  void CountDate(const std::string& date);
  void CountTree(const PlantRow& row);
  static void Keep(Rank rank, const PlantRow& row, std::size_t most, Ranked* ranked);
  static std::vector<PlantRow> InOrder(Ranked ranked);

  RowReader reader_;
  std::string ranked_by_;  // the column of Badness; empty: there is none
  double worse_ = 1;       // its sign towards the worst
  StringJudge judge_;
  PlantSummary sum_;
  std::map<std::string, std::string> first_reasons_;  // of each kind (base/reasons.h)
  std::size_t deepest_ = 8;                           // number of tree levels that are counted
  Ranked worst_, outliers_;
  PlantSampler sampler_;
  PlantLossCounter losses_;
};

}  // namespace lyrefit
