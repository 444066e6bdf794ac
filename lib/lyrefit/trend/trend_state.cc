#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "lyrefit/base/append_log.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/read_trend.h"
#include "lyrefit/trend/trend_device.h"

namespace lyrefit {
namespace {

using StateJson = nlohmann::ordered_json;

constexpr char kStateBegin[] = "{\"lyrefit_trend\"";
constexpr LogKind kStateKind = {"state of a trend", "this state", "the state of a trend",
                                kStateBegin, "expected the state of a trend, found another file"};
constexpr int kStateFormat = 1;

StateJson NumberJson(double value) { return std::isfinite(value) ? StateJson(value) : StateJson(); }

double NumberOf(const nlohmann::json& json) {
  return json.is_number() ? json.get<double>() : kUnknown;
}

StateJson HeadOfSeries(const TrendSeries& series) {
  const TrendDevice& device = *series.device;
  return {{"lyrefit_trend", kStateFormat},
          {"version", Version()},
          {"name", series.name},
          {"source", ToText(series.source)},
          {"law", series.law},
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

tl::unexpected<Error> RefuseHead(const char* expected, const char* key, const std::string& path) {
  return Fail(fmt::format("expected {} in \"{}\"", expected, key), path, 1);
}

Expected<TrendSeries> SeriesOfHead(const std::string& line, const std::string& path) {
  const nlohmann::json head = nlohmann::json::parse(line, nullptr, false);
  if (!head.is_object() || !head.contains("lyrefit_trend") ||
      head["lyrefit_trend"] != kStateFormat) {
    return Fail("expected the state of a trend of format 1, found another one", path, 1);
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

}  // namespace

std::string LawText(const TrendSeries& series) {
  return HeadOfSeries(series).dump(-1, ' ', false, StateJson::error_handler_t::replace);
}

bool IsTrendState(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string begin(sizeof kStateBegin - 1, '\0');
  return in.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == kStateBegin;
}

Expected<TrendSeries> ReadTrendStateHead(const std::string& path) {
  TRY(LogReader log, LogReader::Open(path, kStateKind));
  TRY(const auto head, log.Next());
  if (!head) return Fail("expected the state of a trend, found an empty file", path);
  return SeriesOfHead(*head, path);
}

Expected<TrendSeries> ReadTrendState(const std::string& path) {
  TRY(LogReader log, LogReader::Open(path, kStateKind));
  TRY(const auto head, log.Next());
  if (!head) return Fail("expected the state of a trend, found an empty file", path);
  TRY(TrendSeries series, SeriesOfHead(*head, path));
  while (true) {
    TRY(const auto line, log.Next());
    if (!line) return series;
    TRY(TrendRow row, RowOfLine(*line, path, log.line()));
    series.rows.push_back(std::move(row));
  }
}

Expected<std::int64_t> AppendTrendState(const std::string& path, const TrendSeries& series) {
  TRY(const auto log, AppendLog::Open(path, kStateKind));
  const std::string head = LawText(series);
  std::set<double> times;
  TRY(log->TakeUp([&](const std::string& line, int number) -> Expected<void> {
    if (number == 1) {
      if (line == head) return {};
      return Fail(
          "this state follows a device by another law: begin another one, or append by the "
          "law that it has",
          path, 1);
    }
    // The time is the first number of a line: [1741775400.0,...
    char* end = nullptr;
    const double time = std::strtod(line.c_str() + 1, &end);
    if (line.empty() || line.front() != '[') {
      return Fail("this line is no row of a trend, the file is damaged", path, number);
    }
    if (end != line.c_str() + 1) times.insert(time);
    return {};
  }));
  std::string lines = log->empty() ? head + "\n" : "";
  std::int64_t written = 0;
  for (const TrendRow& row : series.rows) {
    if (std::isfinite(row.time_s) && !times.insert(row.time_s).second) continue;
    lines += LineOfRow(row);
    ++written;
  }
  if (!lines.empty()) TRY(log->Append(lines));
  return written;
}

}  // namespace lyrefit
