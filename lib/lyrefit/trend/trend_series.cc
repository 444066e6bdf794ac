#include "lyrefit/trend/trend_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/trend_device.h"

namespace lyrefit {
namespace {

constexpr std::size_t kSweepsForLaw = 60;
constexpr std::string_view kLawOfSweeps = " sweeps of the reference days";

Expected<void> CheckSubstrings(const TrendDevice& device) {
  if (device.substrings <= 0 || device.cells_in_series % device.substrings == 0) return {};
  return Fail(
      fmt::format("{} cells have no {} equal substrings: bypass diodes are counted over the "
                  "whole device (--bypass-diodes); 0 if theirs are unequal",
                  device.cells_in_series, device.substrings));
}

double LargestCurrent(const IvCurve& curve) {
  return curve.current_A.empty()
             ? 0
             : *std::max_element(curve.current_A.begin(), curve.current_A.end());
}

double FirstOf(const std::vector<TimedSweep>& sweeps) {
  double first = kInfinity;
  for (const TimedSweep& sweep : sweeps) first = std::min(first, sweep.time_s);
  return first;
}

// The brighter half of the sweeps of the reference days, at most kSweepsForLaw of them, evenly.
std::vector<const IvCurve*> SweepsForLaw(const std::vector<TimedSweep>& sweeps,
                                         const TrendOptions& options) {
  const double first = FirstOf(sweeps);
  std::vector<const IvCurve*> chosen;
  for (const TimedSweep& sweep : sweeps) {
    const bool early = sweep.time_s <= first + options.reference_days * kDay_s;
    const bool bright = sweep.curve.irradiance_known && sweep.curve.temperature_known &&
                        sweep.curve.conditions.irradiance_W_m2 >= options.least_irradiance_W_m2;
    if (early && bright) chosen.push_back(&sweep.curve);
  }
  std::stable_sort(chosen.begin(), chosen.end(), [](const IvCurve* one, const IvCurve* other) {
    return LargestCurrent(*one) > LargestCurrent(*other);
  });
  chosen.resize((chosen.size() + 1) / 2);
  if (chosen.size() <= kSweepsForLaw) return chosen;
  std::vector<const IvCurve*> even;
  for (std::size_t k = 0; k < kSweepsForLaw; ++k) {
    even.push_back(chosen[k * chosen.size() / kSweepsForLaw]);
  }
  return even;
}

}  // namespace

Expected<TrendSeries> SeriesOfModule(const NamedParameters& module, TrendSource source,
                                     int bypass_diodes) {
  TRY(TrendDevice device, DeviceOfModule(module));
  device.substrings = bypass_diodes;
  TRY(CheckSubstrings(device));
  TrendSeries series;
  series.source = source;
  series.device = std::make_shared<const TrendDevice>(device);
  series.law = module.name;
  return series;
}

Expected<TrendSeries> SeriesOfSweeps(const std::vector<TimedSweep>& sweeps,
                                     const TrendOptions& options) {
  const std::vector<const IvCurve*> chosen = SweepsForLaw(sweeps, options);
  Expected<TrendDevice> device = DeviceOfSweeps(chosen);
  if (!device && sweeps.size() < kLeastBlocks) {
    return Fail(fmt::format("{}; a trend takes usable sweeps at {} times or more, found {}; {}",
                            device.error().message, kLeastBlocks, sweeps.size(), kSideBySide));
  }
  if (!device) return tl::unexpected(device.error());
  TRY(CheckSubstrings(*device));
  TrendSeries series;
  series.device = std::make_shared<const TrendDevice>(*device);
  series.law = fmt::format("{}{}", chosen.size(), kLawOfSweeps);
  series.law_from_s = FirstOf(sweeps);
  return series;
}

bool IsLawOfSweeps(const std::string& law) {
  return law.size() > kLawOfSweeps.size() &&
         law.compare(law.size() - kLawOfSweeps.size(), std::string::npos, kLawOfSweeps) == 0;
}

void AppendSweeps(const std::vector<TimedSweep>& sweeps, int threads, TrendSeries* series) {
  const std::size_t before = series->rows.size();
  series->rows.resize(before + sweeps.size());
  ParallelFor(static_cast<int>(sweeps.size()), threads, [&](int i) {
    const TimedSweep& sweep = sweeps[static_cast<std::size_t>(i)];
    series->rows[before + static_cast<std::size_t>(i)] =
        ReduceSweep(*series->device, sweep.curve, sweep.time_s);
  });
}

void AppendOperatingPoint(double time_s, double irradiance_W_m2, double temperature_C,
                          double voltage_V, double current_A, TrendSeries* series) {
  TrendRow row;
  row.time_s = time_s;
  row.irradiance_W_m2 = irradiance_W_m2;
  row.temperature_C = temperature_C;
  row.voltage_V = voltage_V;
  row.current_A = current_A;
  const bool known = std::isfinite(time_s) && std::isfinite(irradiance_W_m2) &&
                     std::isfinite(temperature_C) && std::isfinite(voltage_V) &&
                     std::isfinite(current_A);
  if (!known) {
    row.reason = "a value is missing";
  } else if (!(irradiance_W_m2 > 0) || !(voltage_V > 0) || !(current_A > 0)) {
    row.reason = "dark";
  } else {
    row.state = TrendRowState::kUsed;
  }
  series->rows.push_back(std::move(row));
}

}  // namespace lyrefit
