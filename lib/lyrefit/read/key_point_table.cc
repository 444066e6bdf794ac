#include "lyrefit/read/key_point_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/curve_set_builder.h"
#include "lyrefit/read/key_point_columns.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_head.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

// Names in letters, also those of German (Ik, Uoc, Umpp), French (Icc, Vco) and Spanish (Icc, Vca,
// Ipmp) data sheets.
constexpr std::pair<std::string_view, KeyPoint> kPointNames[] = {
    {"isc", kIsc},  {"icc", kIsc},  {"ik", kIsc},   {"voc", kVoc},  {"uoc", kVoc},  {"vco", kVoc},
    {"uco", kVoc},  {"vca", kVoc},  {"imp", kImp},  {"impp", kImp}, {"ipm", kImp},  {"ipmp", kImp},
    {"im", kImp},   {"vmp", kVmp},  {"vmpp", kVmp}, {"ump", kVmp},  {"umpp", kVmp}, {"vpm", kVmp},
    {"upm", kVmp},  {"vpmp", kVmp}, {"vm", kVmp},   {"um", kVmp},   {"pmp", kPmp},  {"pmpp", kPmp},
    {"pmax", kPmp}, {"ppm", kPmp},  {"ppmp", kPmp}, {"pm", kPmp}};

// What a word says of a key point.
enum Meaning : unsigned {
  kNothing = 0,
  kCurrentWord = 1,
  kVoltageWord = 2,
  kPowerWord = 4,
  kShortWord = 8,
  kOpenWord = 16,
  kLargest = 32,
};

constexpr std::pair<std::string_view, unsigned> kWords[] = {
    {"current", kCurrentWord},  {"amperage", kCurrentWord},
    {"i", kCurrentWord},        {"voltage", kVoltageWord},
    {"v", kVoltageWord},        {"u", kVoltageWord},
    {"power", kPowerWord},      {"p", kPowerWord},
    {"short", kShortWord},      {"shortcircuit", kShortWord},
    {"sc", kShortWord},         {"open", kOpenWord},
    {"opencircuit", kOpenWord}, {"oc", kOpenWord},
    {"maximum", kLargest},      {"max", kLargest},
    {"peak", kLargest},         {"mpp", kLargest},
    {"mp", kLargest},           {"pmax", kLargest},
    {"pmpp", kLargest},         {"circuit", kNothing},
    {"point", kNothing},        {"at", kNothing},
    {"of", kNothing},           {"bei", kNothing},
};

// The key point that words name: a quantity and its place on the curve.
std::optional<KeyPoint> FromWords(const std::vector<LabelWord>& words, std::size_t count) {
  unsigned said = kNothing;
  for (std::size_t i = 0; i < count; ++i) {
    const auto* const word = std::find_if(std::begin(kWords), std::end(kWords),
                                          [&](const auto& w) { return w.first == words[i].text; });
    if (word == std::end(kWords)) return std::nullopt;
    said |= word->second;
  }
  const unsigned place = said & (kShortWord | kOpenWord | kLargest);
  const unsigned quantity = said & (kCurrentWord | kVoltageWord);
  if (place == kShortWord && quantity == kCurrentWord) return kIsc;
  if (place == kOpenWord && quantity == kVoltageWord) return kVoc;
  if (place != kLargest) return std::nullopt;
  if (quantity == kCurrentWord) return kImp;
  if (quantity == kVoltageWord) return kVmp;
  return quantity == kNothing && (said & kPowerWord) != 0 ? std::optional(kPmp) : std::nullopt;
}

std::optional<KeyPoint> Named(const std::vector<LabelWord>& words, std::size_t count) {
  const std::string name = JoinWords(words, 0, count);
  for (const auto& [text, point] : kPointNames) {
    if (text == name) return point;
  }
  return FromWords(words, count);
}

// Factor to watt, volt or ampere of a unit; 1 if there is none.
std::optional<double> FactorOf(KeyPoint point, const std::string& unit) {
  if (unit.empty()) return 1;
  if (point == kPmp) {
    if (unit == "w" || unit == "wp") return 1;
    if (unit == "mw") return 1e-3;
    return unit == "kw" ? std::optional(1e3) : std::nullopt;
  }
  const bool current = point == kIsc || point == kImp;
  const Unit* known = FindUnit(current ? ColumnKind::kCurrent : ColumnKind::kVoltage, unit);
  return known == nullptr ? std::nullopt : std::optional(known->factor);
}

}  // namespace

std::optional<KeyPointColumn> AsKeyPoint(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  for (std::size_t count = words.size(); count > 0; --count) {
    const auto point = Named(words, count);
    if (!point) continue;
    const auto factor = FactorOf(*point, JoinWords(words, count, words.size()));
    if (factor) return KeyPointColumn{*point, *factor};
  }
  return std::nullopt;
}

std::optional<MatrixColumns> AsMatrix(const std::vector<std::string>& names) {
  constexpr int kFewestPoints = 3, kConditions = 2;
  if (names.size() < kFewestPoints + kConditions) return std::nullopt;
  MatrixColumns matrix;
  int points = 0;
  bool axis = false;
  for (const std::string& name : names) {
    matrix.points.push_back(AsKeyPoint(name));
    if (!matrix.points.back()) continue;
    ++points;
    axis = axis || matrix.points.back()->point == kIsc || matrix.points.back()->point == kVoc;
  }
  if (points < kFewestPoints || !axis) return std::nullopt;
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    if (matrix.points[i]) continue;
    const Column column = RecogniseColumn(names[i]);
    if (!column.refusal.empty()) continue;
    if (IsElectrical(column.kind)) return std::nullopt;
    if (column.kind == ColumnKind::kIrradiance && matrix.irradiance_place == -1) {
      matrix.irradiance = column;
      matrix.irradiance_place = i;
    } else if (column.kind == ColumnKind::kTemperature && matrix.temperature_place == -1) {
      matrix.temperature = column;
      matrix.temperature_place = i;
    }
  }
  const bool conditions = matrix.irradiance_place != -1 && matrix.temperature_place != -1;
  return conditions ? std::optional(matrix) : std::nullopt;
}

namespace {

// A line of the table, for errors.
struct LinePlace {
  const std::string& file;
  int line;
  std::string_view text;
};

using Condition = KeyPointCondition;

struct KeyPointTable {
  std::vector<Condition> conditions;
  int names_line = 0;  // of the names of the columns; 0: a wide table
  TableHead head;
  bool skip_missing = false;   // a dash is a missing value
  std::optional<Error> error;  // of the first invalid field
};

// The header of a long table.
struct LongHeader : MatrixColumns {
  char delimiter = ',';
  Fields names;
};

std::optional<LongHeader> AsLongHeader(std::string_view line) {
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(line, delimiter);
    if (!fields) continue;
    if (auto matrix = AsMatrix(*fields)) return LongHeader{std::move(*matrix), delimiter, *fields};
  }
  return std::nullopt;
}

// The number in a field. Empty for a missing value; other text is recorded as the table's error.
std::optional<double> NumberIn(const Fields& fields, std::size_t place, const LongHeader& header,
                               const LinePlace& at, KeyPointTable* table) {
  if (place >= fields.size() || IsMissingReading(fields[place], header.delimiter != ',')) {
    return std::nullopt;
  }
  const bool dash = IsDash(fields[place]);
  if (dash && table->skip_missing) return std::nullopt;
  const auto number = ParseNumber(fields[place], header.delimiter != ',');
  if (!number && !table->error) {
    table->error =
        Error{fmt::format("expected a number in column {}, found {}{}", header.names[place],
                          Quoted(fields[place]),
                          dash ? ": --skip-missing takes a dash as a missing value" : ""),
              at.file, at.line, FieldColumn(at.text, header.delimiter, place)};
  }
  return number;
}

void ReadLongRow(const LongHeader& header, const LinePlace& at, KeyPointTable* table) {
  const auto fields = SplitFields(at.text, header.delimiter);
  if (!fields || fields->size() < 2) return;
  Condition condition;
  condition.line = at.line;
  const auto number = [&](int place) {
    return NumberIn(*fields, static_cast<std::size_t>(place), header, at, table);
  };
  const auto irradiance = number(header.irradiance_place);
  const auto temperature = number(header.temperature_place);
  if (!irradiance || !temperature) return;
  condition.irradiance_W_m2 = *irradiance * header.irradiance.factor + header.irradiance.offset;
  condition.temperature_C = *temperature * header.temperature.factor + header.temperature.offset;
  for (std::size_t i = 0; i < header.points.size(); ++i) {
    if (!header.points[i]) continue;
    const auto value = number(static_cast<int>(i));
    if (value) condition.points[header.points[i]->point] = *value * header.points[i]->factor;
  }
  table->conditions.push_back(condition);
}

// The number at the beginning of a text such as "25 C" or "1000 W/m2".
std::optional<double> LeadingNumber(const std::string& text, char delimiter) {
  const std::size_t end = text.find_first_not_of("+-.,0123456789eE");
  return ParseNumber(std::string_view(text).substr(0, end), delimiter != ',');
}

// Reads wide tables line by line: a name, a row of temperatures, rows of irradiances.
class WideReader {
 public:
  explicit WideReader(KeyPointTable* table) : table_(table) {}

  // True if the line belongs to a wide table.
  bool Take(const LinePlace& at) {
    for (const char delimiter : kFieldMarks) {
      const auto fields = SplitFields(at.text, delimiter);
      if (!fields || fields->empty()) continue;
      if (fields->size() == 1) {
        const auto point = AsKeyPoint(fields->front());
        if (!point) continue;
        point_ = point;
        temperatures_.clear();
        return true;
      }
      if (point_ && TakeRow(*fields, delimiter, at.line)) return true;
    }
    return false;
  }

 private:
  bool TakeRow(const Fields& fields, char delimiter, int line) {
    std::vector<std::optional<double>> numbers;
    for (std::size_t i = 1; i < fields.size(); ++i) {
      numbers.push_back(LeadingNumber(fields[i], delimiter));
    }
    if (temperatures_.empty()) {
      const bool header = !ParseNumber(fields[0]) &&
                          std::all_of(numbers.begin(), numbers.end(),
                                      [](const auto& number) { return number.has_value(); });
      for (const auto& number : numbers) temperatures_.push_back(number.value_or(0));
      if (!header) temperatures_.clear();
      return header;
    }
    const auto irradiance = LeadingNumber(fields[0], delimiter);
    if (!irradiance || numbers.size() > temperatures_.size()) return false;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!numbers[i]) continue;
      Condition& condition = At(*irradiance, temperatures_[i], line);
      condition.points[point_->point] = *numbers[i] * point_->factor;
    }
    return true;
  }

  Condition& At(double irradiance_W_m2, double temperature_C, int line) {
    const auto found = std::find_if(table_->conditions.begin(), table_->conditions.end(),
                                    [&](const Condition& condition) {
                                      return condition.irradiance_W_m2 == irradiance_W_m2 &&
                                             condition.temperature_C == temperature_C;
                                    });
    if (found != table_->conditions.end()) return *found;
    table_->conditions.push_back({irradiance_W_m2, temperature_C, line, {}});
    return table_->conditions.back();
  }

  KeyPointTable* table_;
  std::optional<KeyPointColumn> point_;
  std::vector<double> temperatures_;
};

KeyPointTable Parse(const std::string& text, const std::string& path, bool skip_missing = false) {
  KeyPointTable table;
  table.skip_missing = skip_missing;
  WideReader wide(&table);
  std::optional<LongHeader> header;
  LineReader lines(text);
  for (std::string_view line; lines.NextContent(&line);) {
    const LinePlace at{path, lines.number(), line};
    if (header) {
      ReadLongRow(*header, at, &table);
    } else if (table.conditions.empty() && (header = AsLongHeader(line))) {
      table.names_line = at.line;
    } else if (!wide.Take(at)) {
      ReadHeadLine(line, at.line, HeadLine::kComment, &table.head);
    }
  }
  return table;
}

// Completes Imp, Vmp and Pmp if one of them is missing. Error: all three are stated, and Pmp is not
// Imp Vmp within the rounding of such tables.
Expected<void> CompletePower(const std::string& path, Condition* condition) {
  constexpr double kRounding = 0.02;
  auto& [isc, voc, imp, vmp, pmp] = condition->points;
  const int known = static_cast<int>(imp.has_value()) + static_cast<int>(vmp.has_value()) +
                    static_cast<int>(pmp.has_value());
  if (known < 2) return {};
  if (!pmp) pmp = *imp * *vmp;
  if (!imp && *vmp > 0) imp = *pmp / *vmp;
  if (!vmp && *imp > 0) vmp = *pmp / *imp;
  if (known == 3 && !(std::fabs(*pmp / (*imp * *vmp) - 1) <= kRounding)) {
    return Fail(fmt::format("expected Pmp = Imp Vmp = {:.5g} W, found {:.5g} W", *imp * *vmp, *pmp),
                path, condition->line);
  }
  if (known == 3) pmp = *imp * *vmp;
  return {};
}

// Says how many currents and voltages are quotients of the power.
std::vector<Assumption> WhatFollowsFromPower(const std::vector<Condition>& conditions) {
  int currents = 0;
  int voltages = 0;
  for (const Condition& condition : conditions) {
    const auto& [isc, voc, imp, vmp, pmp] = condition.points;
    if (pmp && vmp && !imp) ++currents;
    if (pmp && imp && !vmp) ++voltages;
  }
  std::vector<Assumption> sentences;
  for (const auto& [count, law] : {std::pair(currents, "Imp taken as Pmp / Vmp"),
                                   std::pair(voltages, "Vmp taken as Pmp / Imp")}) {
    if (count > 0) {
      sentences.emplace_back(
          fmt::format("{} at {} condition{}", law, count, count == 1 ? "" : "s"));
    }
  }
  return sentences;
}

IvCurve CurveOf(const Condition& condition) {
  const auto& [isc, voc, imp, vmp, pmp] = condition.points;
  KeyPoints points;
  points.short_circuit_current_A = isc.value_or(kUnknown);
  points.open_circuit_voltage_V = voc.value_or(kUnknown);
  points.max_power_current_A = imp.value_or(kUnknown);
  points.max_power_voltage_V = vmp.value_or(kUnknown);
  points.max_power_W = pmp.value_or(kUnknown);
  if (isc && voc && pmp) points.fill_factor = *pmp / (*isc * *voc);
  IvCurve curve;
  TakeKeyPoints(points, &curve);
  return curve;
}

}  // namespace

bool HoldsKeyPoints(const std::string& text, const std::string& path) {
  return Parse(text, path).conditions.size() > 1;
}

Expected<CurveSet> ReadKeyPoints(const DecodedText& text, const std::string& path,
                                 const std::string& common, const ReadOptions& options) {
  const KeyPointTable table = Parse(text.text, path, options.skip_missing);
  if (table.error) return tl::unexpected(*table.error);
  TRY(CheckKeyPointColumns(table.conditions, path, table.names_line));
  CurveSetBuilder builder(std::filesystem::path(path).stem().string(), path, options);
  if (!text.remark.empty()) builder.Assume({text.remark});
  TRY(builder.ReadCommon(common, SidecarOf::kSet));
  builder.TakeHead(table.head.said);
  builder.Assume(table.head.assumptions);
  builder.Assume({fmt::format(
      "key points of {} conditions, each read as the readings (0, Isc), (Vmp, Imp) and (Voc, 0)",
      table.conditions.size())});
  builder.Assume(WhatFollowsFromPower(table.conditions));
  for (std::string& one : ImpossibleConditions(table.conditions)) builder.Assume({std::move(one)});
  std::map<std::string, int> ids;
  for (const Condition& condition : table.conditions) {
    Condition complete = condition;
    TRY(CompletePower(path, &complete));
    RawCurve raw;
    raw.curve = CurveOf(complete);
    raw.curve.source = path;
    raw.curve.name =
        fmt::format("{:g} W/m2, {:g} C", condition.irradiance_W_m2, condition.temperature_C);
    if (const int again = ++ids[raw.curve.name]; again > 1) {
      raw.curve.name += fmt::format(" ({})", again);
    }
    raw.stated.irradiance_W_m2 = condition.irradiance_W_m2;
    raw.stated.temperature_C = condition.temperature_C;
    builder.Add(std::move(raw), condition.line);
  }
  return builder.Finish();
}

}  // namespace lyrefit
