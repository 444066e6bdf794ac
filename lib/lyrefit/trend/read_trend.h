// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/stream/batch_source.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_series.h"

namespace LYREFIT_PUBLIC lyrefit {

// How the measurements of a trend are read.
struct TrendReadOptions {
  BatchReadOptions reading;
  // A series whose law is used, of a module file or a state; unset: that of the sweeps themselves.
  // Operating points need it.
  std::optional<TrendSeries> law;
  // Adds known conditions to each curve after it is read. Empty: none.
  std::function<Expected<void>(IvCurve* curve)> prepare;
};

// Reads sweeps of one device, in any shape of batch_source.h, each with the time of its measurement
// under date, timestamp, time, datetime or tmst, as a text of curve/date_time.h; or, in a folder tree,
// with a date in its name ("2025-03-12T10-30.csv", "module7_20250312_103000.csv"). Keeps a row of
// numbers for each; the sweeps themselves only of the reference days, if the law is theirs (all, if
// they are not in order of time).
// A sweep that cannot be read, that has no time or whose cells are not those of the law is an
// unusable row with the reason. An observer that stops the reading gets the series of the sweeps read
// so far. Errors: those of the source; no sweep has a time; the state of a trend; no law.
Expected<TrendSeries> ReadTrend(const std::vector<std::string>& inputs,
                                const TrendReadOptions& reading, const TrendOptions& options,
                                const Observer& observer = {});

// Reads a table of operating points with the columns time (or date, timestamp, datetime, tmst),
// irradiance, temperature (of the module or cell), vmp and imp (or v_mp, i_mp, voltage, current;
// also with units, as vmp_V), CSV, TSV or with semicolons, one measurement a row. A row with a
// missing value is an unusable one. Errors, with file, line and column: a column that is missing, a
// text that is neither a number nor a missing value, no module.
Expected<TrendSeries> ReadOperatingPoints(const std::vector<std::string>& files,
                                          const TrendReadOptions& reading);

// The state of a trend on disk: its law and its rows, a line each with its checksum. A sweep is
// appended without reducing the others.
//
// Writes the law of `series` and its rows into a new state, or appends the rows to one. Rows of a
// time that the state has already are left out, but one without an answer gives way to one with it;
// returns the number of those that were written. Errors: a file that is no state or a changed one;
// a state of another law; a row of a day before the sweeps that the law of the state is of; a file
// that cannot be written.
Expected<std::int64_t> AppendTrendState(const std::string& path, const TrendSeries& series);
// Error, as a sentence: the series is of another law than the state, or of another kind of
// measurements.
Expected<void> CheckSameLaw(const TrendSeries& state, const TrendSeries& other,
                            const std::string& path);

// What is said of a device beside its state.
struct SaidOfDevice {
  std::optional<int> cells_in_series;
  std::optional<int> bypass_diodes;   // of the whole device
  std::optional<TrendSeries> law;     // of its module
  std::optional<TrendSource> source;  // of what was measured
};

// Errors: what is said is not that of the state, which has a law of its own; `path` is its file.
Expected<void> CheckSaid(const TrendSeries& state, const SaidOfDevice& said,
                         const std::string& path);

// Reads a state. Errors, with the line: another file, a line that is broken or was changed. States
// of lyrefit 1.0.0 have no checksums.
Expected<TrendSeries> ReadTrendState(const std::string& path);
// The series of a state without its rows. Empty: no file, or one without a whole first line.
Expected<std::optional<TrendSeries>> ReadTrendStateHead(const std::string& path);
// Whether a file is the state of a trend.
bool IsTrendState(const std::string& path);

}  // namespace lyrefit
