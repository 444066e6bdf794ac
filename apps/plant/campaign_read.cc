#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"
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

tl::unexpected<Error> NoColumn(const char* name, const std::string& path, int line) {
  return Fail(
      fmt::format("expected results of batch --task {}, found no column {}", kEarlierTask, name),
      path, line);
}

// Takes a row of results: an object with the columns that are needed.
Expected<void> TakeRow(const nlohmann::json& row, const std::string& path, int line,
                       EarlierResults* results) {
  if (!row.is_object()) return Fail("expected a JSON object, a row of results", path, line);
  if (!row.contains("id")) return NoColumn("id", path, line);
  const auto text = [&](const char* name) {
    const auto found = row.find(name);
    return found != row.end() && found->is_string() ? found->get<std::string>() : "";
  };
  CampaignString string;
  string.id = text("id");
  string.cause = text("cause");
  string.repeat = IsOfSweep(text("cause_about"));
  for (int q = 0; q < kCampaignKept; ++q) {
    for (const auto& [name, value] : {std::pair{kFigureColumns[q], &string.values[q]},
                                      std::pair{kExpandedColumns[q], &string.expanded[q]}}) {
      const auto found = row.find(name);
      if (found == row.end()) return NoColumn(name, path, line);
      if (!found->is_number() && !found->is_null()) {
        return Fail(fmt::format("{}: expected a number, found {}", name, found->dump()), path,
                    line);
      }
      *value = static_cast<float>(found->is_null() ? kUnknown : found->get<double>());
    }
  }
  // What older results may lack.
  const auto number = [&](const char* name) {
    const auto found = row.find(name);
    return static_cast<float>(found != row.end() && found->is_number() ? found->get<double>()
                                                                       : kUnknown);
  };
  for (int q = 0; q < kCampaignKept; ++q) string.measured[q] = number(kMeasuredColumns[q]);
  string.procedure = text("procedure");
  string.sparkline = text("sparkline");
  string.irradiance_W_m2 = number("irradiance_Wm2");
  string.temperature_C = number("temperature_C");
  const std::string date = text("date");
  if (!date.empty()) {
    if (results->first_date.empty() || date < results->first_date) results->first_date = date;
    results->last_date = std::max(results->last_date, date);
  }
  results->strings.push_back(std::move(string));
  return {};
}

Expected<void> ReadJsonRows(const std::string& path, std::istream* file, int line,
                            EarlierResults* results) {
  for (std::string text; std::getline(*file, text);) {
    TRY(TakeRow(nlohmann::json::parse(text, nullptr, false), path, ++line, results));
  }
  return {};
}

Expected<void> ReadCsvRows(const std::string& path, std::istream* file, EarlierResults* results) {
  LineSplitter splitter(',');
  std::string text;
  if (!std::getline(*file, text) || !splitter.Split(text)) {
    return Fail("expected the head of results.csv", path, 1);
  }
  std::map<std::string, std::size_t> places;
  const std::size_t count = splitter.size();
  for (std::size_t k = 0; k < count; ++k) places.emplace(splitter[k], k);
  std::vector<const char*> figures;
  for (int q = 0; q < kCampaignKept; ++q) {
    figures.insert(figures.end(), {kFigureColumns[q], kExpandedColumns[q]});
  }
  std::vector<const char*> more = {"irradiance_Wm2", "temperature_C"};
  more.insert(more.end(), std::begin(kMeasuredColumns), std::end(kMeasuredColumns));
  if (places.count("id") == 0) return NoColumn("id", path, 1);
  for (const char* name : figures) {
    if (places.count(name) == 0) return NoColumn(name, path, 1);
  }
  for (const char* name : more) {
    if (places.count(name) > 0) figures.push_back(name);
  }
  for (int line = 2; std::getline(*file, text); ++line) {
    if (!splitter.Split(text)) return Fail("expected closed quotes in one line", path, line, 1);
    if (splitter.size() != count) {
      return Fail(
          fmt::format("expected {} fields as in the head, found {}", count, splitter.size()), path,
          line, 1);
    }
    nlohmann::json row;
    for (const char* name : {"id", "cause", "cause_about", "date", "procedure", "sparkline"}) {
      const auto found = places.find(name);
      if (found == places.end()) continue;
      row[name] = WithoutApostrophe(std::string(splitter[found->second]));
    }
    for (const char* name : figures) {
      const std::string_view field = splitter[places.at(name)];
      row[name] = nullptr;
      if (field.empty()) continue;
      double value = kUnknown;
      const char* const end = field.data() + field.size();
      const auto read = std::from_chars(field.data(), end, value);
      if (read.ec != std::errc() || read.ptr != end) {
        return Fail(fmt::format("expected a number, found '{}'", field), path, line,
                    FieldColumn(text, ',', places.at(name)));
      }
      row[name] = value;
    }
    TRY(TakeRow(row, path, line, results));
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
  return WithoutTypeErrors(path, [&]() -> Expected<void> {
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
  });
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
  if (IsStream(rows.string())) {  // opening a pipe would wait for its writer
    return Fail("expected the results of an earlier run, found a pipe or a device", rows.string());
  }
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
  return WithoutTypeErrors(earlier.options_place, [&]() -> Expected<void> {
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
  });
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
    const auto quoted = [&](const std::string& of) {
      return BatchJson(of).dump(-1, ' ', false, replace);
    };
    text += fmt::format(
        "{{\"id\":{},\"cause\":{},\"cause_about\":\"{}\",\"procedure\":{},\"sparkline\":{}",
        quoted(string.id), quoted(string.cause), string.repeat ? "sweep" : "",
        quoted(string.procedure), quoted(string.sparkline));
    text += fmt::format(",\"irradiance_Wm2\":{},\"temperature_C\":{}",
                        number(string.irradiance_W_m2), number(string.temperature_C));
    for (int q = 0; q < kCampaignKept; ++q) {
      text += fmt::format(",\"{}\":{},\"{}\":{},\"{}\":{}", kFigureColumns[q],
                          number(string.values[q]), kExpandedColumns[q], number(string.expanded[q]),
                          kMeasuredColumns[q], number(string.measured[q]));
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
