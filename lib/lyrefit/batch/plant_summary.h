#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// What the rows of a plant come to, in a space that does not grow with their number. Columns are
// found by their names (batch/plant_page.h); what a column that is missing would say stays empty.

// A row as the tables name it that must be read without a script.
struct PlantRow {
  std::string id, zone, cause, cause_title, reason, page;
  double performance_factor = kUnknown;
  double Pmax_stc_W = kUnknown;
  double recoverable_power_W = kUnknown;
};

struct PlantShare {
  std::int64_t rows = 0;
  double recoverable_power_W = 0;
  std::string title;  // of a cause, where the rows give one
};

// A node of the plant's tree: site, inverter, combiner.
struct PlantNode {
  std::int64_t rows = 0;
  std::int64_t in_need = 0;  // that need work
  double lowest_performance = kUnknown;
};

struct PlantSummary {
  std::int64_t rows = 0;
  std::int64_t fine = 0;           // by their status
  std::int64_t passed = 0;         // by their zone
  std::int64_t in_need = 0;        // that need work: see NeedsWork
  std::int64_t to_repeat = 0;      // that show a cause of the measurement alone and do not fail
  double recoverable_power_W = 0;  // of those that need work
  double below_rating_W = 0;       // of those that need work and are below it
  double power_W = 0;              // at standard conditions where known, of all
  std::string judged_by;           // the column that says who needs work: zone, cause or none
  std::map<std::string, PlantShare> status, zones, causes;  // causes of those that need work
  std::map<std::string, PlantShare> causes_of_passed;
  std::map<std::string, PlantShare> causes_to_repeat;
  std::map<std::string, PlantShare> reasons;  // of rows that are not fine
  std::int64_t passed_outlier = 0;                // that need no work but differ from their neighbours
  std::string first_date, last_date;
  std::vector<PlantRow> worst;   // at most kPlantWorst, the worst first
  std::string worst_by;          // the column that says so
  std::vector<PlantRow> broken;  // the first kPlantWorst rows that are not fine
  // By depth: [0] the first levels of the ids, [1] the first two, ... One that has more than
  // kPlantMostNodes is dropped.
  std::vector<std::map<std::string, PlantNode>> levels;
  // Rows by performance factor in steps of 0.01; the last also holds what lies above.
  std::array<std::int64_t, 151> performance{};
};

constexpr std::size_t kPlantWorst = 25;
constexpr std::size_t kPlantMostNodes = 2000;
constexpr std::size_t kPlantMostWords = 200;  // of statuses, causes, ...; the rest are "others"

// Stands among the causes for strings that need work and show none.
constexpr char kNoCause[] = "no cause found";

class PlantCounter {
 public:
  explicit PlantCounter(const std::vector<ResultColumn>& columns);
  void Add(const ResultRow& row);
  // Of the rows so far.
  PlantSummary Summary() const;

 private:
  enum Known {
    kId,
    kStatus,
    kReason,
    kDate,
    kZone,
    kCause,
    kCauseTitle,
    kCauseAbout,
    kPerformance,
    kPower,
    kRecoverable,
    kDeviation,
    kDeparture,
    kPage,
    kBelow,
    kDiffers,
    kColumns
  };
  std::string Text(const ResultRow& row, Known column) const;
  double Number(const ResultRow& row, Known column) const;
  bool Has(Known column) const { return places_[column] >= 0; }
  bool NeedsWork(const std::string& zone, const std::string& cause) const;
  bool ToRepeat(const ResultRow& row) const;
  bool Differs(const ResultRow& row) const;
  double Badness(const ResultRow& row) const;
  void CountWords(const PlantRow& row, const std::string& status, bool needs_work, bool to_repeat);
  void CountDate(const std::string& date);
  void CountTree(const PlantRow& row, bool needs_work);
  void CountWorst(double badness, const PlantRow& row);

  std::array<int, kColumns> places_{};
  PlantSummary sum_;
  std::size_t deepest_ = 8;                         // levels of the tree that are counted
  std::vector<std::pair<double, PlantRow>> worst_;  // a heap, the least bad on top
};

// No cause was found, in any of the ways of writing that.
bool IsNoCause(const std::string& cause);

}  // namespace lyrefit
