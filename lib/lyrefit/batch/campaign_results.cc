#include "lyrefit/batch/campaign_results.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/batch/count_rows.h"

namespace lyrefit {
namespace {

constexpr char kLevelOption[] = "change-level";

const std::string* CampaignTextIn(const ResultRow& row, std::size_t place) {
  return place < row.cells.size() ? std::get_if<std::string>(&row.cells[place]) : nullptr;
}

float FigureIn(const ResultRow& row, std::size_t place) {
  const double* const value =
      place < row.cells.size() ? std::get_if<double>(&row.cells[place]) : nullptr;
  return static_cast<float>(value == nullptr ? kUnknown : *value);
}

std::vector<std::string> RemarksOn(const EarlierResults& earlier) {
  if (earlier.version == Version()) return {};
  return {fmt::format(
      "The earlier results are by lyrefit {}, these by {}. What both differ in is common to all "
      "strings; to be rid of it, do the earlier run again.",
      earlier.version, Version())};
}

}  // namespace

CampaignResults::CampaignResults(EarlierResults earlier, const std::vector<ResultColumn>& columns,
                                 double level)
    : earlier_(std::move(earlier)), level_(level) {
  const auto place = [&](const char* name) { return ColumnPlace(columns, name); };
  at_ = {place("id"), place("cause"), place("cause_about"), place(kBypassDiodesColumn), {}, {}};
  for (int q = 0; q < kCampaignKept; ++q) {
    at_.values[q] = place(kFigureColumns[q]);
    at_.expanded[q] = place(kExpandedColumns[q]);
  }
}

Expected<std::unique_ptr<CampaignResults>> CampaignResults::Open(
    const CheckpointHead& head, const std::vector<std::string>& parts,
    const std::vector<ResultColumn>& columns) {
  const BatchJson& options = head.at("options");
  const std::string digest = options.value(kBeforeOption, "");
  if (digest.empty()) return std::unique_ptr<CampaignResults>();
  for (const std::string& part : parts) {
    const std::string path = EarlierCopyPath(std::filesystem::path(part).parent_path().string());
    std::error_code error;
    if (!std::filesystem::exists(path, error)) continue;
    TRY(EarlierResults earlier, ReadEarlierCopy(path, digest));
    return std::unique_ptr<CampaignResults>(
        new CampaignResults(std::move(earlier), columns, options.value(kLevelOption, 0.0)));
  }
  return Fail("the copy of the earlier results, before.part, is in no folder of these rows",
              parts.front());
}

void CampaignResults::Take(const ResultRow& row) {
  CampaignString string;
  if (const std::string* const id = CampaignTextIn(row, at_.id)) string.id = *id;
  if (const std::string* const cause = CampaignTextIn(row, at_.cause)) string.cause = *cause;
  const std::string* const about = CampaignTextIn(row, at_.about);
  string.repeat = about != nullptr && IsOfSweep(*about);
  if (at_.diodes < row.cells.size()) {
    const auto* const diodes = std::get_if<std::int64_t>(&row.cells[at_.diodes]);
    string.bypass_diodes = diodes == nullptr ? 0 : static_cast<std::int32_t>(*diodes);
  }
  for (int q = 0; q < kCampaignKept; ++q) {
    string.values[q] = FigureIn(row, at_.values[q]);
    string.expanded[q] = FigureIn(row, at_.expanded[q]);
  }
  later_.push_back(std::move(string));
}

void CampaignResults::Compare() { campaign_ = CompareCampaigns(earlier_.strings, later_, level_); }

std::vector<ResultCell> CampaignResults::NextCells() {
  return CampaignCells(campaign_, earlier_.strings, later_, next_++);
}

CampaignSummary CampaignResults::Summary() const {
  CampaignSummary summary = SummariseCampaign(campaign_, earlier_.strings, later_);
  summary.before_version = earlier_.version;
  summary.before_rows = static_cast<std::int64_t>(earlier_.strings.size());
  summary.before_first_date = earlier_.first_date;
  summary.before_last_date = earlier_.last_date;
  summary.remarks = RemarksOn(earlier_);
  return summary;
}

}  // namespace lyrefit
