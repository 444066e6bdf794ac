#include "plant/neighbours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/append.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/count_rows.h"
#include "plant/samples.h"

namespace lyrefit {
namespace {

bool Alike(double a, double b, double like_light) {
  return std::fabs(a - b) <= like_light * std::max(a, b);
}

NeighbourDeviation DeviationOf(std::size_t i, const std::vector<Neighbour>& group,
                               double like_light) {
  NeighbourDeviation deviation;
  std::array<std::vector<double>, kNeighbourQuantities> peers;
  if (!(group[i].irradiance_W_m2 > 0)) return deviation;
  int count = 0;
  for (std::size_t j = 0; j < group.size(); ++j) {
    const Neighbour& other = group[j];
    const bool peer = j != i && other.irradiance_W_m2 > 0 &&
                      Alike(group[i].irradiance_W_m2, other.irradiance_W_m2, like_light);
    if (!peer) continue;
    ++count;
    for (int q = 0; q < kNeighbourQuantities; ++q) {
      if (std::isfinite(other.values[q])) peers[q].push_back(other.values[q]);
    }
  }
  bool compared = false;
  for (int q = 0; q < kNeighbourQuantities; ++q) {
    if (static_cast<int>(peers[q].size()) < kLeastPeers) continue;
    const double usual = Median(peers[q]);
    if (!(usual > 0) || !std::isfinite(group[i].values[q])) continue;
    deviation.parts[q] = group[i].values[q] / usual - 1;
    compared = true;
  }
  if (compared) deviation.peers = count;
  return deviation;
}

// Values of |deviation| of one quantity in one group.
std::vector<double> Sizes(const std::vector<NeighbourDeviation>& group, int q) {
  std::vector<double> sizes;
  for (const NeighbourDeviation& one : group) {
    if (std::isfinite(one.parts[q])) sizes.push_back(std::fabs(one.parts[q]));
  }
  return sizes;
}

}  // namespace

std::vector<NeighbourDeviation> DeviationsAmong(const std::vector<Neighbour>& group,
                                                double like_light) {
  std::vector<NeighbourDeviation> deviations;
  deviations.reserve(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    deviations.push_back(DeviationOf(i, group, like_light));
  }
  return deviations;
}

void NeighbourScatter::Add(const std::vector<NeighbourDeviation>& group) {
  for (int q = 0; q < kNeighbourQuantities; ++q) {
    const std::vector<double> sizes = Sizes(group, q);
    for (const double size : sizes) counts_[q].bins.Add(size);
    counts_[q].groups += sizes.empty() ? 0 : 1;
  }
}

std::array<double, kNeighbourQuantities> NeighbourScatter::Limits(
    const std::vector<NeighbourDeviation>& group, double level) const {
  std::array<double, kNeighbourQuantities> limits{};
  for (int q = 0; q < kNeighbourQuantities; ++q) {
    const Count& count = counts_[q];
    limits[q] = kInfinity;
    const double degrees = kMadEfficiency * static_cast<double>(count.bins.count() - count.groups);
    if (degrees < 1) continue;
    const double plant = count.bins.Median();
    const double own = Median(Sizes(group, q));
    const double t = StudentQuantile(1 - level / (2 * kNeighbourQuantities), degrees);
    limits[q] = t * kMedianToSigma * std::fmax(plant, own);
  }
  return limits;
}

std::vector<ResultColumn> NeighbourColumns() {
  constexpr CellType kNumber = CellType::kNumber;
  return {
      {"group_peers", "", CellType::kWhole,
       "strings of the same combiner at like light that it is compared with; none: not compared"},
      {"group_Isc_percent", "%", kNumber,
       "short-circuit current per irradiance against the median of its peers"},
      {"group_Voc_percent", "%", kNumber, "open-circuit voltage against the median of its peers"},
      {"group_FF_percent", "%", kNumber, "fill factor against the median of its peers"},
      {"group_deviation_percent", "%", kNumber,
       "maximum power per irradiance against the median of its peers"},
      {"group_flag", "", CellType::kTruth, "differs from its peers by more than is usual"},
      {"group_outlier", "", CellType::kText, "in what it differs, with the limit of what is usual"},
  };
}

std::vector<ResultCell> NeighbourCells(const NeighbourDeviation& deviation,
                                       const std::array<double, kNeighbourQuantities>& limits) {
  if (deviation.peers == 0) return std::vector<ResultCell>(kNeighbourQuantities + 3);
  static constexpr const char* kNames[] = {"Isc/G", "Voc", "FF", "Pmax/G"};
  std::vector<ResultCell> cells = {std::int64_t{deviation.peers}};
  std::vector<std::string> differences;
  for (int q = 0; q < kNeighbourQuantities; ++q) {
    const double part = deviation.parts[q];
    cells.push_back(NumberCell(100 * part));
    if (!(std::fabs(part) > limits[q])) continue;
    differences.push_back(fmt::format("{} {:+.2f} % (usual: within {:.2f} %)", kNames[q],
                                      100 * part, 100 * limits[q]));
  }
  cells.emplace_back(!differences.empty());
  cells.push_back(ListCell(differences, ", "));
  return cells;
}

void NeighbourAddition::AddOptions(BatchJson* options) const {
  (*options)["group-level"] = options_.group_level;
  (*options)["like-light"] = options_.like_light;
}

Expected<std::vector<ResultFile>> NeighbourAddition::Begin(const BatchTaskType& /*task*/,
                                                           const std::string& /*folder*/,
                                                           BatchJson* /*options*/) const {
  TRY(ValidateOptions(options_, kPlantOptionTable));
  return std::vector<ResultFile>();
}

Expected<void> NeighbourAddition::Open(const RowsInput& input) {
  const BatchJson& options = input.head.at("options");
  const auto place = [&](const char* name) { return ColumnPlace(input.columns, name); };
  state_ = {};
  state_.level = options.value("group-level", 0.0);
  state_.like_light = options.value("like-light", 0.0);
  state_.of_pixels = SampleCounter(input.columns).counts();
  state_.irradiance = place("irradiance_Wm2");
  state_.isc = place("Isc_A");
  state_.voc = place("Voc_V");
  state_.ff = place("FF");
  state_.pmax = place("Pmax_W");
  return {};
}

std::vector<NeighbourDeviation> NeighbourAddition::Deviations(const RowGroup& group) const {
  if (!group.together) return std::vector<NeighbourDeviation>(group.rows.size());
  std::vector<Neighbour> members;
  for (const ResultRow& row : group.rows) {
    const auto number = [&row](std::size_t place) {
      const auto* const found = CellAt<double>(row, place);
      return found == nullptr ? kUnknown : *found;
    };
    const double light = number(state_.irradiance);
    members.push_back({light,
                       {number(state_.isc) / light, number(state_.voc), number(state_.ff),
                        number(state_.pmax) / light}});
  }
  return DeviationsAmong(members, state_.like_light);
}

void NeighbourAddition::Learn(const RowGroup& group) {
  if (group.together) state_.scatter.Add(Deviations(group));
}

Expected<void> NeighbourAddition::Add(RowGroup* group) {
  const auto deviations = Deviations(*group);
  std::array<double, kNeighbourQuantities> limits{};
  if (group->together) limits = state_.scatter.Limits(deviations, state_.level);
  for (std::size_t i = 0; i < group->rows.size(); ++i) {
    std::vector<ResultCell> cells = NeighbourCells(deviations[i], limits);
    if (const auto* const flag = std::get_if<bool>(&cells[kNeighbourQuantities + 1])) {
      ++state_.compared;
      state_.flagged += *flag ? 1 : 0;
    }
    Append(std::move(cells), &group->rows[i].cells);
  }
  return {};
}

AddedReport NeighbourAddition::Report() const {
  AddedReport report;
  if (results_ != nullptr) {
    results_->compared = state_.compared;
    results_->flagged = state_.flagged;
  }
  if (state_.compared == 0) return report;
  report.fields.push_back(
      {"neighbours",
       fmt::format(state_.of_pixels
                       ? "{} pixels compared with those of their file or folder, {} differ"
                       : "{} strings compared with those of their combiner, {} differ",
                   state_.compared, state_.flagged)});
  return report;
}

}  // namespace lyrefit
