#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "lyrefit/base/append_log.h"
#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/read_trend.h"
#include "lyrefit/trend/trend_device.h"

namespace lyrefit {
namespace {

using StateJson = nlohmann::ordered_json;

constexpr char kStateBegin[] = "{\"lyrefit_trend\"";
constexpr LogKind kStateKind = {"state of a trend",
                                "this state",
                                "the state of a trend",
                                kStateBegin,
                                "expected the state of a trend, found another file",
                                "begin another state",
                                nullptr,
                                "{\"lyrefit_trend\":2"};
// {"lyrefit_trend":2, ...}. Format 1 has neither checksums nor the time from which its law is.
constexpr int kStateFormat = 2;

StateJson NumberJson(double value) { return std::isfinite(value) ? StateJson(value) : StateJson(); }

double NumberOf(const nlohmann::json& json) {
  return json.is_number() ? json.get<double>() : kUnknown;
}

// What makes a law: of what it is, and its numbers.
StateJson LawOf(const TrendSeries& series) {
  const TrendDevice& device = *series.device;
  return {{"source", ToText(series.source)},
          {"cells_in_series", device.cells_in_series},
          {"substrings", device.substrings},
          {"n", device.n},
          {"EgRef", device.bandgap_eV},
          {"dEgdT", device.bandgap_slope_per_K},
          {"isc_tempco_per_K", device.isc_tempco_per_K},
          {"photocurrent", device.photocurrent_A},
          {"resistance_series", device.resistance_series_ohm},
          {"saturation_current", device.saturation_current_A},
          {"saturation_current_2", device.saturation_current_2_A},
          {"conductance_shunt", device.shunt_conductance_S}};
}

std::string HeadLine(const TrendSeries& series) {
  StateJson head = {{"lyrefit_trend", kStateFormat},
                    {"version", Version()},
                    {"name", series.name},
                    {"law", series.law},
                    {"law_from", NumberJson(series.law_from_s)}};
  head.update(LawOf(series));
  return head.dump(-1, ' ', false, StateJson::error_handler_t::replace) + "\n";
}

tl::unexpected<Error> RefuseHead(const char* expected, const char* key, const std::string& path) {
  return Fail(fmt::format("expected {} in \"{}\"", expected, key), path, 1);
}

Expected<TrendSeries> SeriesOfHead(const std::string& line, const std::string& path) {
  const nlohmann::json head = nlohmann::json::parse(line, nullptr, false);
  const auto found_format = head.is_object() ? head.find("lyrefit_trend") : head.end();
  const double format = found_format == head.end() ? 0 : NumberOf(*found_format);
  if (format != 1 && format != kStateFormat) {
    return Fail("expected the state of a trend of format 1 or 2, found another one", path, 1);
  }
  TrendSeries series;
  TrendDevice device;
  std::string source;
  for (const auto& [key, value] :
       {std::pair{"name", &series.name}, {"law", &series.law}, {"source", &source}}) {
    const auto found = head.find(key);
    if (found == head.end() || !found->is_string()) return RefuseHead("a text", key, path);
    *value = found->get<std::string>();
  }
  const bool sweeps = source == ToText(TrendSource::kSweeps);
  if (!sweeps && source != ToText(TrendSource::kOperatingPoints)) {
    return RefuseHead("sweeps or operating points", "source", path);
  }
  series.source = sweeps ? TrendSource::kSweeps : TrendSource::kOperatingPoints;
  for (const auto& [key, value, least] : {std::tuple{"cells_in_series", &device.cells_in_series, 1},
                                          {"substrings", &device.substrings, 0}}) {
    constexpr int kMost = 1000000;
    const auto found = head.find(key);
    if (found == head.end() || !found->is_number_integer() || *found < least || *found > kMost) {
      return RefuseHead("a number of them", key, path);
    }
    *value = found->get<int>();
  }
  for (const auto& [key, value] : {std::pair{"n", &device.n},
                                   {"EgRef", &device.bandgap_eV},
                                   {"dEgdT", &device.bandgap_slope_per_K},
                                   {"isc_tempco_per_K", &device.isc_tempco_per_K},
                                   {"photocurrent", &device.photocurrent_A},
                                   {"resistance_series", &device.resistance_series_ohm},
                                   {"saturation_current", &device.saturation_current_A},
                                   {"saturation_current_2", &device.saturation_current_2_A},
                                   {"conductance_shunt", &device.shunt_conductance_S}}) {
    const auto found = head.find(key);
    if (found == head.end() || !found->is_number()) return RefuseHead("a number", key, path);
    *value = found->get<double>();
  }
  if (head.contains("law_from")) series.law_from_s = NumberOf(head["law_from"]);
  series.device = std::make_shared<const TrendDevice>(device);
  return series;
}

// [time, irradiance, temperature, V, I, Isc, Voc, five parameters, misfit, lost substrings, state,
// reason]
std::string LineOfRow(const TrendRow& row) {
  StateJson line = StateJson::array();
  for (const double value : {row.time_s, row.irradiance_W_m2, row.temperature_C, row.voltage_V,
                             row.current_A, row.isc_A, row.voc_V}) {
    line.push_back(NumberJson(value));
  }
  for (const double value : row.parameters) line.push_back(NumberJson(value));
  line.push_back(NumberJson(row.misfit));
  line.push_back(row.lost_substrings);
  line.push_back(static_cast<int>(row.state));
  line.push_back(row.reason);
  return line.dump(-1, ' ', false, StateJson::error_handler_t::replace) + "\n";
}

Expected<TrendRow> RowOfLine(const std::string& text, const std::string& path, int number) {
  const nlohmann::json line = nlohmann::json::parse(text, nullptr, false);
  constexpr std::size_t kMembers = 16;
  if (!line.is_array() || line.size() != kMembers || !line[13].is_number_integer() ||
      !line[14].is_number_integer() || !line[15].is_string() || line[14] < 0 ||
      line[14] >= kTrendRowStates) {
    return Fail("this line is no row of a trend, the file is damaged", path, number);
  }
  TrendRow row;
  row.time_s = NumberOf(line[0]);
  row.irradiance_W_m2 = NumberOf(line[1]);
  row.temperature_C = NumberOf(line[2]);
  row.voltage_V = NumberOf(line[3]);
  row.current_A = NumberOf(line[4]);
  row.isc_A = NumberOf(line[5]);
  row.voc_V = NumberOf(line[6]);
  for (int i = 0; i < kTrendParameters; ++i) row.parameters[i] = NumberOf(line[7 + i]);
  row.misfit = NumberOf(line[12]);
  row.lost_substrings = line[13];
  row.state = static_cast<TrendRowState>(line[14].get<int>());
  row.reason = line[15];
  if (CountsInBlocks(row) && !(std::isfinite(row.time_s) && std::isfinite(row.irradiance_W_m2) &&
                               row.temperature_C > -kZeroCelsius_K)) {
    return Fail("expected a time, an irradiance and a temperature, the file is damaged", path,
                number);
  }
  return row;
}

// Places of the rows of a state, one for each time. A row without an answer, which has a reason, gives
// way to a later one of its time.
class RowPlaces {
 public:
  // Where the row goes: after the others, or in place of one; empty: there is one already.
  std::optional<std::size_t> Take(double time_s, bool answered, const std::string& reason) {
    if (!std::isfinite(time_s)) {
      return untimed_.insert(reason).second ? std::optional(count_++) : std::nullopt;
    }
    const auto [found, is_new] = at_.try_emplace(time_s, Place{count_, answered});
    if (is_new) return count_++;
    if (!answered || found->second.answered) return std::nullopt;
    found->second.answered = true;
    return found->second.place;
  }
  std::optional<std::size_t> Take(const TrendRow& row) {
    return Take(row.time_s, row.reason.empty(), row.reason);
  }

 private:
  struct Place {
    std::size_t place;
    bool answered;
  };

  std::unordered_map<double, Place> at_;  // by time
  std::set<std::string> untimed_;         // reasons of rows without a time
  std::size_t count_ = 0;
};

// The time from which the law of a state is; `first_s`, that of its first row with an answer, if an
// older program did not write it.
double LawFrom(const TrendSeries& head, double first_s) {
  const bool unknown = !std::isfinite(head.law_from_s) && IsLawOfSweeps(head.law);
  return unknown ? first_s : head.law_from_s;
}

// The rows of a state that is appended to. Only what is asked of them is read.
struct KnownRows {
  RowPlaces places;
  double first_s = kInfinity;  // of those with an answer

  Expected<void> Take(const std::string& line, const std::string& path, int number) {
    if (line.empty() || line.front() != '[') {
      return Fail("this line is no row of a trend, the file is damaged", path, number);
    }
    // [1741775400.0, ..., reason]
    constexpr std::string_view kNoReason = ",\"\"]";
    char* end = nullptr;
    const double time_s = std::strtod(line.c_str() + 1, &end);
    const bool answered =
        line.size() > kNoReason.size() &&
        line.compare(line.size() - kNoReason.size(), std::string::npos, kNoReason) == 0;
    if (end == line.c_str() + 1) {
      TRY(const TrendRow row, RowOfLine(line, path, number));
      places.Take(row);
    } else {
      places.Take(time_s, answered, "");
      if (answered) first_s = std::min(first_s, time_s);
    }
    return {};
  }
};

std::string DeviceText(const TrendDevice& device) {
  return fmt::format("{} cells and {} substrings", device.cells_in_series, device.substrings);
}

// Rows of an earlier day would be the reference of the report, but not of the law.
Expected<void> CheckNoneIsBefore(double law_from_s, const std::vector<TrendRow>& rows,
                                 const std::string& path) {
  if (!std::isfinite(law_from_s)) return {};
  const double day_s = std::floor(law_from_s / kDay_s) * kDay_s;
  for (const TrendRow& row : rows) {
    if (!CountsInBlocks(row) || row.time_s >= day_s) continue;
    return Fail(
        fmt::format("a measurement of {} is older than the sweeps that the law of this state "
                    "is of, from {} on: begin another state with the oldest ones, or by the "
                    "law of a module",
                    DateText(row.time_s), DateText(law_from_s)),
        path);
  }
  return {};
}

}  // namespace

std::string LawText(const TrendSeries& series) { return LawOf(series).dump(); }

Expected<void> CheckSameLaw(const TrendSeries& state, const TrendSeries& other,
                            const std::string& path) {
  if (LawText(state) == LawText(other)) return {};
  if (state.source != other.source) {
    return Fail(fmt::format("this state is of {}, these measurements are {}", ToText(state.source),
                            ToText(other.source)),
                path, 1);
  }
  const std::string own = DeviceText(*state.device), its = DeviceText(*other.device);
  return Fail(
      fmt::format("this state follows a device by another law ({}{}): begin another one, or "
                  "append by the law that it has",
                  state.law, own == its ? "" : fmt::format(": {}, not {}", own, its)),
      path, 1);
}

Expected<void> CheckSaid(const TrendSeries& state, const SaidOfDevice& said,
                         const std::string& path) {
  const TrendDevice& device = *state.device;
  for (const auto& [flag, given, own] :
       {std::tuple{"--cells", said.cells_in_series, device.cells_in_series},
        {"--bypass-diodes", said.bypass_diodes, device.substrings}}) {
    if (!given || *given == own) continue;
    return Fail(fmt::format("{} {}: the law of this state has {}", flag, *given, own), path, 1);
  }
  if (!said.law && !said.source) return {};
  TrendSeries other = said.law.value_or(state);
  TrendDevice its = *other.device;
  its.substrings = device.substrings;
  other.device = std::make_shared<const TrendDevice>(its);
  other.source = said.source.value_or(TrendSource::kSweeps);
  return CheckSameLaw(state, other, path);
}

bool IsTrendState(const std::string& path) {
  if (IsStream(path)) return false;  // opening a pipe would wait for its writer
  std::ifstream in(path, std::ios::binary);
  std::string begin(sizeof kStateBegin - 1, '\0');
  return in.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == kStateBegin;
}

Expected<std::optional<TrendSeries>> ReadTrendStateHead(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  TRY(LogReader log, LogReader::Open(path, kStateKind));
  TRY(const auto head, log.Next());
  if (!head) return std::nullopt;
  return SeriesOfHead(*head, path);
}

Expected<TrendSeries> ReadTrendState(const std::string& path) {
  TRY(LogReader log, LogReader::Open(path, kStateKind));
  TrendSeries series;
  RowPlaces places;
  double first_s = kInfinity;
  while (true) {
    if (StoppableReads::Stopped()) return FailAsStopped(path);
    TRY(const auto line, log.Next());
    if (!line) break;
    if (log.line() == 1) {
      TRY(series, SeriesOfHead(*line, path));
      continue;
    }
    TRY(TrendRow row, RowOfLine(*line, path, log.line()));
    if (row.reason.empty()) first_s = std::min(first_s, row.time_s);
    const auto place = places.Take(row);
    if (!place) continue;
    if (*place == series.rows.size()) series.rows.emplace_back();
    series.rows[*place] = std::move(row);
  }
  if (series.device == nullptr) {
    return Fail(log.torn() ? "the state is cut within its first line: remove it"
                           : "expected the state of a trend, found an empty file",
                path);
  }
  series.law_from_s = LawFrom(series, first_s);
  return series;
}

Expected<std::int64_t> AppendTrendState(const std::string& path, const TrendSeries& series) {
  TRY(const auto log, AppendLog::Open(path, kStateKind));
  TrendSeries head = series;
  KnownRows known;
  TRY(log->TakeUp([&](const std::string& line, int number) -> Expected<void> {
    if (number > 1) return known.Take(line, path, number);
    TRY(head, SeriesOfHead(line, path));
    return CheckSameLaw(head, series, path);
  }));
  TRY(CheckNoneIsBefore(LawFrom(head, known.first_s), series.rows, path));
  std::string lines = log->empty() ? HeadLine(series) : "";
  std::int64_t written = 0;
  for (const TrendRow& row : series.rows) {
    if (!known.places.Take(row)) continue;
    lines += LineOfRow(row);
    ++written;
  }
  if (!lines.empty()) TRY(log->Append(lines));
  return written;
}

}  // namespace lyrefit
