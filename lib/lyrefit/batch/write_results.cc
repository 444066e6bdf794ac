#include "lyrefit/batch/write_results.h"

#include <deque>
#include <filesystem>
#include <system_error>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/new_file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/row_text.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kCsv[] = "results.csv";
constexpr char kLines[] = "results.jsonl";
constexpr char kSchema[] = "results.schema.json";
constexpr std::uintmax_t kLargestSchema = 16U << 20;

// Calls see(group) for the groups of all rows in order. A group that is not together is passed in
// parts.
template <class See>
Expected<void> ForGroups(const std::vector<std::string>& parts,
                         const std::vector<ResultColumn>& columns, const See& see) {
  const RowReader cells(columns);
  std::string parent;
  RowGroup group;
  const auto end = [&]() -> Expected<void> {
    if (!group.rows.empty()) TRY(see(group));
    group.rows.clear();
    return {};
  };
  bool large = false;
  for (const std::string& part : parts) {
    TRY(CheckpointReader reader, CheckpointReader::Open(part));
    while (true) {
      TRY(const auto json, reader.Next());
      if (!json) break;
      ResultRow row = RowOf(columns, *json);
      std::string above = ParentOf(cells.Text(row, "id"));
      if (above != parent || above.empty()) {
        TRY(end());
        large = false;
        parent = std::move(above);
      }
      if (group.rows.size() >= kMostTogether) {
        large = true;
        group.together = false;
        TRY(end());
      }
      group.together = !large && !parent.empty();
      group.rows.push_back(std::move(row));
    }
  }
  return end();
}

// Rows passed so far, reported to an observer at intervals.
struct RowProgress {
  ProgressReporter progress;
  std::int64_t rows = 0;
  std::int64_t next = 0;
};

// An error without text after the observer requested a stop.
Expected<void> Pass(std::size_t rows, RowProgress* passed) {
  passed->rows += static_cast<std::int64_t>(rows);
  if (passed->rows < passed->next) return {};
  passed->next = passed->rows + 500;
  return passed->progress.Report({"results", passed->rows}) ? Expected<void>(Fail(""))
                                                            : Expected<void>();
}

// The columns of a checkpoint file.
Expected<std::vector<ResultColumn>> ColumnsOf(const CheckpointHead& head, const std::string& path) {
  const auto columns = ReadColumns(head.value("columns", BatchJson()));
  if (!columns) return Fail(columns.error().message, path, 1);
  return *columns;
}

std::string SchemaJson(const CheckpointHead& head, const std::vector<ResultColumn>& columns,
                       const BatchAdditions& additions) {
  // The key `lyrefit` and those of additions are extensions: the standard allows additional keys.
  BatchJson schema = {{"fields", FieldsJson(columns)},
                      {"missingValues", {""}},
                      {"primaryKey", "where"},
                      {"lyrefit", ResultsHeadOf(head)}};
  for (const auto& addition : additions) addition->AddToSchema(&schema);
  return schema.dump(2, ' ', false, BatchJson::error_handler_t::replace) + "\n";
}

// Opens the additions, which learn from all rows. Returns the columns of the results.
Expected<std::vector<ResultColumn>> Learn(const CheckpointHead& head,
                                          const std::vector<ResultColumn>& rows,
                                          const std::vector<std::string>& parts,
                                          const std::string& folder,
                                          const BatchAdditions& additions, RowProgress* passed) {
  std::vector<ResultColumn> columns = rows;
  for (const auto& addition : additions) {
    TRY(addition->Open({head, rows, parts, columns, folder}));
    Append(addition->Columns(), &columns);
  }
  if (additions.empty()) return columns;
  TRY(ForGroups(parts, rows, [&](const RowGroup& group) -> Expected<void> {
    for (const auto& addition : additions) addition->Learn(group);
    return Pass(group.rows.size(), passed);
  }));
  for (const auto& addition : additions) addition->EndLearning();
  return columns;
}

// Gives the files of the additions their names together with the `own` ones, of which the last is
// the last of all.
Expected<void> CommitAll(const fs::path& folder, const BatchAdditions& additions,
                         std::vector<NewFile*> own) {
  std::deque<NewFile> added;
  for (const auto& addition : additions) {
    for (const ResultFile& file : addition->Files()) {
      NewFile& next = added.emplace_back((folder / file.name).string());
      TRY(next.Begin());
      TRY(next.Write(file.text));
      own.insert(own.end() - 1, &next);
    }
  }
  return NewFile::Commit(own);
}

Expected<BatchResults> WriteAllResults(const std::vector<std::string>& parts,
                                       const std::string& folder, const BatchAdditions& additions,
                                       const RowObserver& row_observer, RowProgress* passed) {
  // Its digest covers all of the input.
  TRY(const CheckpointReader last, CheckpointReader::Open(parts.back()));
  TRY(const auto rows, ColumnsOf(last.head(), parts.back()));
  BatchResults results;
  TRY(results.columns, Learn(last.head(), rows, parts, folder, additions, passed));
  const bool raw = last.head().at("options").value("raw-csv", false);
  const CsvTexts texts = raw ? CsvTexts::kRaw : CsvTexts::kSafe;
  const fs::path base(folder);
  NewFile csv((base / kCsv).string());
  NewFile lines((base / kLines).string());
  NewFile schema((base / kSchema).string());
  for (NewFile* file : {&csv, &lines, &schema}) TRY(file->Begin());
  TRY(csv.Write(HeadCsv(results.columns)));
  RowCounter counter(results.columns);
  TRY(ForGroups(parts, rows, [&](RowGroup& group) -> Expected<void> {
    for (const auto& addition : additions) TRY(addition->Add(&group));
    for (const ResultRow& row : group.rows) {
      TRY(csv.Write(RowCsv(row, texts)));
      TRY(lines.Write(RowJson(results.columns, row) + "\n"));
      counter.Count(row);
      if (row_observer) row_observer(results.columns, row);
    }
    return Pass(group.rows.size(), passed);
  }));
  TRY(schema.Write(SchemaJson(last.head(), results.columns, additions)));
  static_cast<BatchCounts&>(results) = counter.counts();
  for (const auto& addition : additions) {
    AddedReport report = addition->Report();
    Append(std::move(report.fields), &results.added.fields);
    Append(std::move(report.sections), &results.added.sections);
    Append(std::move(report.causes), &results.added.causes);
  }
  TRY(CommitAll(base, additions, {&csv, &lines, &schema}));
  return results;
}

}  // namespace

std::string ParentOf(const std::string& id) {
  const std::size_t slash = id.rfind('/');
  return slash == std::string::npos ? std::string() : id.substr(0, slash);
}

CheckpointHead ResultsHeadOf(const CheckpointHead& head) {
  CheckpointHead run = head;
  for (const char* key : {"shard", "of", "columns"}) run.erase(key);
  return run;
}

Expected<void> PrepareFolder(const std::string& folder, bool replace,
                             const BatchAdditions& additions) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    const std::string why = error ? error.message() : "it is no folder";
    return Fail("cannot make the folder of the results: " + why, folder);
  }
  if (replace) return {};
  std::vector<std::string> names = {kCsv, kLines, kSchema};
  for (const auto& addition : additions) Append(addition->FileNames(), &names);
  for (const std::string& name : names) {
    const std::string path = (fs::path(folder) / name).string();
    if (fs::exists(path, error)) {
      return Fail("results are there already: name another folder, or say --force to replace them",
                  path);
    }
  }
  return {};
}

CheckpointHead ResultsHead(const std::string& folder) {
  std::error_code error;
  const fs::path base(folder);
  const bool any = fs::exists(base / kCsv, error) || fs::exists(base / kLines, error);
  const auto text = ReadFileBytes((base / kSchema).string(), kLargestSchema);
  if (!text) return any ? CheckpointHead::object() : CheckpointHead();
  const BatchJson schema = BatchJson::parse(*text, nullptr, false);
  if (!schema.is_object() || !schema.contains("lyrefit")) return CheckpointHead::object();
  return schema["lyrefit"];
}

Expected<std::optional<BatchResults>> WriteResults(const std::vector<std::string>& parts,
                                                   const std::string& folder,
                                                   const BatchAdditions& additions,
                                                   const Observer& observer,
                                                   const RowObserver& row_observer) {
  RowProgress passed{ProgressReporter(observer)};
  Expected<BatchResults> written = WriteAllResults(parts, folder, additions, row_observer, &passed);
  if (passed.progress.stop().requested()) return std::nullopt;
  return written;
}

Expected<BatchCounts> CountRows(const std::string& part) {
  TRY(CheckpointReader reader, CheckpointReader::Open(part));
  TRY(const auto columns, ColumnsOf(reader.head(), part));
  RowCounter counter(columns);
  while (true) {
    TRY(const auto json, reader.Next());
    if (!json) return counter.counts();
    counter.Count(RowOf(columns, *json));
  }
}

}  // namespace lyrefit
