#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lyrefit/trend/standard_conditions.h"
#include "lyrefit/trend/trend_device.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Position of ln(power of the fitted model over the measured one), beside the parameters.
constexpr int kModelExcess = kTrendParameters;
constexpr int kFollowed = kTrendParameters + 1;

// Blocks that a trend takes at least.
constexpr std::size_t kLeastBlocks = 5;

// Whether a row has a say in its block: it is used, or tells the light of a shaded device.
inline bool CountsInBlocks(const TrendRow& row) {
  return row.state == TrendRowState::kUsed || row.state == TrendRowState::kStepped;
}

// The measurements of a series in blocks: days, or shorter spans of a short series.
struct TrendBlocks {
  const TrendDevice* device = nullptr;
  std::vector<TrendRow> rows;                          // those that count, by time
  std::array<std::int64_t, kTrendRowStates> states{};  // number of all rows by state
  std::vector<int> block;                              // of each row, ascending from 0
  std::vector<double> time_s;                          // mean of the rows of each block
  std::vector<int> used;                               // rows of each block that count
  // Features of the rows of each block, of what is followed.
  std::array<std::vector<Features>, kFollowed> mean;
  double length_s = 0;                           // of a block
  double reference_end_s = 0;                    // end of the reference blocks
  bool reference_capped = false;                 // they are a third of the series
  int reference_blocks = 0;                      // number of blocks before it
  std::array<Features, kFollowed> departures{};  // from the law
  // Means at standard conditions; NaN: a block without a usable row.
  std::array<std::vector<double>, kFollowed> level;
  std::array<double, kFollowed> reference{};  // mean over the reference blocks

  std::size_t size() const { return time_s.size(); }
  bool IsReference(std::size_t b) const { return time_s[b] <= reference_end_s; }
  // Light on the device as a part of 1000 W/m2.
  double LightOn(const TrendRow& row) const;
};

// Orders the rows, marks dim and stepped ones, finds departures and levels. `device` must outlive
// the result.
TrendBlocks MakeBlocks(const TrendDevice& device, std::vector<TrendRow> rows,
                       const TrendOptions& options);

// The blocks with the expected power and the parts of the loss of every row that counts.
TrendBlocks WithLosses(TrendBlocks blocks, int threads);

// Days on which most rows were covered, those in the cold first; none of a series that is not cut
// into days. Needs the losses.
std::vector<CoveredDays> FindCoveredDays(const TrendBlocks& blocks);

// Light under dull skies that the sensor shows and the device does not get, in % of the expected
// energy. `weights`: of the blocks; less that of the reference. Empty: of all rows. Needs the losses.
double DullSkyPercent(const TrendBlocks& blocks, const std::vector<double>& weights = {});

}  // namespace lyrefit
