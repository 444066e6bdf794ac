#include <fmt/format.h>

#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/json_row.h"
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

}  // namespace lyrefit
