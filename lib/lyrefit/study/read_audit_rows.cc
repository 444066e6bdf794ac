#include "lyrefit/study/read_audit_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/text_encoding.h"
#include "lyrefit/study/audit_columns.h"

namespace lyrefit {
namespace {

constexpr double kLargestNumber = 1e9;
constexpr double kColdestRow_C = -100;
constexpr double kHottestRow_C = 150;
constexpr int kMostCells = 10000;

// Condition on a number, in addition to being finite.
enum class Sign { kNotNegative, kPositive };

// One line of the table below its header.
class RowReader {
 public:
  RowReader(const AuditColumns& columns, const std::string& path)
      : columns_(columns), path_(path), fields_(columns.delimiter) {}

  Expected<AuditRow> Read(std::string_view line, int number) {
    line_ = line;
    number_ = number;
    error_.reset();
    row_ = AuditRow();
    row_.line = number;
    if (!fields_.Split(line)) return Fail("the quotes do not close", path_, number, 1);
    if (fields_.size() != columns_.fields) {
      return Fail(fmt::format("expected {} fields as in the header, found {}", columns_.fields,
                              fields_.size()),
                  path_, number,
                  FieldColumn(line, columns_.delimiter, std::min(fields_.size(), columns_.fields)));
    }
    ReadWords();
    ReadConditions();
    ReadNumbers();
    if (error_) return tl::unexpected(*error_);
    return row_;
  }

 private:
  // Keeps only the first error of a row.
  void Refuse(int field, std::string message) {
    if (!error_) error_ = Error{std::move(message), path_, number_, ColumnOf(field)};
  }

  int ColumnOf(int field) const {
    return field < 0 ? 1 : FieldColumn(line_, columns_.delimiter, static_cast<std::size_t>(field));
  }

  int FieldOf(const char* word) const {
    const auto found = columns_.words.find(word);
    return found == columns_.words.end() ? -1 : found->second;
  }

  std::string Text(int field) const {
    return field < 0 ? std::string() : std::string(fields_[static_cast<std::size_t>(field)]);
  }

  void ReadWords() {
    row_.source = Text(FieldOf("source"));
    row_.algorithm = Text(FieldOf("algorithm"));
    row_.note = Text(FieldOf("note"));
    const int device = FieldOf("device");
    row_.device = Text(device);
    row_.device_column = ColumnOf(device);
    if (row_.device.empty()) Refuse(device, "expected the name of a curve's folder or file");
    const int bounds = FieldOf("bounds");
    row_.bounds = Text(bounds);
    row_.bounds_column = ColumnOf(bounds);
    const int model = FieldOf("model");
    if (const auto known = FromText<Model>(LowerCase(Text(model)))) {
      row_.model = *known;
    } else {
      Refuse(model, fmt::format("expected a model ({}), found {}", AllTexts<Model>(),
                                Quoted(Text(model))));
    }
  }

  void ReadConditions() {
    const int temperature = FieldOf("temperature_c");
    if (const std::string text = Text(temperature); !text.empty()) {
      row_.temperature_C = ParseNumber(text);
      if (!row_.temperature_C ||
          !(*row_.temperature_C >= kColdestRow_C && *row_.temperature_C <= kHottestRow_C)) {
        Refuse(temperature, fmt::format("expected degrees Celsius from {} to {}, found {}",
                                        kColdestRow_C, kHottestRow_C, Quoted(text)));
      }
    }
    const int cells = FieldOf("cells");
    if (const std::string text = Text(cells); !text.empty()) {
      const std::optional<double> number = ParseNumber(text);
      if (number && *number >= 1 && *number <= kMostCells && *number == std::floor(*number)) {
        row_.cells = static_cast<int>(*number);
      } else {
        Refuse(cells, fmt::format("expected a number of cells in series from 1 to {}, found {}",
                                  kMostCells, Quoted(text)));
      }
    }
    const int objective = FieldOf("objective");
    if (const std::string text = Text(objective); !text.empty()) {
      row_.objective = FromText<Objective>(LowerCase(text));
      if (!row_.objective) {
        Refuse(objective, fmt::format("expected an objective ({}), found {}", AllTexts<Objective>(),
                                      Quoted(text)));
      }
    }
    const int constants = FieldOf("constants");
    if (const std::string text = Text(constants); !text.empty()) {
      row_.constants = FromText<ConstantSet>(LowerCase(text));
      if (!row_.constants) {
        Refuse(constants, fmt::format("expected a set of constants ({}), found {}",
                                      AllTexts<ConstantSet>(), Quoted(text)));
      }
    }
  }

  void ReadNumbers() {
    row_.sum_of_squares = Fills("sse");
    if (row_.sum_of_squares && Fills("rmse")) {
      Refuse(columns_.quantities.find("sse")->second.front().field,
             "expected an RMSE or a sum of squares, found both");
    }
    const bool only_squares = columns_.quantities.count("rmse") == 0;
    row_.rmse = row_.sum_of_squares || only_squares
                    ? Number("the sum of squares", "sse", Sign::kPositive)
                    : Number("RMSE", "rmse", Sign::kPositive);
    const Device device = MakeDevice(row_.model, {});
    const bool published =
        std::any_of(device.parameters.begin(), device.parameters.end(),
                    [&](const ParameterInfo& info) { return Fills(LowerCase(info.symbol)); });
    for (const ParameterInfo& info : device.parameters) {
      if (!published) break;
      const std::string name = LowerCase(info.symbol);
      const bool positive = name == "rsh" || name[0] == 'n';
      row_.parameters.push_back(
          Number(info.symbol, name, positive ? Sign::kPositive : Sign::kNotNegative));
    }
    const Device largest = MakeDevice(Model::kTripleDiode, {});
    for (int i = device.size(); i < largest.size(); ++i) {
      const std::string& symbol = largest.parameters[i].symbol;
      const auto found = columns_.quantities.find(LowerCase(symbol));
      if (found == columns_.quantities.end()) continue;
      for (const QuantityColumn& column : found->second) {
        if (Text(column.field).empty()) continue;
        Refuse(column.field, fmt::format("model {} has no {}: expected nothing here, found {}",
                                         ToText(row_.model), symbol, Quoted(Text(column.field))));
      }
    }
  }

  // True if any column of the quantity is not empty.
  bool Fills(const std::string& name) const {
    const auto found = columns_.quantities.find(name);
    return found != columns_.quantities.end() &&
           std::any_of(found->second.begin(), found->second.end(),
                       [&](const QuantityColumn& column) { return !Text(column.field).empty(); });
  }

  PrintedNumber Number(const std::string& symbol, const std::string& name, Sign sign) {
    PrintedNumber number;
    const auto found = columns_.quantities.find(name);
    if (found == columns_.quantities.end()) {
      Refuse(-1, fmt::format("model {} needs {}, and the header has no column of it",
                             ToText(row_.model), symbol));
      return number;
    }
    const QuantityColumn* filled = nullptr;
    for (const QuantityColumn& column : found->second) {
      if (Text(column.field).empty()) continue;
      if (filled != nullptr) {
        Refuse(column.field, fmt::format("{} is given twice, in two units", symbol));
        return number;
      }
      filled = &column;
    }
    if (filled == nullptr) {
      Refuse(found->second.front().field,
             fmt::format("expected {} of model {}, found nothing", symbol, ToText(row_.model)));
      return number;
    }
    number.text = Text(filled->field);
    number.factor = filled->factor;
    const std::optional<double> value = ParseNumber(number.text);
    const double least = sign == Sign::kPositive ? std::numeric_limits<double>::min() : 0;
    if (!value || !(*value >= least && *value <= kLargestNumber)) {
      Refuse(filled->field, fmt::format("expected {}, a number {} and up to {:g}, found {}", symbol,
                                        sign == Sign::kPositive ? "above 0" : "from 0",
                                        kLargestNumber, Quoted(number.text)));
      return number;
    }
    number.value = *value * number.factor;
    const bool exact =
        *value == 0 || (name[0] == 'n' && number.text.find_first_of(".eE") == std::string::npos);
    number.half_unit = exact ? 0 : HalfUnit(number.text) * number.factor;
    return number;
  }

  const AuditColumns& columns_;
  const std::string& path_;
  LineSplitter fields_;
  std::string_view line_;
  int number_ = 0;
  AuditRow row_;
  std::optional<Error> error_;
};

}  // namespace

Expected<AuditRows> ReadAuditRows(const std::string& path) {
  constexpr std::uintmax_t kLargestFile = 1U << 24;
  const Expected<DecodedText> decoded = ReadDecodedFile(path, kLargestFile);
  if (!decoded) return tl::unexpected(decoded.error());
  LineReader lines(decoded->text);
  std::string_view line;
  if (!lines.NextContent(&line)) {
    return Fail(fmt::format("expected a header line with the columns {}", kAuditColumnNames), path,
                1, 1);
  }
  const Expected<AuditColumns> columns = ReadAuditColumns(line, path, lines.number());
  if (!columns) return tl::unexpected(columns.error());
  AuditRows rows;
  rows.path = path;
  rows.remark = decoded->remark;
  RowReader reader(*columns, path);
  while (lines.NextContent(&line)) {
    Expected<AuditRow> row = reader.Read(line, lines.number());
    if (row) {
      rows.rows.push_back(std::move(*row));
    } else {
      rows.bad_rows.push_back(row.error());
    }
  }
  if (rows.rows.empty() && rows.bad_rows.empty()) {
    return Fail("expected rows below the header, found none", path, lines.number());
  }
  return rows;
}

}  // namespace lyrefit
