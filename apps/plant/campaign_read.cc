#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/spreadsheet_text.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/translate/device_coefficients.h"
#include "plant/campaign_results.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestEarlierSchema = 16U << 20;
constexpr char kEarlierTask[] = "field-test";
constexpr char kCopyHead[] = "lyrefit_before";

// Texts that are read.
enum EarlierColumn { kEarlierId, kEarlierCause, kEarlierAbout, kEarlierDate, kEarlierTexts };
constexpr const char* kEarlierNames[] = {"id", "cause", "cause_about", "date"};
struct EarlierRow {
  std::array<std::string, kEarlierTexts> texts;
  std::array<double, kCampaignKept> values{}, expanded{};
};

void TakeRow(EarlierRow row, EarlierResults* results) {
  const std::string& date = row.texts[kEarlierDate];
  if (!date.empty()) {
    if (results->first_date.empty() || date < results->first_date) results->first_date = date;
    results->last_date = std::max(results->last_date, date);
  }
  CampaignString string;
  string.id = std::move(row.texts[kEarlierId]);
  string.cause = std::move(row.texts[kEarlierCause]);
  string.repeat = IsOfSweep(row.texts[kEarlierAbout]);
  for (int q = 0; q < kCampaignKept; ++q) {
    string.values[q] = static_cast<float>(row.values[q]);
    string.expanded[q] = static_cast<float>(row.expanded[q]);
  }
  results->strings.push_back(std::move(string));
}

tl::unexpected<Error> NoColumn(const char* name, const std::string& path, int line) {
  return Fail(
      fmt::format("expected results of batch --task {}, found no column {}", kEarlierTask, name),
      path, line);
}

Expected<double> NumberOf(const nlohmann::json& json, const char* name) {
  if (json.is_null()) return kUnknown;
  if (json.is_number()) return json.get<double>();
  return Fail(fmt::format("{}: expected a number, found {}", name, json.dump()));
}

Expected<EarlierRow> JsonEarlierRow(const nlohmann::json& json, const std::string& path, int line) {
  EarlierRow row;
  for (int k = 0; k < kEarlierTexts; ++k) {
    const auto found = json.find(kEarlierNames[k]);
    if (k == kEarlierId && found == json.end()) return NoColumn("id", path, line);
    if (found != json.end() && found->is_string()) row.texts[k] = found->get<std::string>();
  }
  const auto take = [&](const char* name, double* value) -> Expected<void> {
    const auto found = json.find(name);
    if (found == json.end()) return NoColumn(name, path, line);
    const Expected<double> number = NumberOf(*found, name);
    if (!number) return Fail(number.error().message, path, line);
    *value = *number;
    return {};
  };
  for (int q = 0; q < kCampaignKept; ++q) {
    TRY(take(kFigureColumns[q], &row.values[q]));
    TRY(take(kExpandedColumns[q], &row.expanded[q]));
  }
  return row;
}

Expected<void> ReadJsonRows(const std::string& path, std::istream* file, int line,
                            EarlierResults* results) {
  for (std::string text; std::getline(*file, text);) {
    ++line;
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return Fail("expected a JSON object, a row of results", path, line);
    TRY(EarlierRow row, JsonEarlierRow(json, path, line));
    TakeRow(std::move(row), results);
  }
  return {};
}

// Positions of the columns in the head of a CSV file.
struct CsvPlaces {
  std::array<std::optional<std::size_t>, kEarlierTexts> texts;
  std::array<std::size_t, kCampaignKept> values{}, expanded{};
  std::size_t count = 0;
};

Expected<CsvPlaces> CsvPlacesOf(const LineSplitter& head, const std::string& path) {
  CsvPlaces places;
  places.count = head.size();
  const auto find = [&](const char* name) -> std::optional<std::size_t> {
    for (std::size_t k = 0; k < head.size(); ++k) {
      if (head[k] == name) return k;
    }
    return std::nullopt;
  };
  for (int k = 0; k < kEarlierTexts; ++k) places.texts[k] = find(kEarlierNames[k]);
  if (!places.texts[kEarlierId]) return NoColumn("id", path, 1);
  for (int q = 0; q < kCampaignKept; ++q) {
    for (const auto& [name, place] : {std::pair{kFigureColumns[q], &places.values[q]},
                                      std::pair{kExpandedColumns[q], &places.expanded[q]}}) {
      const auto found = find(name);
      if (!found) return NoColumn(name, path, 1);
      *place = *found;
    }
  }
  return places;
}

Expected<void> ReadCsvRows(const std::string& path, std::istream* file, EarlierResults* results) {
  LineSplitter splitter(',');
  std::string text;
  if (!std::getline(*file, text) || !splitter.Split(text)) {
    return Fail("expected the head of results.csv", path, 1);
  }
  TRY(const CsvPlaces places, CsvPlacesOf(splitter, path));
  for (int line = 2; std::getline(*file, text); ++line) {
    if (!splitter.Split(text)) return Fail("expected closed quotes in one line", path, line, 1);
    if (splitter.size() != places.count) {
      return Fail(
          fmt::format("expected {} fields as in the head, found {}", places.count, splitter.size()),
          path, line, 1);
    }
    EarlierRow row;
    for (int k = 0; k < kEarlierTexts; ++k) {
      if (places.texts[k]) {
        row.texts[k] = WithoutApostrophe(std::string(splitter[*places.texts[k]]));
      }
    }
    const auto number = [&](std::size_t place, double* value) -> Expected<void> {
      const std::string_view field = splitter[place];
      *value = kUnknown;
      if (field.empty()) return {};
      const char* const end = field.data() + field.size();
      const auto read = std::from_chars(field.data(), end, *value);
      if (read.ec == std::errc() && read.ptr == end) return {};
      return Fail(fmt::format("expected a number, found '{}'", field), path, line,
                  FieldColumn(text, ',', place));
    };
    for (int q = 0; q < kCampaignKept; ++q) {
      TRY(number(places.values[q], &row.values[q]));
      TRY(number(places.expanded[q], &row.expanded[q]));
    }
    TakeRow(std::move(row), results);
  }
  return {};
}

Expected<void> ReadEarlierSchema(const std::string& path, EarlierResults* results) {
  results->version = "unknown";
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  TRY(const std::string text, ReadTextFile(path, kLargestEarlierSchema));
  const BatchJson schema = BatchJson::parse(text, nullptr, false);
  const bool run =
      schema.is_object() && schema.contains("lyrefit") && schema["lyrefit"].is_object();
  if (!run) return Fail("expected the schema of results", path);
  const std::string task = schema["lyrefit"].value("task", "");
  if (task != kEarlierTask) {
    return Fail(fmt::format("expected results of batch --task {}, found those of --task {}",
                            kEarlierTask, task),
                path);
  }
  results->version = schema["lyrefit"].value("version", "unknown");
  results->options = schema["lyrefit"].value("options", BatchJson::object());
  results->options_place = path;
  return {};
}

// The file of rows in a folder.
Expected<fs::path> FileOfRows(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return fs::path(path);
  for (const char* name : {"results.jsonl", "results.csv"}) {
    if (fs::exists(fs::path(path) / name, error)) return fs::path(path) / name;
  }
  if (fs::exists(fs::path(path) / "results.part", error)) {
    return Fail("the earlier run has not finished: do it again with --resume", path);
  }
  return Fail("expected the results of an earlier run in this folder, results.jsonl or results.csv",
              path);
}

}  // namespace

bool IsOfSweep(const std::string& about) { return about == "sweep" || about == "conditions"; }

Expected<EarlierResults> ReadEarlierResults(const std::string& path) {
  TRY(const fs::path rows, FileOfRows(path));
  EarlierResults results;
  TRY(ReadEarlierSchema((rows.parent_path() / "results.schema.json").string(), &results));
  std::ifstream file(rows);
  if (!file) return Fail("cannot open the earlier results", rows.string());
  const bool csv = rows.extension() == ".csv";
  TRY(csv ? ReadCsvRows(rows.string(), &file, &results)
          : ReadJsonRows(rows.string(), &file, 0, &results));
  if (results.strings.empty()) return Fail("the earlier results have no rows", rows.string());
  return results;
}

Expected<void> CheckSameCoefficients(const EarlierResults& earlier, const BatchJson& options) {
  if (earlier.options_place.empty()) return {};
  const auto spoken = [](const std::string& text) { return text.empty() ? "none" : text; };
  for (const OptionRow<StatedCoefficients>& row : kCoefficientTable) {
    if (row.IsHeading()) continue;
    const std::string then = earlier.options.value(row.name, std::string());
    const std::string now = options.value(row.name, std::string());
    if (then == now) continue;
    return Fail(fmt::format("the earlier figures were made with {} {}, these are with {}: their "
                            "difference would look like a change. Do one of the runs again",
                            row.name, spoken(then), spoken(now)),
                earlier.options_place);
  }
  return {};
}

std::string EarlierText(const EarlierResults& earlier) {
  const BatchJson head = {{kCopyHead, 1},
                          {"version", earlier.version},
                          {"rows", earlier.strings.size()},
                          {"first_date", earlier.first_date},
                          {"last_date", earlier.last_date}};
  const auto replace = BatchJson::error_handler_t::replace;
  std::string text = head.dump(-1, ' ', false, replace) + "\n";
  const auto number = [](float value) {
    return std::isfinite(value) ? fmt::format("{}", double{value}) : std::string("null");
  };
  for (const CampaignString& string : earlier.strings) {
    text += fmt::format("{{\"id\":{},\"cause\":{},\"cause_about\":\"{}\"",
                        BatchJson(string.id).dump(-1, ' ', false, replace),
                        BatchJson(string.cause).dump(-1, ' ', false, replace),
                        string.repeat ? "sweep" : "");
    for (int q = 0; q < kCampaignKept; ++q) {
      text += fmt::format(",\"{}\":{},\"{}\":{}", kFigureColumns[q], number(string.values[q]),
                          kExpandedColumns[q], number(string.expanded[q]));
    }
    text += "}\n";
  }
  return text;
}

Expected<EarlierResults> ReadEarlierCopy(const std::string& path, const std::string& digest) {
  TRY(const std::string text, ReadFileBytes(path, fs::file_size(path)));
  if (TextDigest(text) != digest) {
    return Fail("this copy of the earlier results is not that of the run, or was changed", path);
  }
  std::istringstream lines(text);
  std::string first;
  std::getline(lines, first);
  const BatchJson head = BatchJson::parse(first, nullptr, false);
  if (!head.is_object() || !head.contains(kCopyHead)) {
    return Fail("expected a copy of earlier results", path, 1);
  }
  EarlierResults results;
  results.version = head.value("version", "unknown");
  TRY(ReadJsonRows(path, &lines, 1, &results));
  results.first_date = head.value("first_date", "");
  results.last_date = head.value("last_date", "");
  return results;
}

}  // namespace lyrefit
