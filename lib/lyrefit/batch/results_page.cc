#include <fmt/format.h>
#include <filesystem>
#include <fstream>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/plant_page.h"
#include "lyrefit/batch/row_text.h"
#include "lyrefit/batch/write_results.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kManyRows = 50000;  // above this number of rows, numbers have six digits
constexpr int kDigitsOfMany = 6;
constexpr std::uintmax_t kLargestResultsSchema = 16U << 20;

std::string Text(const CheckpointHead& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// Facts about the run, from the schema.
std::vector<PlantFact> FactsOf(const CheckpointHead& run) {
  std::vector<PlantFact> facts;
  const CheckpointHead options = run.value("options", CheckpointHead::object());
  const auto take = [&](const char* name, const CheckpointHead& from, const char* key) {
    if (from.contains(key)) facts.push_back({name, Text(from[key])});
  };
  take("Instrument", options, "tracer");
  take("Serial number", options, "serial");
  take("Calibration", options, "calibration");
  take("Measured by", options, "operator");
  take("Irradiance from", options, "irradiance-from");
  take("Temperature from", options, "temperature-from");
  take("Remark", options, "remark");
  take("Task", run, "task");
  std::string others;
  for (const auto& [key, value] : options.items()) {
    bool known = key == "seed" || key == "group-level" || key == "like-light";
    for (const char* fact : {"tracer", "serial", "calibration", "operator", "irradiance-from",
                             "temperature-from", "remark"}) {
      known = known || key == fact;
    }
    if (!known) others += fmt::format("{}{} = {}", others.empty() ? "" : ", ", key, Text(value));
  }
  if (!others.empty()) facts.push_back({"Options", others});
  take("Seed", options, "seed");
  take("lyrefit", run, "version");
  take("Digest of the input", run, "input");
  return facts;
}

// Escapes the bytes that have a meaning in a URL.
std::string UrlOf(const std::string& path) {
  std::string url;
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.' || c == '~' || c == '/';
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

std::int64_t LinesOf(const std::string& path) {
  std::ifstream file(path);
  std::int64_t lines = 0;
  for (std::string line; std::getline(file, line);) ++lines;
  return lines;
}

}  // namespace

std::string UrlFrom(const std::string& file, const std::string& folder) {
  std::error_code error;
  const fs::path from = fs::weakly_canonical(fs::absolute(file, error), error).parent_path();
  const fs::path to = fs::weakly_canonical(fs::absolute(folder, error), error);
  const fs::path way = to.lexically_relative(from);
  if (way.empty() || way == ".") return "";
  const std::string url = UrlOf(way.generic_string());
  return url.back() == '/' ? url : url + "/";
}

Expected<std::int64_t> WritePlantPageOf(const std::string& folder, const std::string& file,
                                        const std::string& plant) {
  const std::string schema_file = (fs::path(folder) / "results.schema.json").string();
  TRY(const std::string text, ReadTextFile(schema_file, kLargestResultsSchema));
  const CheckpointHead schema = CheckpointHead::parse(text, nullptr, false);
  if (!schema.is_object()) return Fail("expected the schema of results", schema_file);
  TRY(const std::vector<ResultColumn> columns,
      ReadColumns(schema.value("fields", CheckpointHead())));
  const std::string results = (fs::path(folder) / "results.jsonl").string();
  PlantPageOptions options;
  options.plant = plant;
  options.facts = FactsOf(schema.value("lyrefit", CheckpointHead::object()));
  if (LinesOf(results) > kManyRows) options.digits = kDigitsOfMany;
  options.results = UrlFrom(file, folder);
  return WritePlantPage(results, file, options, columns);
}

}  // namespace lyrefit
