#include "plant/campaign_results.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "plant/campaign_document.h"

namespace lyrefit {
namespace {

constexpr char kLevelOption[] = "change-level";
constexpr char kBypassDiodesColumn[] = "bypass_diodes";
constexpr char kCampaignFile[] = "campaign.json";
constexpr std::size_t kMostChangesInText = 25;

ResultCell BypassDiodes(const BatchCurve& curve) {
  if (!curve.curve || !curve.curve->notes.bypass_diodes) return {};
  return std::int64_t{*curve.curve->notes.bypass_diodes};
}

std::vector<std::string> RemarksOn(const EarlierResults& earlier) {
  if (earlier.version == Version()) return {};
  return {fmt::format(
      "The earlier results are by lyrefit {}, these by {}. What both differ in is common to all "
      "strings; to be rid of it, do the earlier run again.",
      earlier.version, Version())};
}

}  // namespace

void CampaignAddition::AddToTask(BatchTaskType* task) const {
  if (options_.before.empty()) return;
  const std::size_t own = task->columns.size();
  task->columns.push_back({kBypassDiodesColumn, "", CellType::kWhole,
                           "bypass diodes of the string, as stated beside the curve"});
  task->run = [run = task->run, own](const BatchCurve& curve, std::uint64_t seed,
                                     const Observer& observer) {
    TaskResult result = run(curve, seed, observer);
    result.cells.resize(own);
    result.cells.push_back(BypassDiodes(curve));
    return result;
  };
}

Expected<std::vector<ResultFile>> CampaignAddition::Begin(const BatchTaskType& task,
                                                          const std::string& folder,
                                                          BatchJson* options) const {
  if (options_.before.empty()) return std::vector<ResultFile>();
  if (ColumnPlace(task.columns, kFigureColumns[0]) == kNoColumn) {
    return Fail(
        "earlier results are compared at standard conditions: --before is for --task "
        "field-test");
  }
  std::error_code error;
  if (std::filesystem::equivalent(options_.before, folder, error)) {
    return Fail("these are the earlier results: name another folder for those of this run", folder);
  }
  TRY(const EarlierResults earlier, ReadEarlierResults(options_.before));
  TRY(CheckSameCoefficients(earlier, *options));
  const std::string text = EarlierText(earlier);
  (*options)[kBeforeOption] = TextDigest(text);
  (*options)[kLevelOption] = options_.change_level;
  return std::vector<ResultFile>{{kEarlierCopy, text}};
}

std::vector<std::string> CampaignAddition::FileNames() const { return {kCampaignFile}; }

Expected<void> CampaignAddition::Open(const RowsInput& input) {
  state_.reset();
  const BatchJson& options = input.head.at("options");
  const std::string digest = options.value(kBeforeOption, "");
  if (digest.empty()) return {};
  for (const std::string& part : input.parts) {
    const auto path = std::filesystem::path(part).parent_path() / kEarlierCopy;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) continue;
    TRY(EarlierResults earlier, ReadEarlierCopy(path.string(), digest));
    state_ = {std::move(earlier), options.value(kLevelOption, 0.0), RowReader(input.columns)};
    return {};
  }
  return Fail("the copy of the earlier results, before.part, is in no folder of these rows",
              input.parts.front());
}

std::vector<ResultColumn> CampaignAddition::Columns() const {
  return state_ ? CampaignColumns() : std::vector<ResultColumn>();
}

void CampaignAddition::Learn(const RowGroup& group) {
  if (!state_) return;
  const RowReader& reader = state_->reader;
  for (const ResultRow& row : group.rows) {
    CampaignString string;
    string.id = reader.Text(row, "id");
    string.cause = reader.Text(row, "cause");
    string.repeat = IsOfSweep(reader.Text(row, "cause_about"));
    const double diodes = reader.Number(row, kBypassDiodesColumn);
    string.bypass_diodes = std::isfinite(diodes) ? static_cast<std::int32_t>(diodes) : 0;
    for (int q = 0; q < kCampaignKept; ++q) {
      string.values[q] = static_cast<float>(reader.Number(row, kFigureColumns[q]));
      string.expanded[q] = static_cast<float>(reader.Number(row, kExpandedColumns[q]));
      string.measured[q] = static_cast<float>(reader.Number(row, kMeasuredColumns[q]));
    }
    string.procedure = reader.Text(row, "procedure");
    string.sparkline = reader.Text(row, "sparkline");
    string.irradiance_W_m2 = static_cast<float>(reader.Number(row, "irradiance_Wm2"));
    string.temperature_C = static_cast<float>(reader.Number(row, "temperature_C"));
    state_->later.push_back(std::move(string));
  }
}

void CampaignAddition::EndLearning() {
  if (!state_) return;
  CarryInOneWay(&state_->earlier.strings);
  CarryInOneWay(&state_->later);
  state_->campaign = CompareCampaigns(state_->earlier.strings, state_->later, state_->level);
}

Expected<void> CampaignAddition::Add(RowGroup* group) {
  if (!state_) return {};
  for (ResultRow& row : group->rows) {
    Append(CampaignCells(state_->campaign, state_->earlier.strings, state_->later, state_->next++),
           &row.cells);
  }
  return {};
}

CampaignSummary CampaignAddition::Summary() const {
  const EarlierResults& earlier = state_->earlier;
  CampaignSummary summary = SummariseCampaign(state_->campaign, earlier.strings, state_->later);
  summary.before_version = earlier.version;
  summary.before_rows = static_cast<std::int64_t>(earlier.strings.size());
  summary.before_first_date = earlier.first_date;
  summary.before_last_date = earlier.last_date;
  summary.remarks = RemarksOn(earlier);
  return summary;
}

AddedReport CampaignAddition::Report() const {
  AddedReport report;
  if (!state_) return report;
  const CampaignSummary summary = Summary();
  report.sections = CampaignSections(summary, kMostChangesInText);
  if (results_ != nullptr) results_->campaign = summary;
  return report;
}

std::vector<ResultFile> CampaignAddition::Files() const {
  if (!state_) return {};
  return {
      {kCampaignFile,
       CampaignJson(Summary()).dump(2, ' ', false, BatchJson::error_handler_t::replace) + "\n"}};
}

}  // namespace lyrefit
