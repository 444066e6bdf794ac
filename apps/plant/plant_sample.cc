#include "plant/plant_sample.h"

#include <algorithm>

#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

// Columns whose distributions tell most, in this order; others follow.
constexpr const char* kSpreads[] = {"performance_factor",
                                    "loss_total_percent",
                                    "loss_now_total_percent",
                                    "p_mp_rate_percent",
                                    "resistance_series_rate_ohm",
                                    "loss_light_percent",
                                    "loss_mismatch_percent",
                                    "Pmax_stc_W",
                                    "FF",
                                    "Rs_ohm",
                                    "irradiance_Wm2",
                                    "temperature_C",
                                    "Pmax_W",
                                    "Voc_V",
                                    "Isc_A"};
constexpr const char* kNeighbours[] = {"group_Isc_percent", "group_Voc_percent", "group_FF_percent",
                                       "group_deviation_percent"};

bool IsNumber(const ResultColumn& column) {
  return column.type == CellType::kNumber || column.type == CellType::kWhole;
}

}  // namespace

double NumberAt(const ResultRow& row, std::size_t place) {
  if (place >= row.cells.size()) return kUnknown;
  if (const double* number = std::get_if<double>(&row.cells[place])) return *number;
  const auto* whole = std::get_if<std::int64_t>(&row.cells[place]);
  return whole ? static_cast<double>(*whole) : kUnknown;
}

PlantSampler::PlantSampler(const std::vector<ResultColumn>& columns) {
  const auto add = [&](const auto& wanted, std::size_t most, std::vector<PlantSample::Column>* to) {
    for (std::size_t c = 0; c < columns.size() && to->size() < most; ++c) {
      if (!IsNumber(columns[c]) || !wanted(columns[c].name)) continue;
      if (std::count(places_.begin(), places_.end(), c) > 0) continue;
      places_.push_back(c);
      to->push_back({columns[c].name, columns[c].unit});
    }
  };
  for (const char* name : kSpreads) {
    add([&](const std::string& column) { return column == name; }, kPlantMostSpreads,
        &sample_.spreads);
  }
  add([](const std::string& column) { return column.rfind("group_", 0) != 0; }, kPlantMostSpreads,
      &sample_.spreads);
  for (const char* name : kNeighbours) {
    add([&](const std::string& column) { return column == name; }, columns.size(),
        &sample_.neighbours);
  }
}

// Each row is in the sample with equal probability (reservoir sampling).
void PlantSampler::Add(const ResultRow& row, bool differs) {
  const std::int64_t seen = ++seen_;
  std::size_t at = sample_.differs.size();
  const bool more = at < kPlantMostSampled;
  if (!more) at = static_cast<std::size_t>(random_.Uniform() * static_cast<double>(seen));
  if (at >= kPlantMostSampled) return;
  if (more) sample_.differs.push_back(false);
  sample_.differs[at] = differs;
  std::size_t place = 0;
  for (auto* columns : {&sample_.spreads, &sample_.neighbours}) {
    for (PlantSample::Column& column : *columns) {
      if (more) column.values.push_back(kUnknown);
      column.values[at] = NumberAt(row, places_[place++]);
    }
  }
}

}  // namespace lyrefit
