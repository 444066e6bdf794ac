#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/stream/json_elements.h"
#include "plant/planned_module.h"
#include "plant/string_plan.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestPlan = 64U << 20;
constexpr int kMostInSeries = 100000;

enum PlanColumn { kPlanId, kPlanModules, kPlanStrings, kPlanDiodes, kPlanModule, kPlanRemark };
constexpr const char* kPlanColumns[] = {
    "id", "modules_in_series", "strings_in_parallel", "bypass_diodes", "module", "remark"};

// Where a value stands.
struct PlanPlace {
  const std::string& file;
  int line;
  int column;
};

// Reads each module once.
class ModuleShelf {
 public:
  explicit ModuleShelf(const std::string& plan) : folder_(fs::path(plan).parent_path()) {}

  Expected<std::shared_ptr<const PlannedModule>> Take(const std::string& name,
                                                      const PlanPlace& place) {
    const std::string path = (folder_ / name).string();
    auto& module = modules_[path];
    if (module) return module;
    auto read = ReadPlannedModule(path);
    if (!read) {
      return Fail("the module " + Quoted(name) + ": " + read.error().ToString(), place.file,
                  place.line, place.column);
    }
    module = *read;
    return module;
  }

 private:
  const fs::path folder_;
  std::map<std::string, std::shared_ptr<const PlannedModule>> modules_;
};

// A line of the plan before its module is read.
struct PlanLine {
  PlannedString planned;
  std::string module;
  bool diodes_stated = false;
};

// Adds a line. `id` and `module`: where these stand.
Expected<void> AddLine(PlanLine line, const PlanPlace& id, const PlanPlace& module,
                       ModuleShelf* shelf, std::map<std::string, int>* ids,
                       std::vector<PlannedString>* lines) {
  const auto [before, is_new] = ids->emplace(line.planned.id, id.line);
  if (!is_new) {
    return Fail(fmt::format("expected each id once, found {} as in line {}",
                            Quoted(line.planned.id), before->second),
                id.file, id.line, id.column);
  }
  if (!line.module.empty()) {
    TRY(line.planned.module, shelf->Take(line.module, module));
    if (!line.diodes_stated) line.planned.bypass_diodes = line.planned.module->bypass_diodes;
  }
  lines->push_back(std::move(line.planned));
  return {};
}

Expected<int> CountIn(std::string_view text, const char* name, const PlanPlace& place) {
  const auto number = ParseNumber(text);
  const bool whole = number && *number == std::floor(*number);
  if (whole && *number >= 1 && *number <= kMostInSeries) return static_cast<int>(*number);
  return Fail(fmt::format("expected a whole number from 1 to {} in column {}, found {}",
                          kMostInSeries, name, Quoted(text)),
              place.file, place.line, place.column);
}

// The columns of a CSV plan: for each field of a line its PlanColumn.
struct PlanHeader {
  char delimiter = ',';
  std::vector<PlanColumn> columns;
};

std::string KnownColumns() {
  std::string text;
  for (const char* const name : kPlanColumns)
    text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

Expected<PlanHeader> ReadPlanHeader(std::string_view line, const PlanPlace& place) {
  PlanHeader header;
  for (const char delimiter : {'\t', ';'}) {
    if (line.find(delimiter) != std::string_view::npos) header.delimiter = delimiter;
  }
  LineSplitter splitter(header.delimiter);
  if (!splitter.Split(line)) {
    return Fail("expected closed quotes in one line", place.file, place.line, 1);
  }
  std::set<int> seen;
  for (std::size_t i = 0; i < splitter.size(); ++i) {
    const std::string name = LowerCase(TrimBlanks(splitter[i]));
    const auto* const known = std::find(std::begin(kPlanColumns), std::end(kPlanColumns), name);
    const int at = FieldColumn(line, header.delimiter, i);
    if (known == std::end(kPlanColumns)) {
      return Fail("expected the columns of a plan (" + KnownColumns() + "), found " + Quoted(name),
                  place.file, place.line, at);
    }
    header.columns.push_back(static_cast<PlanColumn>(known - std::begin(kPlanColumns)));
    if (!seen.insert(header.columns.back()).second) {
      return Fail("expected each column once, found " + Quoted(name) + " again", place.file,
                  place.line, at);
    }
  }
  for (const PlanColumn needed : {kPlanId, kPlanModules}) {
    if (seen.count(needed) > 0) continue;
    return Fail(std::string("expected a column ") + kPlanColumns[needed] + " in a plan", place.file,
                place.line, 1);
  }
  return header;
}

Expected<void> ReadPlanRow(std::string_view text, const PlanHeader& header, int number,
                           const std::string& file, ModuleShelf* shelf,
                           std::map<std::string, int>* ids, std::vector<PlannedString>* lines) {
  LineSplitter splitter(header.delimiter);
  if (!splitter.Split(text)) return Fail("expected closed quotes in one line", file, number, 1);
  if (splitter.size() != header.columns.size()) {
    return Fail(fmt::format("expected {} fields as in the header, found {}", header.columns.size(),
                            splitter.size()),
                file, number, 1);
  }
  PlanLine line;
  PlanPlace id{file, number, 1}, module{file, number, 1};
  for (std::size_t i = 0; i < splitter.size(); ++i) {
    const std::string_view field = TrimBlanks(splitter[i]);
    const PlanPlace here{file, number, FieldColumn(text, header.delimiter, i)};
    const PlanColumn column = header.columns[i];
    const char* const name = kPlanColumns[column];
    if (column == kPlanId) {
      if (field.empty()) return Fail("expected an id, found nothing", file, number, here.column);
      line.planned.id = std::string(field);
      id.column = here.column;
    } else if (column == kPlanModules) {
      TRY(line.planned.modules_in_series, CountIn(field, name, here));
    } else if (column == kPlanStrings && !field.empty()) {
      TRY(line.planned.strings_in_parallel, CountIn(field, name, here));
    } else if (column == kPlanDiodes && !field.empty()) {
      TRY(line.planned.bypass_diodes, CountIn(field, name, here));
      line.diodes_stated = true;
    } else if (column == kPlanModule) {
      line.module = std::string(field);
      module.column = here.column;
    }
  }
  return AddLine(std::move(line), id, module, shelf, ids, lines);
}

Expected<std::vector<PlannedString>> ReadCsvPlan(const std::string& text, const std::string& file) {
  LineReader reader(text);
  std::string_view line;
  if (!reader.NextContent(&line)) return Fail("expected a plan, found no line", file, 1, 1);
  TRY(const PlanHeader header, ReadPlanHeader(line, {file, reader.number(), 1}));
  ModuleShelf shelf(file);
  std::map<std::string, int> ids;
  std::vector<PlannedString> lines;
  while (reader.NextContent(&line)) {
    TRY(ReadPlanRow(line, header, reader.number(), file, &shelf, &ids, &lines));
  }
  return lines;
}

Expected<int> CountAt(const JsonFields& fields, const char* key, int usual) {
  TRY(const auto number, fields.WholeNumber({key}));
  if (!number) return usual;
  if (*number >= 1 && *number <= kMostInSeries) return *number;
  return fields.Refuse(key, fmt::format("a whole number from 1 to {}", kMostInSeries));
}

Expected<PlanLine> ReadPlanObject(const std::string& text, const std::string& file) {
  TRY(const nlohmann::json json, ParseJson(text, file));
  if (!json.is_object()) return Fail("expected an object, a line of a plan", file, 1, 1);
  const JsonFields fields(json, text, file);
  for (const auto& [key, value] : json.items()) {
    const bool known =
        std::find(std::begin(kPlanColumns), std::end(kPlanColumns), key) != std::end(kPlanColumns);
    if (!known) return fields.Refuse(key, "no value but those of a plan (" + KnownColumns() + ")");
  }
  PlanLine line;
  TRY(const auto id, fields.Text("id"));
  if (!id || id->empty()) return Fail("expected an id in a line of a plan", file, 1, 1);
  line.planned.id = *id;
  TRY(line.planned.modules_in_series, CountAt(fields, "modules_in_series", 0));
  if (line.planned.modules_in_series == 0) {
    return Fail("expected the key \"modules_in_series\" in a line of a plan", file, 1, 1);
  }
  TRY(line.planned.strings_in_parallel, CountAt(fields, "strings_in_parallel", 1));
  TRY(line.planned.bypass_diodes, CountAt(fields, "bypass_diodes", 3));
  line.diodes_stated = json.contains("bypass_diodes");
  TRY(const auto module, fields.Text("module"));
  line.module = module.value_or("");
  return line;
}

Expected<std::vector<PlannedString>> ReadJsonPlan(const std::string& text,
                                                  const std::string& file) {
  TRY(const nlohmann::json document, ParseJson(text, file));
  const bool nested = document.is_object();
  if (nested && !document.contains("strings")) {
    return Fail("expected a list of strings, or an object that has it under \"strings\"", file, 1,
                1);
  }
  JsonElements elements(file, nested ? std::optional<std::string>("strings") : std::nullopt,
                        kLargestPlan);
  ModuleShelf shelf(file);
  std::map<std::string, int> ids;
  std::vector<PlannedString> lines;
  while (true) {
    TRY(const auto element, elements.Next());
    if (!element) return lines;
    const int first = static_cast<int>(element->line);
    auto line = ReadPlanObject(element->text, file);
    if (!line) {
      Error error = line.error();
      error.line += first - 1;
      return tl::unexpected(error);
    }
    const PlanPlace place{file, first, 1};
    TRY(AddLine(*std::move(line), place, place, &shelf, &ids, &lines));
  }
}

}  // namespace

Expected<std::shared_ptr<const PlantPlan>> ReadPlantPlan(const std::string& file) {
  TRY(const std::string text, ReadTextFile(file, kLargestPlan));
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool json = first != std::string::npos && (text[first] == '[' || text[first] == '{');
  TRY(auto lines, json ? ReadJsonPlan(text, file) : ReadCsvPlan(text, file));
  if (lines.empty()) return Fail("expected a line of a plan, found none", file);
  return std::make_shared<const PlantPlan>(std::move(lines));
}

}  // namespace lyrefit
