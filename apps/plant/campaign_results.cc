#include "plant/campaign_results.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/batch/count_rows.h"
#include "plant/campaign_document.h"

namespace lyrefit {
namespace {

constexpr char kLevelOption[] = "change-level";
constexpr char kBypassDiodesColumn[] = "bypass_diodes";
constexpr char kCampaignFile[] = "campaign.json";
constexpr std::size_t kMostChangesInText = 25;

float FigureIn(const ResultRow& row, std::size_t place) {
  const double* const value = CellAt<double>(row, place);
  return static_cast<float>(value == nullptr ? kUnknown : *value);
}

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

CampaignAddition::State::State(EarlierResults results, const std::vector<ResultColumn>& columns,
                               double change_level)
    : earlier(std::move(results)),
      level(change_level),
      id(ColumnPlace(columns, "id")),
      cause(ColumnPlace(columns, "cause")),
      about(ColumnPlace(columns, "cause_about")),
      diodes(ColumnPlace(columns, kBypassDiodesColumn)) {
  for (int q = 0; q < kCampaignKept; ++q) {
    values[q] = ColumnPlace(columns, kFigureColumns[q]);
    expanded[q] = ColumnPlace(columns, kExpandedColumns[q]);
  }
}

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
    state_.emplace(std::move(earlier), input.columns, options.value(kLevelOption, 0.0));
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
  for (const ResultRow& row : group.rows) {
    CampaignString string;
    if (const auto* const id = CellAt<std::string>(row, state_->id)) string.id = *id;
    if (const auto* const cause = CellAt<std::string>(row, state_->cause)) string.cause = *cause;
    const auto* const about = CellAt<std::string>(row, state_->about);
    string.repeat = about != nullptr && IsOfSweep(*about);
    const auto* const diodes = CellAt<std::int64_t>(row, state_->diodes);
    string.bypass_diodes = diodes == nullptr ? 0 : static_cast<std::int32_t>(*diodes);
    for (int q = 0; q < kCampaignKept; ++q) {
      string.values[q] = FigureIn(row, state_->values[q]);
      string.expanded[q] = FigureIn(row, state_->expanded[q]);
    }
    state_->later.push_back(std::move(string));
  }
}

void CampaignAddition::EndLearning() {
  if (!state_) return;
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
