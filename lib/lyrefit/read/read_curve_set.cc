#include "lyrefit/read/read_curve_set.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/curve_set_builder.h"
#include "lyrefit/read/curve_text.h"
#include "lyrefit/read/json_curves.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/multi_flash.h"
#include "lyrefit/read/read_table.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// A curve of a table, and the line of its first row.
struct TablePart {
  IvCurve curve;
  int line;
};

void AppendRow(const IvCurve& all, std::size_t row, IvCurve* curve) {
  curve->voltage_V.push_back(all.voltage_V[row]);
  curve->current_A.push_back(all.current_A[row]);
  curve->sweep.push_back(all.sweep[row]);
  for (const auto column :
       {&IvCurve::sigma_A, &IvCurve::time_s, &IvCurve::irradiance_W_m2, &IvCurve::temperature_C}) {
    if (!(all.*column).empty()) (curve->*column).push_back((all.*column)[row]);
  }
}

// The curves of a table in order of their first rows, without those that have invalid rows.
std::vector<TablePart> SplitTable(const Table& table, const std::string& path) {
  std::vector<TablePart> parts;
  std::map<int, std::size_t> places;
  for (std::size_t row = 0; row < table.curve.size(); ++row) {
    const int number = table.curve.sweep[row];
    if (table.broken.count(number) != 0) continue;
    const auto [place, is_new] = places.try_emplace(number, parts.size());
    if (is_new) {
      parts.push_back({{}, table.lines[row]});
      parts.back().curve.name = std::to_string(number);
      parts.back().curve.source = path;
      parts.back().curve.voltage_unit_known = table.curve.voltage_unit_known;
      parts.back().curve.current_unit_known = table.curve.current_unit_known;
    }
    AppendRow(table.curve, row, &parts[place->second].curve);
  }
  return parts;
}

// Adds each measurement side by side as a curve, named by its current.
void AddChannels(std::vector<Table> tables, const std::string& path, CurveSetBuilder* builder) {
  std::set<std::string> ids;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    Table& table = tables[i];
    RawCurve raw{std::move(table.curve), table.head, table.per_area};
    raw.curve.source = path;
    raw.curve.name = table.name;
    if (!ids.insert(raw.curve.name).second) raw.curve.name += fmt::format(" ({})", i + 1);
    if (!table.broken.empty()) table.error = table.broken.begin()->second;
    if (table.error) {
      builder->Reject(raw.curve.name, *table.error);
      continue;
    }
    if (auto whole = SelectSweep(std::nullopt, table.holds_curves, &raw.curve); !whole) {
      builder->Reject(raw.curve.name, {whole.error().message, path});
      continue;
    }
    TurnLoadSign(&raw.curve);
    builder->Add(std::move(raw), 0);
  }
}

// Adds a curve for each number in the column curve or sweep, and for each further table below.
Expected<void> AddSweeps(const Table& table, const std::string& path, const fs::path& index,
                         CurveSetBuilder* builder) {
  if (table.error) return tl::unexpected(*table.error);
  if (table.curve.sweep.empty() && table.broken.empty()) {
    return Fail("expected a column curve or sweep that tells several curves apart, found none",
                path);
  }
  builder->Assume(table.curve.assumptions);
  builder->TakeHead(table.head);
  TRY(builder->ReadIndex(index.string(), IndexIds::kNumbers));
  std::set<std::string> ids;
  for (TablePart& part : SplitTable(table, path)) {
    ids.insert(part.curve.name);
    TurnLoadSign(&part.curve);
    builder->Add({std::move(part.curve), {}, table.per_area}, part.line);
  }
  for (const auto& [number, error] : table.broken) {
    ids.insert(std::to_string(number));
    builder->Reject(std::to_string(number), error);
  }
  return builder->CheckIndex(ids);
}

// `path` is the table; `source` is the path that the caller gave, the table or its folder.
Expected<CurveSet> SetFromTable(const DecodedText& decoded, const std::string& path,
                                const std::string& source, const ReadOptions& options) {
  const DecodedText text = RewriteTable(decoded);
  const fs::path file(path);
  const bool in_folder = file.filename() == kCurvesName;
  const std::string name = in_folder ? FolderNameOf(file) : file.stem().string();
  CurveSetBuilder builder(name, source, options);
  if (!text.remark.empty()) builder.Assume({text.remark});
  Sidecar by_layout;
  TakeSetup(text.setup, "the layout of the file", &by_layout);
  const fs::path common =
      in_folder ? file.parent_path() / kDatasetName : fs::path(file).replace_extension(".json");
  const fs::path index = file.parent_path() / (in_folder ? kIndexName : name + "-index.csv");
  auto read = ReadTables(text.text, path, options, BrokenRows::kSetAside);
  if (!read && HoldsKeyPoints(text.text, path)) {
    return ReadKeyPoints(text, path, common.string(), options);
  }
  TRY(std::vector<Table> tables, std::move(read));
  TRY(builder.ReadCommon(common.string(), in_folder ? SidecarOf::kSet : SidecarOf::kCurve));
  builder.TakeHead(by_layout);
  const bool several_devices = tables.size() > 1 && tables.front().of_device;
  if (tables.size() > 1) {
    AddChannels(std::move(tables), path, &builder);
  } else {
    TRY(AddSweeps(tables.front(), path, index, &builder));
  }
  TRY(CurveSet set, builder.Finish());
  set.several_devices = several_devices;
  return set;
}

Expected<CurveSet> ReadSetFromTable(const std::string& path, const std::string& source,
                                    const ReadOptions& options) {
  TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
  return SetFromTable(text, path, source, options);
}

Expected<void> AddFromFile(const fs::path& table, const std::string& id, const ReadOptions& options,
                           CurveSetBuilder* builder) {
  TRY(CheckIsNoStream(table));
  TRY(RawCurve raw, ReadTableCurve(table.string(), options));
  raw.curve.name = id;
  builder->Add(std::move(raw), 0);
  return {};
}

Expected<CurveSet> ReadFromTables(const std::string& folder, const ReadOptions& options) {
  const std::vector<fs::path> tables = TablesIn(folder);
  if (tables.empty()) {
    std::error_code error;
    return Fail(
        fmt::format("expected curves.csv or tables of one curve each (.csv, .tsv, .txt, ...), "
                    "found {}",
                    fs::is_empty(folder, error) ? "an empty folder" : "a folder without"),
        folder);
  }
  const fs::path inside(folder);
  CurveSetBuilder builder(FolderNameOf(inside / kCurvesName), folder, options);
  auto read =
      builder.ReadCommon((inside / kDatasetName).lexically_normal().string(), SidecarOf::kSet);
  if (read) {
    read = builder.ReadIndex((inside / kIndexName).lexically_normal().string(), IndexIds::kFiles);
  }
  if (!read) return tl::unexpected(read.error());
  std::set<std::string> ids;
  for (const fs::path& table : tables) {
    const std::string id = table.stem().string();
    if (!ids.insert(id).second) {
      return Fail(
          fmt::format("expected one table a curve, found a second one of curve {}", Quoted(id)),
          table.string());
    }
  }
  TRY(builder.CheckIndex(ids));
  for (const fs::path& table : tables) {
    const std::string id = table.stem().string();
    const auto added = AddFromFile(table, id, options, &builder);
    if (!added) builder.Reject(id, added.error());
  }
  return builder.Finish();
}

Expected<CurveSet> SetFromJson(const nlohmann::json& document, const std::string& path,
                               const ReadOptions& options) {
  CurveSetBuilder builder(fs::path(path).stem().string(), path, options);
  if (!IsIvCurves(document)) {
    TRY(JsonCurves found, FindJsonCurves(document, path, options));
    for (RawCurve& raw : found.curves) builder.Add(std::move(raw), 0);
    for (RejectedCurve& rejected : found.rejected) {
      builder.Reject(std::move(rejected.id), std::move(rejected.error));
    }
    return builder.Finish();
  }
  TRY(std::vector<IvCurvesEntry> entries, ReadIvCurvesEntries(document, path));
  for (IvCurvesEntry& entry : entries) {
    if (entry.curve) {
      entry.curve->name = entry.id;
      builder.AddSettled(std::move(*entry.curve));
    } else {
      builder.Reject(entry.id, entry.curve.error());
    }
  }
  return builder.Finish();
}

// The curves of a multi-flash tester at several lights, and its Suns-Voc trace.
Expected<CurveSet> SetFromFlashes(const DecodedText& text, const std::string& path,
                                  const ReadOptions& options) {
  TRY(MultiFlash flashes, ReadMultiFlash(text.text, path));
  CurveSetBuilder builder(fs::path(path).stem().string(), path, options);
  TRY(builder.ReadCommon(fs::path(path).replace_extension(".json").string(), SidecarOf::kSet));
  for (RawCurve& raw : flashes.curves) builder.Add(std::move(raw), 0);
  return builder.Finish();
}

}  // namespace

Expected<CurveSet> CurveSetOfFile(const DecodedText& text, const std::string& path,
                                  const ReadOptions& options) {
  TRY(const std::optional<nlohmann::json> document, DocumentIn(text.text, path));
  if (document) return SetFromJson(*document, path, options);
  if (IsMultiFlash(text.text)) return SetFromFlashes(text, path, options);
  return SetFromTable(text, path, path, options);
}

Expected<CurveSet> ReadCurveSet(const std::string& path, const ReadOptions& options) {
  if (options.curve) {
    return Fail(
        fmt::format("a set is read whole, but curve {} alone was asked for", *options.curve), path);
  }
  if (!IsFolder(path)) {
    TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
    return CurveSetOfFile(text, path, options);
  }
  const fs::path curves = fs::path(path) / kCurvesName;
  if (IsFile(curves)) return ReadSetFromTable(curves.lexically_normal().string(), path, options);
  if (const fs::path one = CurveInFolder(path); !one.empty()) {
    return Fail(fmt::format("expected several curves, found a folder of one (it holds {})",
                            one.filename().string()),
                path);
  }
  return ReadFromTables(path, options);
}

namespace {

namespace fs = std::filesystem;

bool FolderHoldsSet(const fs::path& folder) {
  if (IsFile(folder / kCurvesName)) return true;
  return CurveInFolder(folder).empty() && !TablesIn(folder).empty();
}

bool JsonHoldsSet(const nlohmann::json& document, const std::string& path,
                  const ReadOptions& options) {
  if (!IsIvCurves(document)) {
    const auto curves = FindJsonCurves(document, path, options);
    return curves && curves->size() > 1;
  }
  const auto list = document.find("IV Curves");
  return list->is_array() && list->size() > 1;
}

bool TableHoldsSet(const std::string& text, const fs::path& path, const ReadOptions& options) {
  const auto tables = ReadTables(text, path.string(), options, BrokenRows::kSetAside);
  if (!tables) return HoldsKeyPoints(text, path.string());
  if (tables->size() > 1) return true;
  const Table* const table = &tables->front();
  if (table->error) return false;
  std::set<int> numbers(table->curve.sweep.begin(), table->curve.sweep.end());
  for (const auto& broken : table->broken) numbers.insert(broken.first);
  if (numbers.size() < 2) return false;
  const fs::path index = path.parent_path() / (path.stem().string() + "-index.csv");
  return table->holds_curves || IsFile(index) || SweepsDifferInConditions(table->curve);
}

}  // namespace

bool HoldsCurveSet(const std::string& path, const ReadOptions& options) {
  if (IsFolder(path)) return FolderHoldsSet(path);
  if (IsStream(path)) return false;  // reading a pipe would consume its content
  const auto text = ReadDecodedFile(path, options.largest_file_bytes);
  return text && TextHoldsCurveSet(*text, path, options);
}

bool TextHoldsCurveSet(const DecodedText& text, const std::string& path,
                       const ReadOptions& options) {
  const auto document = DocumentIn(text.text, path);
  if (!document) return false;
  if (IsMultiFlash(text.text)) return true;
  return *document ? JsonHoldsSet(**document, path, options)
                   : TableHoldsSet(RewriteTable(text).text, path, options);
}

}  // namespace lyrefit
