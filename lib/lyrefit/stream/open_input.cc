#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/line_scanner.h"
#include "lyrefit/stream/row_curve.h"
#include "lyrefit/stream/row_names.h"

namespace lyrefit {
namespace {

enum class JsonShape { kRows, kList, kWhole };

struct JsonHead {
  JsonShape shape = JsonShape::kWhole;
  std::optional<std::string> key;  // key of the list
};

std::size_t SkipSpace(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(" \t\r\n", at), text.size());
}

// True if an object holds lists or objects. A curve does, a reading does not.
bool HoldsLists(std::string_view element) {
  return element.find_first_of("[{", 1) != std::string_view::npos;
}

// True if an object is a curve only together with others of its list: a sweep of one direction, or
// one named list of numbers.
bool IsPartOfCurve(std::string_view element) {
  Records fields;
  (void)ParseJsonRow(element, &fields);  // what stands before a cut suffices
  const bool direction =
      std::any_of(fields.scalars.begin(), fields.scalars.end(),
                  [](const RecordScalar& scalar) { return scalar.name == "direction"; });
  const bool named_list = fields.lists.size() == 1 && !fields.nested &&
                          fields.scalars.size() == 1 && fields.scalars.front().is_text;
  return direction || named_list;
}

bool BeginsListOfCurves(std::string_view text, std::size_t at) {
  if (at >= text.size() || text[at] != '[') return false;
  const std::size_t first = SkipSpace(text, at + 1);
  if (first >= text.size() || text[first] != '{') return false;
  const std::string_view element = text.substr(first, SkipJsonValue(text, first) - first);
  return HoldsLists(element) && !IsPartOfCurve(element);
}

// True if a line is a JSON object, complete or truncated, with readings at its top level.
bool IsRow(std::string_view line) {
  Records fields;
  const bool whole = ParseJsonRow(line, &fields).has_value();
  const bool readings =
      std::any_of(fields.lists.begin(), fields.lists.end(), [](const Record& list) {
        const ColumnKind kind = MeaningOf(list.name).column.kind;
        return kind != ColumnKind::kUnrecognised;
      });
  return readings || (whole && !fields.lists.empty());
}

// The key of an object whose value is a list of curves.
std::optional<std::string> KeyOfList(std::string_view text, std::size_t at) {
  for (++at; at < text.size();) {
    at = SkipSpace(text, at);
    if (at >= text.size() || text[at] != '"') return std::nullopt;
    const std::size_t end = SkipJsonValue(text, at);
    const std::string key(text.substr(at + 1, end - at - 2));
    at = SkipSpace(text, end);
    if (at >= text.size() || text[at] != ':') return std::nullopt;
    at = SkipSpace(text, at + 1);
    if (BeginsListOfCurves(text, at)) return key;
    at = SkipSpace(text, SkipJsonValue(text, at));
    if (at >= text.size() || text[at] != ',') return std::nullopt;
    ++at;
  }
  return std::nullopt;
}

JsonHead LookAtJson(std::string_view text, std::size_t at) {
  if (text[at] == '[') {
    return {BeginsListOfCurves(text, at) ? JsonShape::kList : JsonShape::kWhole, {}};
  }
  // Rows: several lines that each begin an object, or one line with readings at its top level.
  const std::size_t end = std::min(text.find('\n', at), text.size());
  const std::size_t next = SkipSpace(text, end);
  const std::string_view line = text.substr(at, end - at);
  Records fields;
  const bool whole = ParseJsonRow(line, &fields).has_value();
  const bool more = next < text.size() && text[next] == '{';
  if (more || IsRow(line)) return {JsonShape::kRows, {}};
  if (const auto key = KeyOfList(text, at)) return {JsonShape::kList, key};
  const bool one_line = whole && next >= text.size();
  return {one_line && !fields.nested ? JsonShape::kRows : JsonShape::kWhole, {}};
}

// UTF-16 is detected by its byte order mark, or by zeros in every other one of the first bytes.
bool IsUtf16(std::string_view head) {
  if (head.size() < 4) return false;
  const std::string_view mark = head.substr(0, 2);
  if (mark == "\xff\xfe" || mark == "\xfe\xff") return true;
  return (head[0] == '\0') != (head[1] == '\0') && (head[2] == '\0') == (head[0] == '\0') &&
         (head[3] == '\0') == (head[1] == '\0');
}

// True if the file name's ending means rows; other shapes are then not considered.
bool IsRowsFile(const std::string& path) {
  const std::string ending = LowerCase(std::filesystem::path(path).extension().string());
  return ending == ".jsonl" || ending == ".ndjson";
}

// An input whose first bytes were read.
struct LookedAt {
  const std::string& path;
  const std::string& name;
  const ReadOptions& options;
  std::unique_ptr<LineScanner>* scanner;
  bool stream = IsReadOnce(path);

  // A stream cannot be opened again, so its scanner is passed on. A file is opened again when it is
  // read. There may be many files, and each open one holds a block of memory.
  std::unique_ptr<LineScanner> Scanner() const {
    if (stream) return std::move(*scanner);
    return std::make_unique<LineScanner>(path, options.largest_file_bytes);
  }
};

// Name of an input that cannot be read twice, for messages.
const char* Within(const std::string& path) {
  return path == "-" ? "on standard input" : "in a pipe";
}

Expected<std::unique_ptr<BatchInput>> OpenJson(const LookedAt& file, std::string_view head,
                                               std::size_t at) {
  const auto& [path, name, options, scanner, stream] = file;
  const JsonHead json = IsRowsFile(path) ? JsonHead{JsonShape::kRows, {}} : LookAtJson(head, at);
  if (json.shape == JsonShape::kRows) return JsonRowsInput(path, file.Scanner(), options);
  if (stream) {
    return Fail(fmt::format("expected rows {}, found a JSON document: name its file", Within(path)),
                path);
  }
  if (json.shape == JsonShape::kList && !options.whole_cells) {
    return JsonListInput(path, name, json.key, options);
  }
  return WholeFileInput(path, name, true, options);
}

// True if a JSON list begins, not the head of a table such as "[Header]".
bool BeginsList(std::string_view text, std::size_t at) {
  if (text[at] != '[') return false;
  const std::size_t next = SkipSpace(text, at + 1);
  constexpr std::string_view kFirst = "{[]\"-0123456789";
  return next < text.size() && kFirst.find(text[next]) != std::string_view::npos;
}

// True if the head of a table has several measurements side by side, or key points.
bool HoldsMeasurements(std::string_view head, const std::string& path, const ReadOptions& options) {
  if (!options.column.empty()) return false;
  ReadOptions first = options;
  first.column = "1";
  const std::string text = RewriteTable({std::string(head), ""}).text;
  const auto layout = FindTableLayout(text, path, first);
  return layout ? MeasurementsOf(*layout).size() > 1 : HoldsKeyPoints(text, path);
}

Expected<std::unique_ptr<BatchInput>> OpenText(const LookedAt& file, std::string_view head) {
  const auto& [path, name, options, scanner, stream] = file;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (head.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    head.remove_prefix(kByteOrderMark.size());
  }
  const std::size_t at = SkipSpace(head, 0);
  const bool json =
      at < head.size() && (head[at] == '{' || (BeginsList(head, at) && !IsTable(path)));
  if (json || IsRowsFile(path)) return OpenJson(file, head, at);
  const CsvHead csv = FindCsvHead(head, options);
  switch (csv.shape) {
    case CsvShape::kRows:
      return CsvRowsInput(path, file.Scanner(), csv, options);
    case CsvShape::kLong:
      return LongTableInput(path, file.Scanner(), csv, options);
    case CsvShape::kNoHead:
      return Fail(
          "expected a header that names the columns, such as id,voltage_V,current_A, found a row "
          "of a curve",
          path, static_cast<int>(csv.line), 1);
    case CsvShape::kNone:
      break;
  }
  if (stream) {
    return Fail(fmt::format("expected one curve a row or a long table {}, found another shape",
                            Within(path)),
                path);
  }
  const bool several = options.whole_cells || HoldsMeasurements(head, path, options);
  return WholeFileInput(path, name, several, options);
}

}  // namespace

Expected<std::unique_ptr<BatchInput>> OpenInput(const std::string& path, const std::string& name,
                                                const ReadOptions& options) {
  if (IsFolder(path)) return FolderTreeInput(path, name, options);
  if (path != "-" && !IsFile(path)) return Fail("the file does not exist", path);
  if (options.whole_files && IsReadOnce(path)) {
    return Fail("expected a file or a folder of files, one a device, found a stream: name its file",
                path);
  }
  if (options.whole_files) return WholeFileInput(path, name, false, options);
  auto scanner = std::make_unique<LineScanner>(path, options.largest_file_bytes);
  TRY(const std::string_view head, scanner->Head());
  if (IsUtf16(head)) {
    // A single curve is decoded, but rows need the original bytes.
    const std::size_t lines = std::count(head.begin(), head.end(), '\n');
    const bool one = !IsReadOnce(path) &&
                     SizeOfFile(path) <= static_cast<std::int64_t>(head.size()) &&
                     !IsRowsFile(path) && lines > 0;
    if (one) return WholeFileInput(path, name, options.whole_cells, options);
    return Fail("expected rows in UTF-8, found UTF-16: save the file as UTF-8", path);
  }
  return OpenText({path, name, options, &scanner}, head);
}

}  // namespace lyrefit
