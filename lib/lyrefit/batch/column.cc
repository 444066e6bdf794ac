#include "lyrefit/batch/column.h"

#include <algorithm>
#include <boost/algorithm/string/finder.hpp>
#include <boost/algorithm/string/iter_find.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/sparkline.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/stream/batch_input.h"

namespace lyrefit {
namespace {

// The texts of a cell by ListCell.
std::vector<std::string> ListIn(const std::string& text, const char* between) {
  std::vector<std::string> texts;
  if (!text.empty()) boost::iter_split(texts, text, boost::first_finder(between));
  return texts;
}

}  // namespace

std::string SentenceColumn(const std::string& prefix) {
  return prefix.empty() ? "cause_sentence" : prefix + "sentence";
}

Cause CauseIn(const RowReader& reader, const ResultRow& row, const std::string& prefix,
              const std::string& power) {
  const auto text = [&](const char* name) { return reader.Text(row, prefix + name); };
  Cause cause;
  cause.id = text("cause");
  cause.title = text("cause_title");
  cause.group = text("cause_about");
  cause.sentence = reader.Text(row, SentenceColumn(prefix));
  cause.equivalents = ListIn(text("equivalents"), " ");
  cause.separate_by = ListIn(text("separate_by"), "; ");
  cause.action = text("action");
  cause.probability = reader.Number(row, prefix + "probability");
  cause.recoverable_power_W.value = reader.Number(row, power);
  return cause;
}

namespace {

constexpr char kDate[] = "date";
constexpr char kUnnamed[] = "nothing names the curve: its id is its place";
constexpr char kRatedPower[] = "rated_power_W";

std::optional<std::string> Beside(const BatchCurve& curve, const char* key) {
  const auto found = curve.beside.find(key);
  if (found == curve.beside.end() || found->second.empty()) return std::nullopt;
  return found->second;
}

std::string DateOf(const BatchCurve& curve) {
  const auto text = Beside(curve, kDate);
  return text ? *text : curve.curve ? curve.curve->notes.date : "";
}

// All values without a column of their own, as one JSON object.
std::string RestOf(const BatchCurve& curve) {
  nlohmann::json rest = nlohmann::json::object();
  for (const auto& [key, value] : curve.beside) {
    if (key != kDate && key != kRatedPower) rest[key] = value;
  }
  return rest.empty() ? "" : rest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Removes the rounding error of the subtraction from kelvin: 33.00000000000006.
double Celsius(double temperature_K) {
  return std::round((temperature_K - kZeroCelsius_K) * 1e9) / 1e9;
}

struct CommonRow {
  CommonRow(const BatchCurve& of, const BatchItem& at, const TaskResult& made)
      : curve(of), item(at), result(made) {
    if (!of.curve || !of.file.empty()) return;
    readings = &*of.curve;
    key = made.key_points.value_or(FindKeyPoints(readings->voltage_V, readings->current_A));
  }

  const BatchCurve& curve;
  const BatchItem& item;
  const TaskResult& result;
  const IvCurve* readings = nullptr;  // null: the row is not of one readable curve
  KeyPoints key;                      // of the readings
};

const ColumnList<CommonRow>& Columns() {
  using Of = const CommonRow&;
  static const ColumnList<CommonRow> columns = {
      {"id", "", "the curve's name; '/' separates the levels of a plant",
       [](Of of) { return of.curve.id; }},
      {"status", "",
       "fine; doubtful: there is an answer, but to readings that no such device gives; not usable: "
       "there is an answer, but nobody should work with it; broken: the curve could not be read or "
       "worked with",
       [](Of of) { return ToText(of.result.status); }},
      {"reason", "", "why it is not fine, in one sentence", [](Of of) { return of.result.reason; }},
      {"remark", "", "what has to be said of the row itself",
       [](Of of) { return of.item.unnamed ? kUnnamed : ""; }},
      {"where", "", "where the curve stands in the input",
       [](Of of) { return PercentCoded(of.item.where); }},
      {kDate, "", "of the measurement, as written", [](Of of) { return DateOf(of.curve); }},
      {kRatedPower, "W", "rated power, as it stands beside the curve",
       [](Of of) { return RatedPowerBeside(of.curve); }},
      {"beside", "", "what else stands beside the curve, as a JSON object",
       [](Of of) { return RestOf(of.curve); }},
      {"irradiance_Wm2", "W/m2", "irradiance; none where nobody stated it",
       [](Of of) {
         const bool known = of.readings != nullptr && of.readings->irradiance_known;
         return known ? of.readings->conditions.irradiance_W_m2 : kUnknown;
       }},
      {"temperature_C", "C", "cell temperature; none where nobody stated it",
       [](Of of) {
         const bool known = of.readings != nullptr && of.readings->temperature_known;
         return known ? Celsius(of.readings->conditions.cell_temperature_K) : kUnknown;
       }},
      {"cells_in_series", "", "cells in series that the answer is for",
       [](Of of) {
         return of.readings == nullptr ? std::optional<int>()
                                       : of.readings->conditions.cells_in_series;
       }},
      {"points", "", "readings of the curve",
       [](Of of) {
         return of.readings == nullptr ? std::optional<std::size_t>() : of.readings->size();
       }},
      {"Isc_A", "A", "measured short-circuit current",
       [](Of of) { return of.key.short_circuit_current_A; }},
      {"Voc_V", "V", "measured open-circuit voltage",
       [](Of of) { return of.key.open_circuit_voltage_V; }},
      {"Imp_A", "A", "measured current at maximum power",
       [](Of of) { return of.key.max_power_current_A; }},
      {"Vmp_V", "V", "measured voltage at maximum power",
       [](Of of) { return of.key.max_power_voltage_V; }},
      {"Pmax_W", "W", "measured maximum power", [](Of of) { return of.key.max_power_W; }},
      {"FF", "", "measured fill factor", [](Of of) { return of.key.fill_factor; }},
      {"sparkline", "",
       "24 currents at even voltages from 0 to Voc, a byte each in 1/255 of the largest, base64",
       [](Of of) {
         if (of.readings == nullptr) return std::string();
         return Sparkline(of.readings->voltage_V, of.readings->current_A,
                          of.key.open_circuit_voltage_V);
       }},
  };
  return columns;
}

}  // namespace

std::vector<ResultColumn> CommonColumns() { return HeadsOf(Columns()); }

std::vector<ResultCell> CommonCells(const BatchCurve& curve, const BatchItem& item,
                                    const TaskResult& result) {
  return CellsOf(Columns(), CommonRow(curve, item, result));
}

std::optional<double> RatedPowerBeside(const BatchCurve& curve) {
  const auto beside = curve.beside.find("rated_power_W");
  if (beside == curve.beside.end()) return std::nullopt;
  double value = 0;
  const char* const end = beside->second.data() + beside->second.size();
  const auto read = std::from_chars(beside->second.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

ResultCell NumberCell(double value) {
  return std::isfinite(value) ? ResultCell(value) : ResultCell();
}

ResultCell TextCell(const std::string& text) {
  return text.empty() ? ResultCell() : ResultCell(text);
}

ResultCell ListCell(const std::vector<std::string>& texts, const char* separator) {
  std::string joined;
  for (const std::string& text : texts) joined += (joined.empty() ? "" : separator) + text;
  return TextCell(joined);
}

namespace {

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
static_assert(kSparklinePoints % 3 == 0, "three bytes are four letters, without padding");

std::vector<double> EvenCurrents(const std::vector<std::pair<double, double>>& readings,
                                 double last_V) {
  std::vector<double> currents;
  for (int i = 0; i < kSparklinePoints; ++i) {
    const double v = last_V * i / (kSparklinePoints - 1);
    auto above = std::lower_bound(readings.begin(), readings.end(), std::make_pair(v, -HUGE_VAL));
    if (above == readings.end()) --above;
    if (above == readings.begin()) {
      currents.push_back(above->second);
      continue;
    }
    const auto below = above - 1;
    const double width = above->first - below->first;
    const double part = width > 0 ? std::min((v - below->first) / width, 1.0) : 1;
    currents.push_back(below->second + part * (above->second - below->second));
  }
  return currents;
}

}  // namespace

std::string Sparkline(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                      double open_circuit_voltage_V) {
  std::vector<std::pair<double, double>> readings;
  for (std::size_t i = 0; i < voltage_V.size(); ++i) {
    readings.emplace_back(voltage_V[i], current_A[i]);
  }
  std::sort(readings.begin(), readings.end());
  if (readings.empty()) return {};
  const bool known = open_circuit_voltage_V > 0;
  const double last_V = known ? open_circuit_voltage_V : readings.back().first;
  const std::vector<double> currents = EvenCurrents(readings, last_V);
  const double largest = *std::max_element(currents.begin(), currents.end());
  if (!(largest > 0) || !(last_V > 0)) return {};
  std::string text;
  for (int i = 0; i < kSparklinePoints; i += 3) {
    std::uint32_t bits = 0;
    for (int k = 0; k < 3; ++k) {
      const double part = std::max(currents[i + k] / largest, 0.0);
      bits = bits << 8 | static_cast<std::uint32_t>(std::lround(255 * part));
    }
    for (int shift = 18; shift >= 0; shift -= 6) text += kLetters[bits >> shift & 63];
  }
  return text;
}

std::vector<double> ReadSparkline(const std::string& text) {
  if (text.size() != kSparklinePoints / 3 * 4) return {};
  std::vector<double> parts;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t letter = kLetters.find(text[i + k]);
      if (letter == std::string_view::npos) return {};
      bits = bits << 6 | static_cast<std::uint32_t>(letter);
    }
    for (int shift = 16; shift >= 0; shift -= 8) parts.push_back((bits >> shift & 255) / 255.0);
  }
  return parts;
}

}  // namespace lyrefit
