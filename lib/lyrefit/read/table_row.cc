#include "lyrefit/read/table_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {

Expected<void> TableRow::Split(std::string_view line, int number) {
  line_ = line;
  number_ = number;
  if (!splitter_.Split(line)) return Refuse("expected closed quotes", 0);
  return {};
}

Expected<void> TableRow::Take(std::string_view line, int number) {
  TRY(Split(line, number));
  return CheckLength();
}

std::string TableRow::ColumnName(int field) const {
  const std::string& label = columns_[field].label;
  if (!label.empty()) return "column " + label;
  return "column " + std::to_string(field + 1);
}

tl::unexpected<Error> TableRow::Refuse(std::string message, int field) const {
  return Fail(std::move(message), file_, number_, FieldColumn(line_, delimiter_, field));
}

tl::unexpected<Error> TableRow::RefuseField(int field, std::string_view expected) const {
  const std::string_view text = splitter_[field];
  const std::string found = text.empty() ? "an empty field" : Quoted(text);
  return Refuse(fmt::format("expected {} in {}, found {}", expected, ColumnName(field), found),
                field);
}

tl::unexpected<Error> TableRow::RefuseMissing(int field, std::string_view expected) const {
  Error error = RefuseField(field, expected).value();
  error.message += ": if readings are missing, leave their rows out with --skip-missing";
  return tl::unexpected(std::move(error));
}

Expected<void> TableRow::CheckLength() const {
  std::size_t size = splitter_.size();
  const std::size_t expected = columns_.size();
  while (size > expected && splitter_[size - 1].empty()) --size;
  if (size == expected) return {};
  // LabVIEW leaves out the field of an empty comment, together with its delimiter.
  if (size + 1 == expected && LowerCase(columns_.back().label) == "comment") return {};
  std::string hint;
  if (size == 2 * expected && delimiter_ == ',') {
    hint = " (with a decimal comma, separate the columns by ';' or tab)";
  }
  return Refuse(fmt::format("expected {} fields as in the first line of the table, found {}{}",
                            expected, size, hint),
                size > expected ? static_cast<int>(expected) : 0);
}

Expected<double> TableRow::Value(int field) {
  const std::string_view text = splitter_[field];
  const auto number = ParseNumber(text, delimiter_ != ',');
  if (!number && text.empty()) return RefuseMissing(field, "a number");
  if (const auto more = std::count(text.begin(), text.end(), ';'); !number && more > 1) {
    return Refuse(
        fmt::format("expected a number in {}, found a list of {}: write one reading a line",
                    ColumnName(field), more + 1),
        field);
  }
  if (!number && delimiter_ == ',' && ParseNumber(text, true)) {
    return RefuseField(
        field,
        "a number without a comma (leave out marks of thousands; with a decimal comma, "
        "separate the columns by ';' or tab)");
  }
  if (!number) return RefuseField(field, "a number");
  if (!std::isfinite(*number)) return RefuseMissing(field, "a finite number");
  TRY(CheckSeparator(field, text));
  const Column& column = columns_[field];
  const double value = *number * column.factor + column.offset;
  if (!std::isfinite(value)) return RefuseField(field, "a finite number");
  if (column.kind == ColumnKind::kSigma && !(value > 0)) {
    return RefuseField(field, "a positive number");
  }
  if (column.kind == ColumnKind::kTemperature && (value > 150 || value < -100)) {
    return Refuse(fmt::format("expected a temperature in degrees Celsius in {}, found {}{}",
                              ColumnName(field), Quoted(text),
                              value > 150 ? ": looks like kelvin (name the column temperature_K)"
                                          : ": too cold for a cell"),
                  field);
  }
  return value;
}

Expected<int> TableRow::WholeNumber(int field) {
  if (columns_[field].kind == ColumnKind::kSweep) {
    const ColumnTag tag = ReadTag(splitter_[field]);
    const bool alone = tag.device.empty() && tag.light == SweepLight::kUnknown;
    if (alone && tag.direction == SweepDirection::kForward) return 1;
    if (alone && tag.direction == SweepDirection::kReverse) return 2;
  }
  TRY(const double value, Value(field));
  const bool whole = value == std::floor(value) && std::abs(value) <= 1e9;
  if (!whole) return RefuseField(field, "a whole number");
  return static_cast<int>(value);
}

// Detects a thousands separator: "1,234" beside "0.5" is not a decimal comma.
Expected<void> TableRow::CheckSeparator(int field, std::string_view text) {
  if (delimiter_ == ',') return {};
  const std::size_t last = text.find_last_of(",.");  // earlier ones separate thousands
  const char found = last == std::string_view::npos ? '\0' : text[last];
  if (found == '\0' || found == separator_) return {};
  if (separator_ == '\0') {
    separator_ = found;
    return {};
  }
  return RefuseField(field, fmt::format("a number with decimal '{}' as above", separator_));
}

Expected<void> CheckUtf8(std::string_view text, const std::string& file) {
  const auto bad = FirstInvalidUtf8(text);
  if (!bad) return {};
  int line = 1;
  std::size_t begin = 0;
  for (std::size_t at; (at = text.find('\n', begin)) < *bad; begin = at + 1) ++line;
  return Fail("expected UTF-8 text, found a byte of another encoding: save the file as UTF-8", file,
              line, static_cast<int>(*bad - begin) + 1);
}

}  // namespace lyrefit
