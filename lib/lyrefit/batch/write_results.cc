#include "lyrefit/batch/write_results.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/new_file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/campaign_results.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/neighbours.h"
#include "lyrefit/batch/row_text.h"
#include "lyrefit/batch/samples.h"
#include "lyrefit/batch/scale_judge.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kCsv[] = "results.csv";
constexpr char kLines[] = "results.jsonl";
constexpr char kSchema[] = "results.schema.json";
constexpr char kSamplesCsv[] = "samples.csv";
constexpr char kSamplesLines[] = "samples.jsonl";
constexpr char kCampaign[] = "campaign.json";
constexpr std::uintmax_t kLargestSchema = 16U << 20;

// Adjacent rows with the same parent.
struct Group {
  std::string parent;
  std::vector<ResultRow> rows;
  std::vector<Neighbour> members;
};

// Positions of the columns that the comparison of neighbours uses.
struct Places {
  explicit Places(const std::vector<ResultColumn>& columns) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string& name = columns[k].name;
      if (name == "id") id = k;
      if (name == "irradiance_Wm2") irradiance = k;
      if (name == "Isc_A") isc = k;
      if (name == "Voc_V") voc = k;
      if (name == "FF") ff = k;
      if (name == "Pmax_W") pmax = k;
    }
  }
  std::size_t id = 0, irradiance = 0, isc = 0, voc = 0, ff = 0, pmax = 0;
};

double NumberIn(const ResultRow& row, std::size_t column) {
  const double* const number = std::get_if<double>(&row.cells[column]);
  return number == nullptr ? kUnknown : *number;
}

Neighbour NeighbourOf(const ResultRow& row, const Places& at) {
  const double light = NumberIn(row, at.irradiance);
  return {light,
          {NumberIn(row, at.isc) / light, NumberIn(row, at.voc), NumberIn(row, at.ff),
           NumberIn(row, at.pmax) / light}};
}

// Calls see(group) for the groups of all rows in order. Rows without a parent, and groups with too
// many rows, are passed without members.
template <class See>
Expected<void> ForGroups(const std::vector<std::string>& parts,
                         const std::vector<ResultColumn>& columns, const See& see) {
  const Places at(columns);
  Group group;
  const auto end = [&]() -> Expected<void> {
    if (!group.rows.empty()) TRY(see(group));
    group.rows.clear();
    group.members.clear();
    return {};
  };
  bool large = false;
  for (const std::string& part : parts) {
    TRY(CheckpointReader reader, CheckpointReader::Open(part));
    while (true) {
      TRY(const auto json, reader.Next());
      if (!json) break;
      ResultRow row = RowOf(columns, *json);
      const std::string* const id = std::get_if<std::string>(&row.cells[at.id]);
      std::string parent = id == nullptr ? std::string() : ParentOf(*id);
      if (parent != group.parent || parent.empty()) {
        TRY(end());
        large = false;
        group.parent = std::move(parent);
      }
      if (group.rows.size() >= kMostNeighbours) {
        large = true;
        group.members.clear();
        TRY(end());
      }
      if (!large && !group.parent.empty()) group.members.push_back(NeighbourOf(row, at));
      group.rows.push_back(std::move(row));
    }
  }
  return end();
}

std::string SchemaJson(const CheckpointHead& head, const std::vector<ResultColumn>& columns,
                       bool samples) {
  // The keys `lyrefit` and `samples` are extensions: the standard allows additional keys.
  BatchJson schema = {{"fields", FieldsJson(columns)},
                      {"missingValues", {""}},
                      {"primaryKey", "where"},
                      {"lyrefit", ResultsHeadOf(head)}};
  if (samples) schema["samples"] = {{"fields", FieldsJson(SampleColumns())}};
  return schema.dump(2, ' ', false, BatchJson::error_handler_t::replace) + "\n";
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

// How rows are converted to results, from the head of the checkpoint file.
struct ResultsPlan {
  std::vector<ResultColumn> rows;     // columns of the checkpoint files
  std::vector<ResultColumn> results;  // the columns above and those of the comparisons
  std::optional<ScaleReader> scale;   // of rows that are compared by their scale
  double level = 0;
  double like_light = 0;
  CsvTexts texts = CsvTexts::kSafe;
};

Expected<ResultsPlan> ResultsPlanOf(const CheckpointHead& head, const std::string& path) {
  ResultsPlan plan;
  const auto columns = ReadColumns(head.value("columns", BatchJson()));
  if (!columns) return Fail(columns.error().message, path, 1);
  plan.rows = plan.results = *columns;
  for (const ResultColumn& column : NeighbourColumns()) plan.results.push_back(column);
  plan.scale = ScaleReader(plan.rows);
  if (!plan.scale->reads()) plan.scale.reset();
  if (plan.scale) {
    for (const ResultColumn& column : ScaleColumns()) plan.results.push_back(column);
  }
  const BatchJson& options = head.at("options");
  if (options.contains(kBeforeOption)) {
    for (const ResultColumn& column : CampaignColumns()) plan.results.push_back(column);
  }
  plan.level = options.value("group-level", 0.0);
  plan.like_light = options.value("like-light", 0.0);
  if (options.value("raw-csv", false)) plan.texts = CsvTexts::kRaw;
  return plan;
}

// Scatter of healthy strings, which is known after all rows.
struct PlantScatter {
  NeighbourScatter neighbours;
  ScaleScatter scale;
};

// The members of a group for the comparison by scale: all of a combiner together, other rows one by
// one.
std::vector<std::vector<ScaleMember>> ScaleGroups(const Group& group, const ScaleReader& reader) {
  std::vector<std::vector<ScaleMember>> groups;
  for (const ResultRow& row : group.rows) {
    if (groups.empty() || group.members.empty()) groups.emplace_back();
    groups.back().push_back(reader.Read(row));
  }
  return groups;
}

// Also takes the strings of this campaign if there is an earlier one.
Expected<PlantScatter> LearnScatter(const std::vector<std::string>& parts, const ResultsPlan& plan,
                                    CampaignResults* campaign, RowProgress* passed) {
  PlantScatter scatter;
  TRY(ForGroups(parts, plan.rows, [&](const Group& group) -> Expected<void> {
    if (!group.members.empty()) {
      scatter.neighbours.Add(DeviationsAmong(group.members, plan.like_light));
      if (plan.scale) {
        for (const auto& members : ScaleGroups(group, *plan.scale)) {
          scatter.scale.Add(ScaleResiduals(members));
        }
      }
    }
    for (const ResultRow& row : group.rows) {
      if (campaign != nullptr) campaign->Take(row);
    }
    return Pass(group.rows.size(), passed);
  }));
  return scatter;
}

}  // namespace

CheckpointHead ResultsHeadOf(const CheckpointHead& head) {
  CheckpointHead run = head;
  for (const char* key : {"shard", "of", "columns"}) run.erase(key);
  return run;
}

Expected<void> PrepareFolder(const std::string& folder, bool replace) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    const std::string why = error ? error.message() : "it is no folder";
    return Fail("cannot make the folder of the results: " + why, folder);
  }
  if (replace) return {};
  for (const char* name : {kCsv, kLines, kSchema, kSamplesCsv, kSamplesLines, kCampaign}) {
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

namespace {

std::string CampaignText(const CampaignSummary& summary) {
  return CampaignJson(summary).dump(2, ' ', false, BatchJson::error_handler_t::replace) + "\n";
}

Expected<void> WriteSamples(const std::vector<SampleSummary>& samples, CsvTexts texts, NewFile* csv,
                            NewFile* lines) {
  const std::vector<ResultColumn> columns = SampleColumns();
  TRY(csv->Begin());
  TRY(lines->Begin());
  TRY(csv->Write(HeadCsv(columns)));
  for (const ResultRow& row : SampleRows(samples)) {
    TRY(csv->Write(RowCsv(row, texts)));
    TRY(lines->Write(RowJson(columns, row) + "\n"));
  }
  return {};
}

// Adds the cells of the comparison by scale.
void AddScale(const ResultsPlan& plan, const ScaleScatter& scatter, Group* group) {
  std::size_t i = 0;
  for (const auto& members : ScaleGroups(*group, *plan.scale)) {
    const auto residuals = ScaleResiduals(members);
    const ScaleErrors errors = scatter.ErrorsOf(residuals);
    for (auto& cells : ScaleCells(members, residuals, errors, plan.level)) {
      Append(std::move(cells), &group->rows[i++].cells);
    }
  }
}

Expected<BatchResults> WriteAllResults(const std::vector<std::string>& parts,
                                       const std::string& folder, const RowObserver& row_observer,
                                       RowProgress* passed) {
  // Its digest covers all of the input.
  TRY(const CheckpointReader last, CheckpointReader::Open(parts.back()));
  TRY(const ResultsPlan plan, ResultsPlanOf(last.head(), parts.back()));
  TRY(const auto campaign, CampaignResults::Open(last.head(), parts, plan.rows));
  TRY(const PlantScatter scatter, LearnScatter(parts, plan, campaign.get(), passed));
  if (campaign) campaign->Compare();
  const fs::path base(folder);
  NewFile csv((base / kCsv).string());
  NewFile lines((base / kLines).string());
  NewFile schema((base / kSchema).string());
  for (NewFile* file : {&csv, &lines, &schema}) TRY(file->Begin());
  TRY(csv.Write(HeadCsv(plan.results)));
  RowCounter counter(plan.results);
  SampleCounter samples(plan.results);
  const auto write = [&](Group& group) -> Expected<void> {
    const auto deviations = DeviationsAmong(group.members, plan.like_light);
    std::array<double, kNeighbourQuantities> limits{};
    if (!deviations.empty()) limits = scatter.neighbours.Limits(deviations, plan.level);
    for (std::size_t i = 0; i < group.rows.size(); ++i) {
      const NeighbourDeviation none;
      Append(NeighbourCells(deviations.empty() ? none : deviations[i], limits),
             &group.rows[i].cells);
    }
    if (plan.scale) AddScale(plan, scatter.scale, &group);
    for (ResultRow& row : group.rows) {
      if (campaign) Append(campaign->NextCells(), &row.cells);
      TRY(csv.Write(RowCsv(row, plan.texts)));
      TRY(lines.Write(RowJson(plan.results, row) + "\n"));
      counter.Count(row);
      if (samples.counts()) samples.Count(row);
      if (row_observer) row_observer(plan.results, row);
    }
    return Pass(group.rows.size(), passed);
  };
  TRY(ForGroups(parts, plan.rows, write));
  TRY(schema.Write(SchemaJson(last.head(), plan.results, samples.counts())));
  BatchResults results;
  static_cast<BatchCounts&>(results) = counter.counts();
  results.columns = plan.results;
  if (campaign) {
    results.campaign = campaign->Summary();
    NewFile file((base / kCampaign).string());
    TRY(file.Begin());
    TRY(file.Write(CampaignText(results.campaign)));
    TRY(NewFile::Commit({&csv, &lines, &file, &schema}));
    return results;
  }
  if (!samples.counts()) {
    TRY(NewFile::Commit({&csv, &lines, &schema}));
    return results;
  }
  results.samples = samples.Summaries();
  results.working_pixel = last.head().at("options").value(kPixelCriterion, "");
  NewFile samples_csv((base / kSamplesCsv).string());
  NewFile samples_lines((base / kSamplesLines).string());
  TRY(WriteSamples(results.samples, plan.texts, &samples_csv, &samples_lines));
  TRY(NewFile::Commit({&csv, &lines, &samples_csv, &samples_lines, &schema}));
  return results;
}

}  // namespace

Expected<std::optional<BatchResults>> WriteResults(const std::vector<std::string>& parts,
                                                   const std::string& folder,
                                                   const Observer& observer,
                                                   const RowObserver& row_observer) {
  RowProgress passed{ProgressReporter(observer)};
  Expected<BatchResults> written = WriteAllResults(parts, folder, row_observer, &passed);
  if (passed.progress.stop().requested()) return std::nullopt;
  return written;
}

Expected<BatchCounts> CountRows(const std::string& part) {
  TRY(CheckpointReader reader, CheckpointReader::Open(part));
  TRY(const ResultsPlan plan, ResultsPlanOf(reader.head(), part));
  RowCounter counter(plan.rows);
  while (true) {
    TRY(const auto json, reader.Next());
    if (!json) return counter.counts();
    counter.Count(RowOf(plan.rows, *json));
  }
}

}  // namespace lyrefit
