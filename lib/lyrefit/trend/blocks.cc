#include "lyrefit/trend/blocks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/trend/clearness.h"
#include "lyrefit/trend/day_series.h"
#include "lyrefit/trend/loss_split.h"

namespace lyrefit {
namespace {

constexpr double kDaysForDays = 20;  // shorter series are cut into more blocks
constexpr double kShortBlocks = 40;
constexpr double kSteppedTimes = 4;      // misfit of a stepped sweep over the median
constexpr double kSteppedLeast = 0.004;  // and of Isc
constexpr double kCovered = 0.85;        // light of a covered device, of its 90 % quantile
constexpr double kLongestCovered_s = 60 * kDay_s;  // what takes light for longer is no snow

// Days of weather to whose mean a sky is compared: a dull one may last a day, dirt changes slowly.
int SpellOf(const TrendRow& row) {
  constexpr double kSpell_s = 7 * kDay_s;
  return static_cast<int>(std::floor(row.time_s / kSpell_s));
}

// Features that explain what is followed.
Features FeaturesOf(const TrendBlocks& blocks, const TrendRow& row, int what) {
  return what == kTrendLight ? SkyFeaturesAt(row.temperature_C, row.clearness, row.height)
                             : FeaturesAt(blocks.LightOn(row), row.temperature_C);
}

double SpanOf(const std::vector<TrendRow>& rows) {
  return rows.empty() ? 0 : rows.back().time_s - rows.front().time_s;
}

void MarkDim(double least_W_m2, std::vector<TrendRow>* rows) {
  for (TrendRow& row : *rows) {
    if (row.state == TrendRowState::kUsed && row.irradiance_W_m2 < least_W_m2) {
      row.state = TrendRowState::kDim;
    }
  }
}

void MarkStepped(std::vector<TrendRow>* rows) {
  std::vector<double> misfits;
  for (const TrendRow& row : *rows) {
    if (row.state == TrendRowState::kUsed && std::isfinite(row.misfit)) {
      misfits.push_back(row.misfit);
    }
  }
  const double most = std::max(kSteppedTimes * Median(misfits), kSteppedLeast);
  for (TrendRow& row : *rows) {
    if (row.state == TrendRowState::kUsed && row.misfit > most) row.state = TrendRowState::kStepped;
  }
}

// Marks sweeps of a device under snow or in shade: far less light than it usually has under such a
// sky. `rows`: by time.
void MarkCovered(std::vector<TrendRow>* rows) {
  // Snow comes in the cold: what it takes must not seem to be of the temperature.
  const auto sky_of = [](const TrendRow& row) {
    return SkyFeaturesAt(kReferenceTemperature_C, row.clearness, row.height);
  };
  std::vector<ConditionedValue> used;
  for (const TrendRow& row : *rows) {
    if (row.state != TrendRowState::kUsed) continue;
    used.push_back({SpellOf(row), sky_of(row), row.parameters[kTrendLight]});
  }
  if (used.empty()) return;
  const Features sky = FitWithinBlocks(used);
  const auto clear = [&](const TrendRow& row) {
    return row.parameters[kTrendLight] - Departure(sky, sky_of(row));
  };
  std::vector<double> lights;
  for (const TrendRow& row : *rows) {
    if (row.state == TrendRowState::kUsed) lights.push_back(clear(row));
  }
  std::sort(lights.begin(), lights.end());
  const double least = Quantile(lights, 0.9) + std::log(kCovered);
  for (auto row = rows->begin(); row != rows->end();) {
    const auto end = std::find_if(row, rows->end(), [&](const TrendRow& one) {
      return CountsInBlocks(one) && !(clear(one) < least);
    });
    const bool passes = row == end || end[-1].time_s - row->time_s < kLongestCovered_s;
    for (; row != end; ++row) {
      if (!CountsInBlocks(*row) || !passes) continue;
      row->state = TrendRowState::kStepped;
      row->covered = true;
    }
    if (row != rows->end()) ++row;
  }
}

// The reference begins with the first day on which the device is not covered. None: there is no such
// day.
std::optional<double> EndOfReference(const std::vector<TrendRow>& rows, double reference_days) {
  const auto first = std::find_if(rows.begin(), rows.end(), [](const TrendRow& row) {
    return row.state == TrendRowState::kUsed;
  });
  if (first == rows.end()) return std::nullopt;
  // At most a third of the series is its own reference.
  return first->time_s +
         std::min(reference_days * kDay_s, (rows.back().time_s - first->time_s) / 3);
}

// The rows that count, in numbered blocks. `rows`: by time.
TrendBlocks CutBlocks(const TrendDevice& device, const std::vector<TrendRow>& rows) {
  TrendBlocks blocks;
  blocks.device = &device;
  for (const TrendRow& row : rows) ++blocks.states[static_cast<std::size_t>(row.state)];
  if (rows.empty()) return blocks;
  const double span = SpanOf(rows);
  blocks.length_s = span >= kDaysForDays * kDay_s ? kDay_s : std::max(span / kShortBlocks, 1e-3);
  const double origin = blocks.length_s == kDay_s
                            ? kDay_s * std::floor(rows.front().time_s / kDay_s)
                            : rows.front().time_s;
  double last = -1;
  for (const TrendRow& row : rows) {
    if (!CountsInBlocks(row)) continue;
    const double number = std::floor((row.time_s - origin) / blocks.length_s);
    if (number != last) {
      blocks.time_s.push_back(0);
      blocks.used.push_back(0);
      last = number;
    }
    blocks.time_s.back() += row.time_s;
    ++blocks.used.back();
    blocks.block.push_back(static_cast<int>(blocks.time_s.size()) - 1);
    blocks.rows.push_back(row);
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) blocks.time_s[b] /= blocks.used[b];
  for (std::vector<Features>& of : blocks.mean) of.resize(blocks.size());
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    const TrendRow& row = blocks.rows[i];
    const int b = blocks.block[i];
    for (int what = 0; what < kFollowed; ++what) {
      const Features own = FeaturesOf(blocks, row, what);
      for (int f = 0; f < kConditionFeatures; ++f) {
        blocks.mean[what][b][f] += own[f] / blocks.used[b];
      }
    }
  }
  return blocks;
}

// Value of a row that is followed; NaN: none.
double Followed(const TrendBlocks& blocks, const TrendRow& row, int what) {
  if (row.state != TrendRowState::kUsed) return kUnknown;
  const bool repeated = what != kTrendLight && what != kModelExcess && !row.represents;
  if (repeated || !std::isfinite(row.parameters[kTrendLight])) return kUnknown;
  if (what < kTrendParameters) return row.parameters[what];
  if (row.lost_substrings > 0) return kUnknown;
  const double expected_A = blocks.device->Photocurrent(row.irradiance_W_m2, row.temperature_C);
  const DeviceState state = StateOf(*blocks.device, row.parameters, expected_A, row.temperature_C);
  return std::log(MaximumPowerPoint(*blocks.device, state, row.temperature_C).power_W() /
                  row.power_W());
}

// What is followed of one kind; see the fields of TrendBlocks.
struct Levels {
  Features departures{};
  std::vector<double> level;
  double reference = kUnknown;
};

Levels FindLevels(const TrendBlocks& blocks, int what) {
  Levels found;
  const bool spells = what == kTrendLight && blocks.length_s == kDay_s;
  std::vector<ConditionedValue> values, groups;
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    const TrendRow& row = blocks.rows[i];
    const double value = Followed(blocks, row, what);
    if (!std::isfinite(value)) continue;
    values.push_back({blocks.block[i], FeaturesOf(blocks, row, what), value});
    groups.push_back(values.back());
    if (spells) groups.back().block = SpellOf(row);
  }
  found.departures = FitWithinBlocks(groups);
  found.level.assign(blocks.size(), kUnknown);
  std::vector<ConditionedValue> own;
  for (std::size_t i = 0; i < values.size(); ++i) {
    own.push_back(values[i]);
    if (i + 1 < values.size() && values[i + 1].block == values[i].block) continue;
    found.level[values[i].block] = BlockMean(own, found.departures);
    own.clear();
  }
  std::vector<ConditionedValue> first;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const double level = found.level[b];
    if (blocks.IsReference(b) && std::isfinite(level)) first.push_back({0, {}, level});
  }
  if (!first.empty()) found.reference = BlockMean(first, {});
  return found;
}

// Median level of the blocks around `b`, at most three away on either side.
double LevelAround(const TrendBlocks& blocks, int what, int b) {
  std::vector<double> near;
  constexpr int kReach = 3;
  const int last = static_cast<int>(blocks.size()) - 1;
  for (int reach = kReach; near.empty() && reach <= last + kReach; reach *= 2) {
    for (int k = std::max(b - reach, 0); k <= std::min(b + reach, last); ++k) {
      const double level = blocks.level[what][k];
      if (std::isfinite(level)) near.push_back(level);
    }
  }
  return near.empty() ? blocks.reference[what] : Median(near);
}

// The row with its expected power and the parts of its loss.
TrendRow WithLoss(TrendRow row, const TrendBlocks& blocks, int block) {
  const TrendDevice& device = *blocks.device;
  const double expected_A = device.Photocurrent(row.irradiance_W_m2, row.temperature_C);
  std::array<double, kTrendParameters> before{}, after = row.parameters;
  for (int i = 0; i < kTrendParameters; ++i) {
    const double departure = Departure(blocks.departures[i], FeaturesOf(blocks, row, i));
    before[i] = blocks.reference[i] + departure;
    if (row.state == TrendRowState::kStepped && i != kTrendLight) {
      after[i] = LevelAround(blocks, i, block) + departure;
    }
  }
  if (row.state == TrendRowState::kStepped) {
    // An operating point has no Isc: its light is that of its current.
    after[kTrendLight] =
        std::isfinite(row.isc_A) ? std::log(row.isc_A / expected_A) : row.parameters[kTrendLight];
  }
  const DeviceState reference = StateOf(device, before, expected_A, row.temperature_C);
  const DeviceState now = StateOf(device, after, expected_A, row.temperature_C);
  const double scale = std::exp(
      -(blocks.reference[kModelExcess] +
        Departure(blocks.departures[kModelExcess], FeaturesOf(blocks, row, kModelExcess))));
  row.expected_W = scale * MaximumPowerPoint(device, reference, row.temperature_C).power_W();
  row.parts_W = SplitLoss(device, reference, now, row.temperature_C);
  double sum = 0;
  for (double& part : row.parts_W) {
    part *= scale;
    sum += part;
  }
  row.parts_W[kPartMismatch] = row.expected_W - row.power_W() - sum;
  // A device of fewer equal substrings has the same currents at proportionally lower voltages.
  if (row.lost_substrings > 0) {
    row.substrings_W = (row.expected_W - sum) * row.lost_substrings / device.substrings;
  }
  return row;
}

}  // namespace

double TrendBlocks::LightOn(const TrendRow& row) const {
  const double light = row.irradiance_W_m2 / 1000;
  if (row.state == TrendRowState::kStepped) return light;
  return light * std::exp(row.parameters[kTrendLight]);
}

TrendBlocks MakeBlocks(const TrendDevice& device, std::vector<TrendRow> rows,
                       const TrendOptions& options) {
  const auto timed = std::remove_if(rows.begin(), rows.end(),
                                    [](const TrendRow& row) { return !std::isfinite(row.time_s); });
  const std::int64_t untimed = rows.end() - timed;
  rows.erase(timed, rows.end());
  std::stable_sort(rows.begin(), rows.end(), [](const TrendRow& one, const TrendRow& other) {
    return one.time_s < other.time_s;
  });
  FindSky(&rows);
  MarkDim(options.least_irradiance_W_m2, &rows);
  MarkStepped(&rows);
  MarkCovered(&rows);
  TrendBlocks blocks = CutBlocks(device, rows);
  blocks.states[static_cast<std::size_t>(TrendRowState::kUnusable)] += untimed;
  if (const auto end_s = EndOfReference(blocks.rows, options.reference_days)) {
    blocks.reference_end_s = *end_s;
    blocks.reference_capped = blocks.rows.back().time_s - blocks.rows.front().time_s <
                              3 * options.reference_days * kDay_s;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      blocks.reference_blocks += blocks.IsReference(b) ? 1 : 0;
    }
  }
  ParallelFor(kFollowed, options.threads, [&](int what) {
    Levels found = FindLevels(blocks, what);
    blocks.departures[what] = found.departures;
    blocks.level[what] = std::move(found.level);
    blocks.reference[what] = found.reference;
  });
  return blocks;
}

TrendBlocks WithLosses(TrendBlocks blocks, int threads) {
  ParallelFor(static_cast<int>(blocks.rows.size()), threads, [&](int i) {
    TrendRow& row = blocks.rows[static_cast<std::size_t>(i)];
    row = WithLoss(std::move(row), blocks, blocks.block[static_cast<std::size_t>(i)]);
  });
  return blocks;
}

std::vector<CoveredDays> FindCoveredDays(const TrendBlocks& blocks) {
  constexpr double kMost = 0.5;  // of the rows of a day
  constexpr double kPart = 0.1;  // of the power, lost by mismatch
  constexpr double kFrost_C = 5;
  if (blocks.length_s != kDay_s) return {};
  std::vector<int> covered(blocks.size(), 0);
  std::vector<double> coldest(blocks.size(), kInfinity);
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    const TrendRow& row = blocks.rows[i];
    const int b = blocks.block[i];
    const bool on_a_part =
        row.lost_substrings == 0 && row.parts_W[kPartMismatch] > kPart * row.expected_W;
    covered[b] += row.covered || on_a_part ? 1 : 0;
    coldest[b] = std::min(coldest[b], row.temperature_C);
  }
  CoveredDays cold{true, {}, 0}, warm{false, {}, 0};
  const std::vector<BlockSums> sums = SumsOf(blocks);
  double expected_W = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    expected_W += sums[b].expected_W;
    if (covered[b] < std::max(kMost * blocks.used[b], 2.0)) continue;
    CoveredDays& of = coldest[b] < kFrost_C ? cold : warm;
    of.days_s.push_back(blocks.time_s[b]);
    of.lost_percent += TotalPercent(sums[b]) * sums[b].expected_W;  // of the record below
  }
  std::vector<CoveredDays> found;
  for (CoveredDays* const one : {&cold, &warm}) {
    if (one->days_s.empty()) continue;
    one->lost_percent /= expected_W;
    found.push_back(std::move(*one));
  }
  return found;
}

double DullSkyPercent(const TrendBlocks& blocks, const std::vector<double>& weights) {
  constexpr int kDullness = 1;  // position among SkyFeaturesAt
  double missed = 0, expected = 0, first_missed = 0, first_expected = 0;
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    const TrendRow& row = blocks.rows[i];
    const int b = blocks.block[i];
    const double departure = blocks.departures[kTrendLight][kDullness] * (1 - row.clearness);
    const double missed_W = row.expected_W * std::expm1(-departure);
    const double weight = weights.empty() || weights[b] > 0 ? 1 : 0;
    missed += weight * missed_W;
    expected += weight * (row.expected_W + missed_W);
    if (!blocks.IsReference(b)) continue;
    first_missed += missed_W;
    first_expected += row.expected_W + missed_W;
  }
  if (!(expected > 0)) return 0;
  const double own = 100 * missed / expected;
  return weights.empty() || !(first_expected > 0) ? own : own - 100 * first_missed / first_expected;
}

}  // namespace lyrefit
