#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/time_model.h"
#include "lyrefit/trend/trend_options.h"

// Series of days for the regressions of quantities and losses.
namespace lyrefit {

inline constexpr std::size_t kLeastForSizes = 8;   // days from which a regression has errors
inline constexpr double kLeastForRate_days = 350;  // a shorter series has no rate a year

// Sums of a block.
struct BlockSums {
  double expected_W = 0;
  double substrings_W = 0;
  std::array<double, kTrendParts> parts_W{};
};

std::vector<BlockSums> SumsOf(const TrendBlocks& blocks);

double PercentOf(const BlockSums& sum, int part);

// Mean of a part over blocks with these weights, in percent.
double MeanPart(const std::vector<BlockSums>& sums, const std::vector<double>& weights, int part);

double TotalPercent(const BlockSums& sum);

// A series of the blocks that have a value; `of`: their positions.
struct BlockSeries {
  TimeSeries series;
  std::vector<std::size_t> of;
};

// Features that a regression of days has: temperature, and light or the dullness of the sky.
inline constexpr int kBetweenDays = 2;

double SpanDays(const TimeSeries& series);

template <class Value>
BlockSeries SeriesOf(const TrendBlocks& blocks, const Value& value) {
  BlockSeries out;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const double one = value(b);
    if (!std::isfinite(one)) continue;
    out.of.push_back(b);
    out.series.days.push_back((blocks.time_s[b] - blocks.time_s.front()) / kDay_s);
    out.series.values.push_back(one);
    out.series.counts.push_back(blocks.used[b]);
  }
  return out;
}

// Columns: 1, years, and a year's sine and cosine where the series has two years.
Eigen::MatrixXd DesignOf(const TimeSeries& series, bool* seasonal);

// The mean features of each block, `conditions`, less those of the reference.
Eigen::MatrixXd WithConditions(const std::vector<Features>& conditions, const TrendBlocks& blocks,
                               const BlockSeries& own, const Eigen::MatrixXd& design);

Ranged RangedOf(double value, double error, double factor);

Ranged Scaled(const Ranged& one, double by);

// Power in W of the device of the reference at 1000 W/m2 and 25 C, with `change` added to what is
// followed at `what`.
double PowerAt(const TrendBlocks& blocks, TrendParameter what = kTrendVoltage, double change = 0);

// Power in % that a change of a quantity to the worse takes: of `name`, in its unit.
double LostByChange(const TrendBlocks& blocks, const std::string& name, double change);
// The same of a found change; of an onset by the end of the series.
double LostByChange(const TrendBlocks& blocks, const std::string& name, const TrendChange& change);

// Change of power in % by a lost volt.
double PercentPerVolt(const TrendBlocks& blocks);

// Standard deviation of what a season adds to a series of `days`, less than a year, in the quantity's
// unit: an error of the cells' temperature that follows the light.
double SeasonOf(const std::string& name, const TrendBlocks& blocks, double days);

// Standard deviation of what drifting instruments add in a year, in the quantity's unit.
double DriftOf(const std::string& name, const TrendBlocks& blocks, const TrendOptions& options);

}  // namespace lyrefit
