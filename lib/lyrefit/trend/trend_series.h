// Experimental: may change in a minor version (data/stable).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"

namespace LYREFIT_PUBLIC lyrefit {

struct NamedParameters;
struct TrendDevice;

// A sweep with its time.
struct TimedSweep {
  IvCurve curve;
  double time_s = kUnknown;  // since 1970-01-01, see curve/date_time.h
};

// Measurements of one device, reduced to standard conditions, in any order.
struct TrendSeries {
  std::string name;  // of the device
  TrendSource source = TrendSource::kSweeps;
  std::shared_ptr<const TrendDevice> device;  // the law that they are reduced by
  std::string law;                            // where it is from, in a few words
  double law_from_s =
      kUnknown;  // the first of the sweeps that the law is of; unknown: it is none of sweeps
  std::vector<TrendRow> rows;  // one for each measurement
  bool interrupted = false;    // reading was stopped: the first ones only
};

// A series without rows and name, by the law of a module file. `bypass_diodes` of the device, each
// across equally many cells; 0: not known. Errors: a module with two diodes; substrings that cannot
// be equal.
Expected<TrendSeries> SeriesOfModule(const NamedParameters& module, TrendSource source,
                                     int bypass_diodes);

// A series without rows and name, by the law of a device's own sweeps: medians of fits with n free
// of up to sixty of the brighter ones among the reference days. Errors: no sweep that a single diode
// describes; substrings that cannot be equal.
Expected<TrendSeries> SeriesOfSweeps(const std::vector<TimedSweep>& sweeps,
                                     const TrendOptions& options);

// The law as a text: equal laws have equal ones.
std::string LawText(const TrendSeries& series);
// Whether the words for a law are those for one of sweeps.
bool IsLawOfSweeps(const std::string& law);

// Reduces sweeps to rows and appends them.
void AppendSweeps(const std::vector<TimedSweep>& sweeps, int threads, TrendSeries* series);

// Appends a measurement at maximum power.
void AppendOperatingPoint(double time_s, double irradiance_W_m2, double temperature_C,
                          double voltage_V, double current_A, TrendSeries* series);

}  // namespace lyrefit
