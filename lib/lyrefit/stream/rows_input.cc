#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/line_scanner.h"
#include "lyrefit/stream/row_curve.h"
#include "lyrefit/stream/row_names.h"

namespace lyrefit {
namespace {

// Common base of JSON and CSV rows: one line is one curve.
class RowsInput : public FileInput {
 public:
  RowsInput(std::string path, std::unique_ptr<LineScanner> scanner, const ReadOptions& options)
      : FileInput(std::move(path), options), scanner_(std::move(scanner)) {}

  Expected<std::optional<FoundCurve>> Next() override {
    ScannedLine line;
    for (;;) {
      const Expected<bool> more = scanner_ == nullptr ? false : scanner_->Next(&line);
      if (!more) return tl::unexpected(more.error());
      if (!*more) {
        scanner_.reset();  // releases its block of memory, since there may be many inputs
        return std::optional<FoundCurve>();
      }
      if (line.number > HeadLine() && !TrimBlanks(line.text).empty()) break;
    }
    ForgetManyNames();
    FoundCurve found;
    found.id = IdOf(line.text);
    found.stated = true;
    found.line = line.number;
    found.begin = line.offset;
    found.end = line.end;
    found.bytes = line.text;
    if (line.too_long) {
      found.error = Error{fmt::format("the row is longer than the limit of {} bytes", RowLimit()),
                          path_, static_cast<int>(line.number)};
    }
    return std::optional<FoundCurve>(std::move(found));
  }

 protected:
  virtual std::int64_t HeadLine() const { return 0; }  // this line and all before it are no rows
  virtual std::string IdOf(std::string_view row) const = 0;

  std::uintmax_t RowLimit() const { return options_.largest_file_bytes; }

 private:
  std::unique_ptr<LineScanner> scanner_;
};

class JsonRows : public RowsInput {
 public:
  using RowsInput::RowsInput;

  BatchCurve Read(const BatchItem& item) const override {
    return ReadJsonText(item.bytes, item, path_, {}, options_);
  }

 protected:
  std::string IdOf(std::string_view row) const override {
    Records fields;
    ScanJsonScalars(row, &fields);
    return lyrefit::IdOf(fields.scalars);
  }
};

class CsvRows : public RowsInput {
 public:
  CsvRows(std::string path, std::unique_ptr<LineScanner> scanner, CsvHead head,
          const ReadOptions& options)
      : RowsInput(std::move(path), std::move(scanner), options), head_(std::move(head)) {}

  BatchCurve Read(const BatchItem& item) const override {
    ForgetManyNames();
    const RecordPlace place{path_, item.line};
    Records fields;
    BatchCurve curve;
    curve.id = item.id;
    const auto parsed = ParseCsvRow(item.bytes, head_, &fields);
    if (!parsed) {
      curve.curve = place.Refuse(parsed.error().message, parsed.error().column);
      return curve;
    }
    curve.beside = BesideOfRow(fields);
    curve.curve = CurveOfRow(fields, place, item.id, options_);
    return curve;
  }

  void AddRemarks(std::vector<std::string>* remarks) const override {
    if (head_.time_column < 0) return;
    remarks->push_back(fmt::format("{}: an id stands in several rows: completed by column {}",
                                   path_, Quoted(head_.names[head_.time_column])));
  }

 protected:
  std::int64_t HeadLine() const override { return head_.line; }
  std::string IdOf(std::string_view row) const override { return IdOfCsvRow(row, head_); }

 private:
  const CsvHead head_;
};

}  // namespace

std::unique_ptr<BatchInput> JsonRowsInput(const std::string& path,
                                          std::unique_ptr<LineScanner> scanner,
                                          const ReadOptions& options) {
  return std::make_unique<JsonRows>(path, std::move(scanner), options);
}

std::unique_ptr<BatchInput> CsvRowsInput(const std::string& path,
                                         std::unique_ptr<LineScanner> scanner, const CsvHead& head,
                                         const ReadOptions& options) {
  return std::make_unique<CsvRows>(path, std::move(scanner), head, options);
}

namespace {

// The rows of one curve during parsing.
struct LongReading {
  const CsvHead& head;
  RecordPlace place;
  std::vector<int> list_of;        // for each column: position of its list, -1 if it has none
  std::vector<bool> varies;        // for each column: its field differs between rows
  std::vector<std::string> first;  // fields of the first row
  Records fields;
};

LongReading Begin(const CsvHead& head, const RecordPlace& place) {
  LongReading reading{head, place, {}, std::vector<bool>(head.names.size(), false), {}, {}};
  for (std::size_t i = 0; i < head.names.size(); ++i) {
    const bool is_id = std::find(head.id_columns.begin(), head.id_columns.end(),
                                 static_cast<int>(i)) != head.id_columns.end();
    const ColumnKind kind = MeaningOf(head.names[i]).column.kind;
    const bool reads = !is_id && kind != ColumnKind::kUnrecognised && kind != ColumnKind::kCurve &&
                       kind != ColumnKind::kArea;
    reading.list_of.push_back(reads ? static_cast<int>(reading.fields.lists.size()) : -1);
    if (!reads) continue;
    Record list;
    list.name = head.names[i];
    reading.fields.lists.push_back(std::move(list));
  }
  return reading;
}

// Adds a field to the list of its column, with the line of an invalid value.
void TakeReading(LongReading* reading, std::size_t field, std::string_view text,
                 std::string_view row, std::int64_t line) {
  Record& list = reading->fields.lists[reading->list_of[field]];
  const bool was_bad = list.has_bad;
  const bool was_text = list.bad_is_text;
  AddReading(TrimBlanks(text), reading->head.delimiter != ',', 1, &list);
  const bool bad = list.has_bad && (!was_bad || list.bad_is_text != was_text);
  if (!bad) return;
  list.bad_line = line;
  list.bad_column = FieldColumn(row, reading->head.delimiter, field);
}

Expected<void> TakeLine(LongReading* reading, LineSplitter* splitter, std::string_view row,
                        std::int64_t line) {
  const auto refuse = [&](std::string message) {
    return reading->place.Refuse(std::move(message), 1, line);
  };
  if (row.find('\0') != std::string_view::npos) return refuse("expected text, found a zero byte");
  if (!splitter->Split(row)) return refuse("expected closed quotes in one line");
  std::size_t size = splitter->size();
  const std::size_t wanted = reading->head.names.size();
  while (size > wanted && TrimBlanks((*splitter)[size - 1]).empty()) --size;
  if (size != wanted) {
    return refuse(fmt::format("expected {} fields as in the header, found {}", wanted, size));
  }
  const bool first = reading->first.empty();
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::string_view text = (*splitter)[i];
    if (reading->list_of[i] != -1) TakeReading(reading, i, text, row, line);
    if (first) {
      reading->first.emplace_back(text);
    } else if (text != reading->first[i]) {
      reading->varies[i] = true;
    }
  }
  return {};
}

// Adds columns without readings that are equal in all rows as scalars, such as a condition or a
// date.
void SettleColumns(LongReading* reading) {
  for (std::size_t i = 0; i < reading->first.size(); ++i) {
    const int list = reading->list_of[i];
    const bool reads = list != -1 && !reading->fields.lists[list].bad_is_text;
    if (reads || reading->varies[i]) continue;
    reading->fields.scalars.push_back(
        {reading->head.names[i], ScalarText(TrimBlanks(reading->first[i]), reading->head.delimiter),
         false, 1});
  }
}

// One reading a row; the rows of a curve are adjacent.
class LongTable : public FileInput {
 public:
  LongTable(std::string path, std::unique_ptr<LineScanner> scanner, CsvHead head,
            const ReadOptions& options)
      : FileInput(std::move(path), options), head_(std::move(head)), scanner_(std::move(scanner)) {}

  Expected<std::optional<FoundCurve>> Next() override {
    if (!over_ && number_ == 0) TRY(Advance());
    if (over_) return std::optional<FoundCurve>();
    FoundCurve found;
    found.id = id_;
    found.stated = true;
    found.line = line_.number;
    found.begin = line_.offset;
    bytes_.clear();
    const std::int64_t first = line_.number;
    std::int64_t expected = first;
    while (!over_ && id_ == found.id) {
      // Blank lines between rows are kept, so that later rows keep their line numbers.
      bytes_.append(static_cast<std::size_t>(line_.number - expected), '\n');
      expected = line_.number + 1;
      if (line_.too_long || bytes_.size() > options_.largest_file_bytes) {
        found.error = Error{fmt::format("the rows of the curve are longer than the limit of {} "
                                        "bytes",
                                        options_.largest_file_bytes),
                            path_, static_cast<int>(first)};
      }
      if (!found.error) bytes_.append(line_.text).append("\n");
      found.end = line_.end;
      TRY(Advance());
    }
    found.bytes = bytes_;
    return std::optional<FoundCurve>(std::move(found));
  }

  BatchCurve Read(const BatchItem& item) const override {
    ForgetManyNames();
    BatchCurve curve;
    curve.id = item.id;
    LongReading reading = Begin(head_, RecordPlace{path_, item.line});
    LineSplitter splitter(head_.delimiter);
    std::string_view text = item.bytes;
    for (std::int64_t line = item.line; !text.empty(); ++line) {
      const std::size_t end = text.find('\n');
      const std::string_view row = text.substr(0, end);
      text.remove_prefix(std::min(end, text.size() - 1) + 1);
      if (TrimBlanks(row).empty()) continue;
      if (auto taken = TakeLine(&reading, &splitter, row, line); !taken) {
        curve.curve = tl::unexpected(taken.error());
        return curve;
      }
    }
    SettleColumns(&reading);
    curve.beside = BesideOfRow(reading.fields);
    curve.curve = CurveOfRow(reading.fields, reading.place, item.id, options_);
    return curve;
  }

 private:
  // Moves to the next row.
  Expected<void> Advance() {
    for (;;) {
      TRY(const bool more, scanner_->Next(&line_));
      over_ = !more;
      if (over_) {
        scanner_.reset();
        return {};
      }
      number_ = line_.number;
      if (line_.number > head_.line && !TrimBlanks(line_.text).empty()) break;
    }
    if (line_.text.size() > id_text_.size() &&
        line_.text.compare(0, id_text_.size(), id_text_) == 0 && !id_text_.empty()) {
      return {};  // same id as in the row before
    }
    std::size_t looked_at = 0;
    id_ = IdOfCsvRow(line_.text, head_, &looked_at);
    id_text_ = line_.text.substr(0, looked_at == line_.text.size() ? 0 : looked_at);
    return {};
  }

  const CsvHead head_;
  std::unique_ptr<LineScanner> scanner_;
  ScannedLine line_;
  std::string id_;
  std::string id_text_;  // beginning of the row, which determines `id_`
  std::string bytes_;
  std::int64_t number_ = 0;
  bool over_ = false;
};

}  // namespace

std::unique_ptr<BatchInput> LongTableInput(const std::string& path,
                                           std::unique_ptr<LineScanner> scanner,
                                           const CsvHead& head, const ReadOptions& options) {
  return std::make_unique<LongTable>(path, std::move(scanner), head, options);
}

}  // namespace lyrefit
