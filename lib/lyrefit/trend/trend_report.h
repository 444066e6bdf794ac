// Experimental: may change in a minor version (data/stable).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/refine/estimate.h"
#include "lyrefit/model/cause.h"

// Records of a trend: what changed in a device over time. Times are seconds since 1970-01-01 of the
// clock of the logger (curve/date_time.h). Unknown values are NaN.
namespace LYREFIT_PUBLIC lyrefit {

// What the measurements are.
enum class TrendSource {
  kSweeps,           // I-V curves
  kOperatingPoints,  // voltage and current at maximum power
};

template <>
struct EnumTable<TrendSource> {
  static constexpr EnumText<TrendSource> kRows[] = {
      {TrendSource::kSweeps, "sweeps"}, {TrendSource::kOperatingPoints, "operating points"}};
};

// What became of a measurement.
enum class TrendRowState {
  kUsed,        // its parameters and its power count
  kStepped,     // a step, a rough shape or far too little light: only its light and power count
  kDim,         // less light than TrendOptions::least_irradiance_W_m2: its power counts
  kLimited,     // the inverter limited power: nothing counts
  kOffMaximum,  // not at maximum power: nothing counts
  kUnusable,    // nothing counts; see the reason
  kDoubtful,    // readings that no device gives, such as those of another unit: nothing counts
};

template <>
struct EnumTable<TrendRowState> {
  static constexpr EnumText<TrendRowState> kRows[] = {{TrendRowState::kUsed, "used"},
                                                      {TrendRowState::kStepped, "shaded"},
                                                      {TrendRowState::kDim, "dim"},
                                                      {TrendRowState::kLimited, "limited"},
                                                      {TrendRowState::kOffMaximum, "off maximum"},
                                                      {TrendRowState::kUnusable, "unusable"},
                                                      {TrendRowState::kDoubtful, "doubtful"}};
};

// Number of states.
constexpr int kTrendRowStates = 7;

// Positions of the parameters that are followed over time.
enum TrendParameter {
  kTrendLight,    // ln of the photocurrent over its expectation
  kTrendSeries,   // series resistance, ohm
  kTrendVoltage,  // open-circuit voltage of the diodes less that of the law, V
  kTrendSecond,   // share of the second diode in the current at open circuit
  kTrendShunt,    // shunt conductance, S
  kTrendParameters
};
// Positions of the parts of a loss of power.
enum TrendPart {
  kPartLight,
  kPartSeries,
  kPartRecombination,  // both diodes
  kPartShunt,
  kPartMismatch,
  kTrendParts
};

// One measurement, reduced to standard conditions.
struct TrendRow {
  double time_s = kUnknown;
  double irradiance_W_m2 = kUnknown;  // as stated
  double temperature_C = kUnknown;    // of the cells, as stated
  double clearness = 1;               // of the sky; see clearness.h
  double height = 1;                  // of the sun, as the light of a clear sky over the day's
  double voltage_V = kUnknown;        // at maximum power
  double current_A = kUnknown;        // at maximum power
  double isc_A = kUnknown;            // of a sweep
  double voc_V = kUnknown;            // of a sweep
  double expected_W = kUnknown;       // power of the reference in these conditions
  // Of the whole device with all its substrings.
  std::array<double, kTrendParameters> parameters = {kUnknown, kUnknown, kUnknown, kUnknown,
                                                     kUnknown};
  // Its series resistance, diodes and shunt are a value of its day; false: they repeat those of
  // other rows.
  bool represents = true;
  double misfit = kUnknown;  // rms of current residuals over Isc
  int lost_substrings = 0;   // without voltage
  double substrings_W = 0;   // of the part by mismatch: by lost substrings
  std::array<double, kTrendParts> parts_W = {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  TrendRowState state = TrendRowState::kUnusable;
  bool covered = false;  // shaded, by far too little light
  std::string reason;    // of an unusable or doubtful one

  // Power in W.
  double power_W() const { return voltage_V * current_A; }
};

// Measurements that are unusable or doubtful for one reason.
struct TrendReason {
  std::string reason;         // with the place of the first
  std::int64_t rows = 0;      // number of measurements
  double first_s = kUnknown;  // time of the first
  double last_s = kUnknown;   // time of the last
  bool doubtful = false;      // no device gives these readings
};

// Days on which the device was covered.
struct CoveredDays {
  bool frost = false;          // the cells were near freezing: snow or ice is likely
  std::vector<double> days_s;  // mean times, ascending
  double lost_percent = 0;     // on these days, of the energy of the whole series
};

// A change of a quantity on a day.
struct TrendChange {
  bool onset = false;            // the rate changes; else the level
  double time_s = kUnknown;      // the first day after it
  double earliest_s = kUnknown;  // 95 % range of that day
  double latest_s = kUnknown;    // its other end
  Ranged size;                   // step: unit of the quantity; onset: that unit a year
  double p_value = kUnknown;     // over all days
};

// A day of a quantity.
struct TrendDay {
  double time_s = kUnknown;  // mean time of its measurements
  double value = kUnknown;   // at standard conditions
  double fitted = kUnknown;  // of the regression
  int rows = 0;              // measurements behind it
};

// A quantity over time.
struct TrendQuantity {
  std::string name;        // "resistance_series"
  std::string title;       // "series resistance"
  std::string unit;        // "ohm"
  bool monitored = false;  // its changes to the worse are onsets, at the stated rate of false ones
  double reference = kUnknown;  // over the reference days
  // In its unit, mean over the series; without steps, but for light, which rain changes in steps. NaN
  // below a year.
  Ranged rate_per_year;
  Ranged rate_percent;             // of the reference, a year; NaN without a meaning
  Ranged change;                   // that rate times the length of the series, of any length
  double rate_until_s = kUnknown;  // the rate is that before this time; NaN: of the whole series
  std::vector<TrendChange> changes;
  double seasonal = kUnknown;        // amplitude over the year; NaN: not separable from a trend
  double day_scatter = kUnknown;     // standard deviation of a day
  double shared_scatter = kUnknown;  // of what neighbouring days share
  double half_life_days = 0;         // of that
  std::vector<TrendDay> days;
  std::string missing;  // why it is not known; then the others are empty
};

// A loss against the reference days, in percent of the energy or power that they let expect.
struct TrendLoss {
  std::string name;  // "light", "resistance_series", "recombination", "shunt", "mismatch", "total"
  Ranged energy_percent;  // over all days
  Ranged now_percent;     // over the last 30 days with data
};

// An onset or a step to the worse, with what it may be.
struct TrendOnset {
  std::string quantity;            // name of the quantity
  double time_s = kUnknown;        // day
  double earliest_s = kUnknown;    // 95 % range
  double latest_s = kUnknown;      // its other end
  double lost_percent = kUnknown;  // of power, over the last 30 days, by this part
  // Its id ("growing_series_resistance"), title, sentence and action, both without their ends.
  Cause cause;

  // Both sentences.
  std::string sentence() const { return cause.sentence + ". To do: " + cause.action + "."; }
};

// Result of FindTrend.
struct TrendReport {
  std::string version;  // of lyrefit
  std::string name;     // of the device
  TrendSource source = TrendSource::kSweeps;
  std::uint64_t seed = 0;
  std::vector<OptionEcho> options;
  int cells_in_series = 1;
  int substrings = 0;                 // with a bypass diode; 0: not known
  double ideality = kUnknown;         // of the law's first diode, half that of its second one
  std::string law;                    // where the law is from
  double first_s = kUnknown;          // time of the first measurement
  double last_s = kUnknown;           // time of the last one
  double reference_end_s = kUnknown;  // end of the reference days
  bool reference_capped = false;      // they are fewer than asked for: a third of the series
  std::int64_t rows = 0;              // measurements
  std::array<std::int64_t, kTrendRowStates> states{};  // their number by TrendRowState
  std::vector<TrendReason> reasons;                    // of the unusable and the doubtful ones
  std::vector<CoveredDays> covered;                    // in the cold, else
  double dull_sky_percent = kUnknown;   // energy that the sensor shows under dull skies and the
                                        // device does not get; no loss
  std::size_t days = 0;                 // days with data
  double reference_power_W = kUnknown;  // at standard conditions, over the reference days
  double energy_kWh = kUnknown;         // measured, if the rows are evenly spaced
  std::vector<TrendQuantity> quantities;
  std::vector<TrendLoss> losses;  // parts, then the total
  // Daily parts of the loss in percent of the expected energy, in the order of `losses`, without the
  // total; for pictures.
  std::vector<std::vector<TrendDay>> loss_days;
  std::vector<TrendOnset> onsets;
  std::string verdict;                   // in one sentence or a few
  std::vector<std::string> not_decided;  // what the measurements cannot tell, and what would
  std::vector<std::string> warnings;
  bool interrupted = false;
  double seconds = 0;  // of computing
};

}  // namespace lyrefit
