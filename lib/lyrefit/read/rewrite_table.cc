#include "lyrefit/read/rewrite_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

// The rows of a source meter's reply; empty if `text` has another form.
std::string RowsOfTrace(std::string_view text) {
  constexpr std::size_t kNumbers = 5;
  constexpr std::size_t kResistance = 2;
  constexpr double kNotMeasured = 9.9e37;
  LineReader lines(text);
  std::string_view line;
  std::string_view more;
  if (!lines.NextContent(&line) || lines.NextContent(&more)) return "";
  const auto fields = SplitFields(line, ',');
  if (!fields || fields->size() < 2 * kNumbers || fields->size() % kNumbers != 0) return "";
  std::string rows;
  for (std::size_t i = 0; i < fields->size(); ++i) {
    const auto number = ParseNumber((*fields)[i]);
    const bool fits = number && (i % kNumbers != kResistance || *number >= kNotMeasured);
    if (!fits) return "";
    rows += (*fields)[i];
    rows += i % kNumbers + 1 == kNumbers ? '\n' : ',';
  }
  return rows;
}

// First voltage and interval of an inverter's scan, in V.
struct ScanVoltages {
  std::optional<double> start;
  std::optional<double> interval;
};

// Records a line such as "Start_V: 850 V" or "Interval_V;10".
void TakeScanLine(std::string_view line, ScanVoltages* scan) {
  const std::size_t digit = line.find_first_of("0123456789");
  if (digit == 0 || digit == std::string_view::npos) return;
  const std::vector<LabelWord> words = SplitLabel(line.substr(0, digit));
  const std::size_t end = std::min(line.find_first_not_of("0123456789.", digit), line.size());
  const auto value = ParseNumber(line.substr(digit, end - digit));
  const auto names = [&](std::initializer_list<std::string_view> wanted) {
    return std::any_of(words.begin(), words.end(), [&](const LabelWord& word) {
      return std::find(wanted.begin(), wanted.end(), word.text) != wanted.end();
    });
  };
  if (!value || words.size() > 3 || !names({"v", "voltage", "volt"})) return;
  if (names({"start", "begin", "first"})) scan->start = value;
  if (names({"interval", "step"})) scan->interval = value;
}

// True if a line names currents and no voltage, with a row of numbers below it.
bool NamesCurrentsOnly(std::string_view line, LineReader below, char delimiter) {
  const auto fields = SplitFields(line, delimiter);
  if (!fields) return false;
  const std::vector<Column> columns = RecogniseAll(*fields);
  if (!HasKind(columns, ColumnKind::kCurrent) || HasKind(columns, ColumnKind::kVoltage))
    return false;
  std::string_view row;
  if (!below.NextContent(&row)) return false;
  const auto numbers = SplitFields(row, delimiter);
  return numbers && numbers->size() == fields->size() &&
         std::all_of(numbers->begin(), numbers->end(), [&](const std::string& number) {
           return ParseNumber(number, delimiter != ',').has_value();
         });
}

// The lines of a scan with a voltage in front of every row; empty if `text` has another form.
std::string RowsOfScan(std::string_view text) {
  constexpr std::size_t kLooked = 2000;
  const std::string head = LowerCase(text.substr(0, kLooked));
  if (head.find("interval") == std::string::npos && head.find("step") == std::string::npos)
    return "";
  ScanVoltages scan;
  std::string rows;
  char delimiter = 0;
  int reading = 0;
  LineReader lines(text);
  for (std::string_view line; lines.Next(&line);) {
    for (const char candidate : {'\t', ';', ','}) {
      const bool known = scan.start && scan.interval;
      if (delimiter != 0 || !known || !NamesCurrentsOnly(line, lines, candidate)) continue;
      delimiter = candidate;
      rows += fmt::format("voltage_V{}", delimiter);
      reading = -1;
    }
    if (delimiter == 0) {
      if (lines.number() > 50) return "";  // a scan states its voltages at its beginning
      TakeScanLine(line, &scan);
    } else if (reading >= 0 && !TrimBlanks(line).empty()) {
      rows += fmt::format("{}{}", *scan.start + reading * *scan.interval, delimiter);
    }
    if (delimiter != 0 && (reading < 0 || !TrimBlanks(line).empty())) ++reading;
    rows.append(line).append("\n");
  }
  return delimiter == 0 ? "" : rows;
}

constexpr std::string_view kPixelMark = "hysteresis$";

// One measurement of all pixels in one line.
struct PixelLine {
  std::string number;
  std::vector<double> area_cm2;     // of each pixel
  std::vector<std::string> fields;  // current densities of each pixel, then voltages of each
  std::size_t readings = 0;         // of a pixel
};

std::optional<PixelLine> AsPixelLine(std::string_view text) {
  constexpr std::size_t kSettings = 6;
  constexpr std::size_t kResults = 8;  // of a pixel
  const auto fields = SplitFields(text, '\t');
  if (!fields || fields->size() < 2 * kSettings) return std::nullopt;
  const auto mark = std::find_if(fields->begin(), fields->end(), [&](const std::string& field) {
    return field.compare(0, kPixelMark.size(), kPixelMark) == 0;
  });
  if (mark == fields->end() || mark - fields->begin() <= static_cast<int>(kSettings)) {
    return std::nullopt;
  }
  PixelLine line;
  line.number = fields->front();
  for (auto area = fields->begin() + kSettings; area != mark; ++area) {
    const auto value = ParseNumber(*area);
    if (!value || !(*value > 0)) return std::nullopt;
    line.area_cm2.push_back(*value);
  }
  const std::size_t results = kResults * line.area_cm2.size();
  const std::size_t left = static_cast<std::size_t>(fields->end() - mark);
  if (left <= results || (left - results) % (2 * line.area_cm2.size()) != 0) return std::nullopt;
  line.readings = (left - results) / (2 * line.area_cm2.size());
  line.fields.assign(mark + static_cast<std::ptrdiff_t>(results), fields->end());
  return line;
}

// A table with a pair of columns for each measurement and pixel, "V1.2" and "I1.2"; empty if `text`
// has another form.
std::string RowsOfPixels(std::string_view text) {
  if (text.substr(0, text.find('\n')).find(kPixelMark) == std::string_view::npos) return "";
  std::vector<PixelLine> measurements;
  LineReader lines(text);
  for (std::string_view line; lines.NextContent(&line);) {
    auto pixels = AsPixelLine(line);
    const bool same =
        pixels && (measurements.empty() || pixels->readings == measurements.front().readings);
    if (!same) return "";
    measurements.push_back(std::move(*pixels));
  }
  if (measurements.empty()) return "";
  std::string header;
  for (const PixelLine& one : measurements) {
    for (std::size_t k = 1; k <= one.area_cm2.size(); ++k) {
      header += fmt::format("{}V{}.{} (V)\tI{}.{} (A)", header.empty() ? "" : "\t", one.number, k,
                            one.number, k);
    }
  }
  std::string rows = header + "\n";
  for (std::size_t i = 0; i < measurements.front().readings; ++i) {
    std::string row;
    for (const PixelLine& one : measurements) {
      const std::size_t pixels = one.area_cm2.size();
      for (std::size_t k = 0; k < pixels; ++k) {
        const auto density = ParseNumber(one.fields[k * one.readings + i]);
        if (!density) return "";
        row += fmt::format("{}{}\t{}", row.empty() ? "" : "\t",
                           one.fields[(pixels + k) * one.readings + i],
                           1e-3 * *density * one.area_cm2[k]);
      }
    }
    rows += row + "\n";
  }
  return rows;
}

}  // namespace

DecodedText RewriteTable(DecodedText text) {
  struct Layout {
    std::string (*rows)(std::string_view);
    Setup setup;
    const char* remark;
  };
  const Layout kLayouts[] = {
      {RowsOfTrace, Setup::kUnknown,
       "one line of five numbers a reading (voltage, current, resistance, time, status), as source "
       "meters send their buffer: taken apart"},
      {RowsOfScan, Setup::kInverter,
       "currents without voltages: the voltages follow from the first one and the interval that "
       "the "
       "lines above state"},
      {RowsOfRegisters, Setup::kInverter,
       "a list of registers: taken apart into voltages, which rise or fall all the way, and "
       "currents"},
      {RowsOfPixels, Setup::kLaboratory,
       "one line a measurement with its pixels side by side: taken apart; current densities in "
       "mA/cm2 were multiplied by the areas in the line"}};
  for (const Layout& layout : kLayouts) {
    std::string rows = layout.rows(text.text);
    if (rows.empty()) continue;
    text.text = std::move(rows);
    text.setup = layout.setup;
    text.remark += (text.remark.empty() ? "" : "; ") + std::string(layout.remark);
    break;
  }
  return text;
}

}  // namespace lyrefit
