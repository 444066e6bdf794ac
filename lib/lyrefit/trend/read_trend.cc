#include "lyrefit/trend/read_trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/operating_points.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/trend/trend_device.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTogether = 512;  // sweeps reduced at once

constexpr const char* kTimeNames[] = {"date", "timestamp", "time", "datetime", "tmst"};

// A date in a file's name: the digits of "module7_20250312_1030", "2025-03-12T10-30-05".
std::optional<double> DateInName(std::string_view name) {
  for (std::size_t begin = 0; begin + 8 <= name.size(); ++begin) {
    if (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1])) != 0) continue;
    std::string digits;
    for (std::size_t i = begin; i < name.size() && digits.size() < 14; ++i) {
      const char c = name[i];
      if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
        digits += c;
      } else if (digits.size() % 2 != 0 ||
                 std::string_view("-_T :.").find(c) == std::string::npos) {
        break;
      }
    }
    if (digits.size() < 8) continue;
    const std::string text =
        digits.size() < 12
            ? fmt::format("{}-{}-{}", digits.substr(0, 4), digits.substr(4, 2), digits.substr(6, 2))
            : fmt::format("{}-{}-{} {}:{}:{}", digits.substr(0, 4), digits.substr(4, 2),
                          digits.substr(6, 2), digits.substr(8, 2), digits.substr(10, 2),
                          digits.size() >= 14 ? digits.substr(12, 2) : "00");
    if (const auto time = ReadDateTime(text)) return time;
  }
  return std::nullopt;
}

// The date beside a sweep; null: there is none.
const std::string* DateBeside(const std::map<std::string, std::string>& beside) {
  for (const char* name : kTimeNames) {
    const auto found = beside.find(name);
    if (found != beside.end()) return &found->second;
  }
  return nullptr;
}

Expected<double> TimeOf(const std::string* date, DateOrder order, const std::string& id,
                        const std::string& where) {
  if (date != nullptr) {
    if (const auto time = ReadDateTime(*date, order)) return *time;
    return Fail(fmt::format("expected a date such as 2025-03-12 10:30, found \"{}\"", *date),
                where);
  }
  if (const auto time = DateInName(id)) return *time;
  return Fail(
      "expected the time of the sweep, as date or timestamp beside it or in the file's name, found "
      "none",
      where);
}

// Reduces sweeps as they come: once the law is known, in groups. The law of sweeps that are not in
// order of time is known at the end.
class SeriesReader {
 public:
  SeriesReader(const TrendReadOptions& reading, const TrendOptions& options)
      : reading_(reading), options_(options), known_(reading.law.has_value()) {
    if (known_) series_ = *reading.law;
  }

  Expected<void> Take(IvCurve curve, double time_s) {
    if (reading_.prepare) TRY(reading_.prepare(&curve));
    curve.assumptions = {};
    curve.stated = {};
    if (known_ && !reading_.law && time_s < series_.law_from_s - kDay_s) {
      return Fail(
          fmt::format("the sweep of {} comes after a month of later ones, from {} on: name "
                      "the files in the order of time",
                      DateTimeText(time_s), DateTimeText(series_.law_from_s)));
    }
    if (!known_ && !waiting_.empty()) ordered_ = ordered_ && time_s >= waiting_.back().time_s;
    waiting_.push_back({std::move(curve), time_s});
    if (waiting_.size() < kTogether) return {};
    const double first_s = waiting_.front().time_s;
    const bool covered = ordered_ && time_s > first_s + options_.reference_days * kDay_s;
    if (!known_ && covered) TRY(FindLaw());
    if (known_) Reduce();
    return {};
  }

  // Takes a sweep with the date beside it; without a readable one as broken.
  Expected<void> TakeDated(IvCurve curve, const std::string* date, const std::string& id,
                           const std::string& where) {
    if (date != nullptr) TRY(LearnOrder(*date, where));
    const Expected<double> time = TimeOf(date, order_, id, where);
    if (time) return Take(std::move(curve), *time);
    if (date != nullptr && ReadDateTime(*date, DateOrder::kDayFirst)) {
      undated_.push_back({std::move(curve), *date, time.error()});
    } else {
      TakeUntimed(time.error());
    }
    return {};
  }

  DateOrder order() const { return order_; }

  void TakeBroken(double time_s, const std::string& reason) {
    TrendRow row;
    row.time_s = time_s;
    row.reason = reason;
    broken_.push_back(std::move(row));
  }

  // A sweep without a time; an error if all are.
  void TakeUntimed(const Error& error) {
    if (!untimed_) untimed_ = error;
    TakeBroken(kUnknown, error.ToString());
  }

  Expected<TrendSeries> End() {
    for (const Undated& one : undated_) TakeUntimed(one.error);
    if (untimed_ && waiting_.empty() && series_.rows.empty()) return tl::unexpected(*untimed_);
    if (!known_) TRY(FindLaw());
    Reduce();
    series_.rows.insert(series_.rows.end(), broken_.begin(), broken_.end());
    return std::move(series_);
  }

 private:
  // The sweeps whose dates told no order are taken once another date tells it.
  Expected<void> LearnOrder(const std::string& date, const std::string& where) {
    const DateOrder own = OrderOfDate(date);
    if (own == DateOrder::kUnknown || own == order_) return {};
    if (order_ != DateOrder::kUnknown) {
      return Fail(fmt::format("dates before have day and month in the other order, found \"{}\": "
                              "write dates as 2025-03-12",
                              date),
                  where);
    }
    order_ = own;
    for (Undated& one : undated_) {
      TRY(Take(std::move(one.curve), ReadDateTime(one.date, order_).value_or(kUnknown)));
    }
    undated_.clear();
    return {};
  }

  // A sweep whose day and month may be either, while no date has told the order.
  struct Undated {
    IvCurve curve;
    std::string date;
    Error error;
  };

  Expected<void> FindLaw() {
    TRY(series_, SeriesOfSweeps(waiting_, options_));
    known_ = true;
    return {};
  }

  void Reduce() {
    AppendSweeps(waiting_, options_.threads, &series_);
    waiting_.clear();
  }

  const TrendReadOptions& reading_;
  const TrendOptions& options_;
  TrendSeries series_;
  std::vector<TimedSweep> waiting_;
  std::vector<TrendRow> broken_;
  std::optional<Error> untimed_;  // of the first sweep without a time
  DateOrder order_ = DateOrder::kUnknown;
  std::vector<Undated> undated_;
  bool known_ = false;   // whether the law is
  bool ordered_ = true;  // the sweeps that wait for it are in order of time
};

bool IsSetFolder(const std::string& input) {
  std::error_code error;
  return fs::is_directory(input, error) && fs::exists(fs::path(input) / "curves.csv", error);
}

Expected<void> ReadSet(const std::string& input, const TrendReadOptions& reading,
                       SeriesReader* reader) {
  TRY(CurveSet set, ReadCurveSet(input, reading.reading.reading));
  for (IvCurve& curve : set.curves) {
    std::map<std::string, std::string> beside;
    if (!curve.notes.date.empty()) beside["date"] = curve.notes.date;
    const std::string name = curve.name;
    const std::string where = fmt::format("{}, curve {}", input, name);
    TRY(reader->TakeDated(std::move(curve), DateBeside(beside), name, where));
  }
  for (const RejectedCurve& rejected : set.rejected) {
    reader->TakeBroken(kUnknown, rejected.error.message);
  }
  return {};
}

// Returns whether it was stopped.
Expected<bool> ReadStream(const std::vector<std::string>& inputs, const TrendReadOptions& reading,
                          const ProgressReporter& progress, SeriesReader* reader) {
  TRY(const auto source, OpenBatch(inputs, reading.reading));
  while (true) {
    const Expected<std::optional<BatchItem>> next = source->Next();
    if (!next && StoppableReads::Stopped()) return true;
    TRY(const std::optional<BatchItem> item, next);
    if (!item) return false;
    BatchCurve read = source->Read(*item);
    if (!read.curve && StoppableReads::Stopped()) return true;
    const std::string* const date = DateBeside(read.beside);
    if (!read.curve) {
      const Expected<double> time = TimeOf(date, reader->order(), read.id, item->where);
      reader->TakeBroken(time.value_or(kUnknown), read.curve.error().message);
      continue;
    }
    TRY(reader->TakeDated(std::move(*read.curve), date, read.id, item->where));
    if (progress.Step()) return true;
  }
}

// A state holds no measurements, but rows by its own law.
Expected<void> RefuseStates(const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (!IsTrendState(input)) continue;
    return Fail(
        "the state of a trend is read alone: append the other measurements to it (--append)",
        input);
  }
  return {};
}

std::string NameOfInput(const std::vector<std::string>& inputs) {
  fs::path path = inputs.front();
  if (path.filename().empty()) path = path.parent_path();
  return path.stem().string();
}

}  // namespace

Expected<TrendSeries> ReadTrend(const std::vector<std::string>& inputs,
                                const TrendReadOptions& reading, const TrendOptions& options,
                                const Observer& observer) {
  if (inputs.empty()) return Fail("expected sweeps, found no file");
  TRY(RefuseStates(inputs));
  SeriesReader reader(reading, options);
  const ProgressReporter progress(observer, "sweeps", 0);
  std::vector<std::string> streams;
  for (const std::string& input : inputs) {
    if (IsSetFolder(input)) {
      TRY(ReadSet(input, reading, &reader));
    } else {
      streams.push_back(input);
    }
  }
  bool stopped = false;
  if (!streams.empty()) {
    TRY(stopped, ReadStream(streams, reading, progress, &reader));
  }
  TRY(TrendSeries series, reader.End());
  series.interrupted = stopped;
  if (series.name.empty()) series.name = NameOfInput(inputs);
  return series;
}

Expected<TrendSeries> ReadOperatingPoints(const std::vector<std::string>& files,
                                          const TrendReadOptions& reading) {
  if (files.empty()) return Fail("expected a table of operating points, found no file");
  TRY(RefuseStates(files));
  if (!reading.law) {
    return Fail(
        "operating points alone do not tell the law of their module: name it (--module), as a file "
        "of pvlib, PVsyst or SAM",
        files.front());
  }
  TrendSeries series = *reading.law;
  for (const std::string& file : files) {
    TRY(const std::vector<OperatingReading> points,
        ReadOperatingTable(file, reading.reading.reading.largest_file_bytes,
                           reading.reading.reading.column));
    for (const OperatingReading& point : points) {
      AppendOperatingPoint(point.time_s, point.irradiance_W_m2, point.temperature_C,
                           point.voltage_V, point.current_A, &series);
    }
  }
  if (series.name.empty()) series.name = NameOfInput(files);
  return series;
}

}  // namespace lyrefit
