#include "lyrefit/batch/result_columns.h"

#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/sparkline.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/stream/batch_input.h"

namespace lyrefit {
namespace {

constexpr char kDate[] = "date";
constexpr char kUnnamed[] = "nothing names the curve: its id is its place";
constexpr char kRatedPower[] = "rated_power_W";
constexpr std::size_t kReadingCells = 11;

std::optional<std::string> Beside(const BatchCurve& curve, const char* key) {
  const auto found = curve.beside.find(key);
  if (found == curve.beside.end() || found->second.empty()) return std::nullopt;
  return found->second;
}

ResultCell RatedPower(const BatchCurve& curve) {
  const std::optional<std::string> text = Beside(curve, kRatedPower);
  if (!text) return {};
  double value = kUnknown;
  const char* const end = text->data() + text->size();
  const auto read = std::from_chars(text->data(), end, value);
  return read.ec == std::errc() && read.ptr == end ? NumberCell(value) : ResultCell();
}

ResultCell Date(const BatchCurve& curve) {
  if (const auto text = Beside(curve, kDate)) return *text;
  return curve.curve ? TextCell(curve.curve->notes.date) : ResultCell();
}

// All values without a column of their own, as one JSON object.
ResultCell Rest(const BatchCurve& curve) {
  nlohmann::json rest = nlohmann::json::object();
  for (const auto& [key, value] : curve.beside) {
    if (key != kDate && key != kRatedPower) rest[key] = value;
  }
  if (rest.empty()) return {};
  return rest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<ResultCell> ReadingCells(const IvCurve& curve, const TaskResult& result) {
  const Conditions& at = curve.conditions;
  // Removes the rounding error of the subtraction from kelvin: 33.00000000000006.
  const double celsius = std::round((at.cell_temperature_K - kZeroCelsius_K) * 1e9) / 1e9;
  const KeyPoints key =
      result.key_points ? *result.key_points : FindKeyPoints(curve.voltage_V, curve.current_A);
  return {NumberCell(curve.irradiance_known ? at.irradiance_W_m2 : kUnknown),
          NumberCell(curve.temperature_known ? celsius : kUnknown),
          std::int64_t{at.cells_in_series},
          static_cast<std::int64_t>(curve.size()),
          NumberCell(key.short_circuit_current_A),
          NumberCell(key.open_circuit_voltage_V),
          NumberCell(key.max_power_current_A),
          NumberCell(key.max_power_voltage_V),
          NumberCell(key.max_power_W),
          NumberCell(key.fill_factor),
          TextCell(Sparkline(curve.voltage_V, curve.current_A, key.open_circuit_voltage_V))};
}

}  // namespace

std::vector<ResultColumn> CommonColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  constexpr CellType kWhole = CellType::kWhole;
  return {
      {"id", "", kText, "the curve's name; '/' separates the levels of a plant"},
      {"status", "", kText,
       "fine; doubtful: there is an answer, but to readings that no such device gives; not usable: "
       "there is an answer, but nobody should work with it; broken: the curve could not be read or "
       "worked with"},
      {"reason", "", kText, "why it is not fine, in one sentence"},
      {"remark", "", kText, "what has to be said of the row itself"},
      {"where", "", kText, "where the curve stands in the input"},
      {kDate, "", kText, "of the measurement, as written"},
      {kRatedPower, "W", kNumber, "rated power, as it stands beside the curve"},
      {"beside", "", kText, "what else stands beside the curve, as a JSON object"},
      {"irradiance_Wm2", "W/m2", kNumber, "irradiance; none where nobody stated it"},
      {"temperature_C", "C", kNumber, "cell temperature; none where nobody stated it"},
      {"cells_in_series", "", kWhole, "cells in series that the answer is for"},
      {"points", "", kWhole, "readings of the curve"},
      {"Isc_A", "A", kNumber, "measured short-circuit current"},
      {"Voc_V", "V", kNumber, "measured open-circuit voltage"},
      {"Imp_A", "A", kNumber, "measured current at maximum power"},
      {"Vmp_V", "V", kNumber, "measured voltage at maximum power"},
      {"Pmax_W", "W", kNumber, "measured maximum power"},
      {"FF", "", kNumber, "measured fill factor"},
      {"sparkline", "", kText,
       "24 currents at even voltages from 0 to Voc, a byte each in 1/255 of the largest, base64"},
  };
}

std::vector<ResultCell> CommonCells(const BatchCurve& curve, const BatchItem& item,
                                    const TaskResult& result) {
  std::vector<ResultCell> cells = {TextCell(curve.id),
                                   std::string(ToText(result.status)),
                                   TextCell(result.reason),
                                   item.unnamed ? TextCell(kUnnamed) : ResultCell(),
                                   TextCell(PercentCoded(item.where)),
                                   Date(curve),
                                   RatedPower(curve),
                                   Rest(curve)};
  std::vector<ResultCell> readings(kReadingCells);
  if (curve.curve && curve.file.empty()) readings = ReadingCells(*curve.curve, result);
  for (ResultCell& cell : readings) cells.push_back(std::move(cell));
  return cells;
}

}  // namespace lyrefit
