#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Parameters over time.
struct TrendParametersFound {
  TrendBlocks blocks;  // with what the law leaves of light and temperature between days
  std::vector<TrendQuantity> quantities;  // all, with those empty that are losses
};

// Finds the quantities that are parameters: their regressions on time, with their changes. In a
// series of most of a year the regression also has what the law leaves of light and temperature
// between days, which departures and levels then contain.
TrendParametersFound FindParameters(TrendBlocks blocks, TrendSource source,
                                    const TrendOptions& options);

// The quantities with those that are losses: mismatch and power. Needs the losses of every row
// (WithLosses).
std::vector<TrendQuantity> WithPowers(std::vector<TrendQuantity> quantities,
                                      const TrendBlocks& blocks, TrendSource source,
                                      const TrendOptions& options);

// See the fields of TrendReport.
struct TrendLosses {
  std::vector<TrendLoss> losses;
  std::vector<std::vector<TrendDay>> days;
};

TrendLosses FindLosses(const std::vector<TrendQuantity>& quantities, const TrendBlocks& blocks,
                       TrendSource source, const TrendOptions& options);

// The quantities without changes that take or give less than `least_percent` of the power, but of
// light; and without those of series resistance and mismatch after the shunt began to grow: uneven
// shunts bend the knee as these do.
std::vector<TrendQuantity> WithChangesThatMatter(std::vector<TrendQuantity> quantities,
                                                 const TrendBlocks& blocks, double least_percent);

// Another device from a day on.
struct ExchangedDevice {
  double time_s = kUnknown;          // of its first day
  std::vector<std::string> changed;  // "series resistance -0.0256 ohm"
  bool certain = false;              // one changed to the better by more than a device's own can
};

// A day on which three quantities or more step at once, none by a shunt that takes `least_percent`
// of the power; the first certain one, else the first one. None: there is no such day. Needs the
// parameters among the quantities.
std::optional<ExchangedDevice> FindExchange(const TrendBlocks& blocks, const TrendReport& report,
                                            double least_percent);

// Changes to the worse of a parameter or of mismatch, with what they may be. Needs quantities and
// losses.
std::vector<TrendOnset> FindOnsets(const TrendBlocks& blocks, const TrendReport& report);

}  // namespace lyrefit
