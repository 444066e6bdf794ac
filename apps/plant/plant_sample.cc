#include "plant/plant_sample.h"

#include <set>

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

PlantSampler::PlantSampler(const std::vector<ResultColumn>& columns) : reader_(columns) {
  std::set<std::string> taken;
  const auto add = [&](const auto& wanted, std::size_t most, std::vector<PlantSample::Column>* to) {
    for (std::size_t c = 0; c < columns.size() && to->size() < most; ++c) {
      if (!IsNumber(columns[c]) || !wanted(columns[c].name)) continue;
      if (taken.insert(columns[c].name).second) to->push_back({columns[c].name, columns[c].unit});
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
  for (auto* columns : {&sample_.spreads, &sample_.neighbours}) {
    for (PlantSample::Column& column : *columns) {
      if (more) column.values.push_back(kUnknown);
      column.values[at] = reader_.Number(row, column.name);
    }
  }
}

}  // namespace lyrefit
