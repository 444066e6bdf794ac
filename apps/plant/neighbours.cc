#include "plant/neighbours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/append.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/column.h"
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

struct ComparedString {
  const NeighbourDeviation& deviation;
  std::vector<std::string> differences;  // with the limits of what is usual
};

const ColumnList<ComparedString>& ComparedColumns() {
  using Of = const ComparedString&;
  static const ColumnList<ComparedString> columns = {
      {"group_peers", "",
       "strings of the same combiner at like light that it is compared with; none: not compared",
       [](Of of) { return of.deviation.peers; }},
      {"group_Isc_percent", "%",
       "short-circuit current per irradiance against the median of its peers",
       [](Of of) { return 100 * of.deviation.parts[kIscPerLight]; }},
      {"group_Voc_percent", "%", "open-circuit voltage against the median of its peers",
       [](Of of) { return 100 * of.deviation.parts[kVoc]; }},
      {"group_FF_percent", "%", "fill factor against the median of its peers",
       [](Of of) { return 100 * of.deviation.parts[kFillFactor]; }},
      {"group_deviation_percent", "%",
       "maximum power per irradiance against the median of its peers",
       [](Of of) { return 100 * of.deviation.parts[kPmaxPerLight]; }},
      {"group_flag", "", "differs from its peers by more than is usual",
       [](Of of) { return !of.differences.empty(); }},
      {"group_outlier", "", "in what it differs, with the limit of what is usual",
       [](Of of) { return ListCell(of.differences, ", "); }},
  };
  return columns;
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

std::vector<ResultColumn> NeighbourColumns() { return HeadsOf(ComparedColumns()); }

std::vector<ResultCell> NeighbourCells(const NeighbourDeviation& deviation,
                                       const std::array<double, kNeighbourQuantities>& limits) {
  const ColumnList<ComparedString>& columns = ComparedColumns();
  if (deviation.peers == 0) return std::vector<ResultCell>(columns.size());
  static constexpr const char* kNames[] = {"Isc/G", "Voc", "FF", "Pmax/G"};
  ComparedString compared = {deviation, {}};
  for (int q = 0; q < kNeighbourQuantities; ++q) {
    const double part = deviation.parts[q];
    if (!(std::fabs(part) > limits[q])) continue;
    compared.differences.push_back(fmt::format("{} {:+.2f} % (usual: within {:.2f} %)", kNames[q],
                                               100 * part, 100 * limits[q]));
  }
  return CellsOf(columns, compared);
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
  state_ = {};
  state_.level = options.value("group-level", 0.0);
  state_.like_light = options.value("like-light", 0.0);
  state_.of_pixels = SampleCounter(input.columns).counts();
  state_.reader = RowReader(input.columns);
  return {};
}

std::vector<NeighbourDeviation> NeighbourAddition::Deviations(const RowGroup& group) const {
  if (!group.together) return std::vector<NeighbourDeviation>(group.rows.size());
  std::vector<Neighbour> members;
  for (const ResultRow& row : group.rows) {
    const auto number = [&](const char* name) { return state_.reader.Number(row, name); };
    const double light = number("irradiance_Wm2");
    members.push_back(
        {light,
         {number("Isc_A") / light, number("Voc_V"), number("FF"), number("Pmax_W") / light}});
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
