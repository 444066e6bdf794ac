#include "plant/plant_page.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lyrefit/base/file.h"
#include "lyrefit/base/new_file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/row_text.h"
#include "lyrefit/batch/write_results.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/page_shell.h"
#include "plant/campaign_results.h"
#include "plant/plant_document.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestResultsSchema = 16U << 20;

std::string Text(const BatchJson& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// Facts about the run, from the schema.
std::vector<block::Field> FactsOf(const BatchJson& run) {
  std::vector<block::Field> facts;
  const BatchJson options = run.value("options", BatchJson::object());
  const auto take = [&](const char* name, const BatchJson& from, const char* key) {
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

// What changed since earlier results, if the run had any.
Expected<CampaignSummary> CampaignIn(const fs::path& folder, const BatchJson& run) {
  const BatchJson options = run.value("options", BatchJson::object());
  if (!options.contains(kBeforeOption)) return CampaignSummary();
  const std::string path = (folder / "campaign.json").string();
  TRY(const std::string text, ReadTextFile(path, kLargestResultsSchema));
  const BatchJson json = BatchJson::parse(text, nullptr, false);
  if (!json.is_object()) return Fail("expected the comparison of two campaigns", path);
  return WithoutTypeErrors(path, [&]() -> Expected<CampaignSummary> { return CampaignOf(json); });
}

// Summary of results.jsonl, read line by line.
Expected<PlantSummary> SummaryOf(const std::string& path,
                                 const std::vector<ResultColumn>& columns) {
  std::ifstream file(path);
  if (!file) return Fail("cannot open the results", path);
  PlantCounter counter(columns);
  int line = 0;
  for (std::string text; std::getline(file, text);) {
    ++line;
    const auto row = nlohmann::json::parse(text, nullptr, false);
    if (!row.is_object()) return Fail("expected a JSON object, a row of results", path, line);
    counter.Add(RowOf(columns, row));
  }
  return counter.Summary();
}

// Writes a file into the page, compressed part by part.
Expected<void> WritePacked(const std::string& path, NewFile* page) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Fail("cannot open the results", path);
  PackedText packed;
  std::string part(1 << 20, '\0');
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0) {
    const auto size = static_cast<std::size_t>(file.gcount());
    TRY(page->Write(packed.Add(std::string_view(part).substr(0, size))));
  }
  return page->Write(packed.End());
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

Expected<std::int64_t> WritePlantPage(const std::string& folder, const std::string& file,
                                      const std::string& plant) {
  const std::string schema_file = (fs::path(folder) / "results.schema.json").string();
  TRY(const std::string text, ReadTextFile(schema_file, kLargestResultsSchema));
  const BatchJson schema = BatchJson::parse(text, nullptr, false);
  if (!schema.is_object()) return Fail("expected the schema of results", schema_file);
  PlantContent content;
  TRY(content.columns, ReadColumns(schema.value("fields", BatchJson())));
  content.plant = plant;
  const BatchJson run = schema.value("lyrefit", BatchJson::object());
  TRY(content.facts, WithoutTypeErrors(schema_file, [&]() -> Expected<std::vector<block::Field>> {
        return FactsOf(run);
      }));
  TRY(content.campaign, CampaignIn(folder, run));
  content.results = UrlFrom(file, folder);
  TRY(content.summary, SummaryOf((fs::path(folder) / "results.jsonl").string(), content.columns));
  NewFile page(file);
  TRY(page.Begin());
  const std::string html = DrawPage(PlantDocument(content), "");
  const std::size_t rows = html.find(kRowsElement);
  const std::size_t here = rows == std::string::npos ? 0 : rows + std::strlen(kRowsElement);
  TRY(page.Write(std::string_view(html).substr(0, here)));
  if (here > 0) TRY(WritePacked((fs::path(folder) / "results.csv").string(), &page));
  TRY(page.Write(std::string_view(html).substr(here)));
  TRY(page.Commit());
  return content.summary.rows;
}

}  // namespace lyrefit
