#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// Energy that trends say is lost, summed over a group of strings.
struct PlantLosses {
  std::int64_t rows = 0;  // strings whose total loss is known
  // Sums over the strings that tell a part, by part, then of the total: of their reference powers in
  // W, and of these times percent. Operating points do not tell the shunt's.
  std::vector<double> weights;
  std::vector<double> parts;
  double lost_W = 0;  // of the last days, at standard conditions
};

// Losses of all strings, and of the groups of those with the same parent.
struct PlantLossSummary {
  PlantLosses plant;
  std::map<std::string, PlantLosses> groups;  // by path; at most kPlantMostNodes
};

// Parts of a loss, with their titles; the total is last.
struct PlantLossPart {
  const char* column;  // "loss_light_percent"
  const char* title;   // "light"
};
inline constexpr PlantLossPart kPlantLossParts[] = {
    {"loss_light_percent", "light"},
    {"loss_resistance_series_percent", "series resistance"},
    {"loss_recombination_percent", "recombination"},
    {"loss_shunt_percent", "shunt"},
    {"loss_mismatch_percent", "mismatch"},
    {"loss_total_percent", "total"}};

// Sums the columns of task `trend`, if they exist.
class PlantLossCounter {
 public:
  explicit PlantLossCounter(const std::vector<ResultColumn>& columns);
  void Add(const std::string& id, const ResultRow& row);
  const PlantLossSummary& summary() const { return summary_; }

 private:
  RowReader reader_;
  bool counts_ = true;  // the rows have all parts
  PlantLossSummary summary_;
};

}  // namespace lyrefit
