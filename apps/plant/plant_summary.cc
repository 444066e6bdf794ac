#include "plant/plant_summary.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/reasons.h"

namespace lyrefit {
namespace {

// The columns that rank the worst rows, the first that there is, and which way is worse.
constexpr std::pair<const char*, double> kRankedBy[] = {{"performance_factor", -1},
                                                        {"loss_now_total_percent", 1},
                                                        {"group_deviation_percent", -1},
                                                        {"recoverable_power_W", 1},
                                                        {"lack_of_fit_percent", 1}};

PlantShare& ShareOf(const std::string& word, std::map<std::string, PlantShare>* shares) {
  if (shares->size() < kPlantMostWords || shares->count(word)) return (*shares)[word];
  return (*shares)["others"];
}

void Count(const std::string& word, const PlantRow& row,
           std::map<std::string, PlantShare>* shares) {
  if (word.empty()) return;
  PlantShare& share = ShareOf(word, shares);
  ++share.rows;
  const double power_W = row.verdict.cause.recoverable_power_W.value;
  if (power_W > 0) share.recoverable_power_W += power_W;
  if (row.below_rating_W > 0) share.below_rating_W += row.below_rating_W;
  if (share.title.empty()) share.title = row.verdict.cause.title;
}

// The cause of a row, and its title.
std::string CauseOf(const PlantRow& row) {
  return row.verdict.cause.id.empty() ? kNoCause : row.verdict.cause.id;
}

std::string TitleOf(const PlantRow& row) {
  const Cause& cause = row.verdict.cause;
  return cause.id.empty() || cause.title.empty() ? CauseOf(row) : cause.title;
}

bool Passes(const std::string& zone) { return zone.rfind("pass", 0) == 0; }

bool IsFine(const std::string& status) { return status.empty() || status == "fine"; }

}  // namespace

PlantCounter::PlantCounter(const std::vector<ResultColumn>& columns)
    : reader_(columns), judge_(columns), sampler_(columns), losses_(columns) {
  const auto has = [this](const char* name) { return reader_.Has(name); };
  sum_.judged_by = has("zone") ? "zone" : has("cause") || has("plan_cause") ? "cause" : "";
  for (const char* by : {"string_cause_title", "cause_title", "cause"}) {
    if (has(by) && sum_.titled_by.empty()) sum_.titled_by = by;
  }
  sum_.tells_what_to_do = has("string_to_do");
  for (const auto& [by, worse] : kRankedBy) {
    if (!has(by) || !ranked_by_.empty()) continue;
    ranked_by_ = by;
    worse_ = worse;
  }
  sum_.worst_by = judge_.judges() ? "what is lost" : ranked_by_;
}

// Sort key of the worst rows, larger is worse; NaN: unknown.
double PlantCounter::Badness(const ResultRow& row) const {
  return worse_ * reader_.Number(row, ranked_by_);
}

// Keeps at most `most` rows, those of the highest ranks.
void PlantCounter::Keep(Rank rank, const PlantRow& row, std::size_t most, Ranked* ranked) {
  const auto larger = [](const auto& one, const auto& other) { return one.first > other.first; };
  if (ranked->size() == most && !(rank > ranked->front().first)) return;
  ranked->emplace_back(rank, row);
  std::push_heap(ranked->begin(), ranked->end(), larger);
  if (ranked->size() <= most) return;
  std::pop_heap(ranked->begin(), ranked->end(), larger);
  ranked->pop_back();
}

std::vector<PlantRow> PlantCounter::InOrder(Ranked ranked) {
  std::sort(ranked.begin(), ranked.end(), [](const auto& one, const auto& other) {
    return one.first != other.first ? one.first > other.first : one.second.id < other.second.id;
  });
  std::vector<PlantRow> rows;
  rows.reserve(ranked.size());
  for (auto& row : ranked) rows.push_back(std::move(row.second));
  return rows;
}

void PlantCounter::CountTree(const PlantRow& row) {
  const bool needs_work = row.verdict.NeedsWork();
  std::size_t end = row.id.find('/');
  for (std::size_t depth = 0; depth < deepest_ && end != std::string::npos; ++depth) {
    if (sum_.levels.size() == depth) sum_.levels.emplace_back();
    auto& nodes = sum_.levels[depth];
    PlantNode& node = nodes[row.id.substr(0, end)];
    ++node.rows;
    node.in_need += needs_work ? 1 : 0;
    if (needs_work) Count(TitleOf(row), row, &node.causes);
    // The comparison is false if one side is NaN.
    if (!(node.lowest_performance <= row.performance_factor) &&
        std::isfinite(row.performance_factor)) {
      node.lowest_performance = row.performance_factor;
    }
    if (nodes.size() > kPlantMostNodes) {
      deepest_ = depth;
      sum_.levels.resize(depth);
    }
    end = row.id.find('/', end + 1);
  }
}

void PlantCounter::CountWords(const PlantRow& row, const std::string& status) {
  Count(status, row, &sum_.status);
  if (!IsFine(status)) {
    const std::string reason = row.reason.empty() ? "no reason given" : row.reason;
    const auto first = first_reasons_.try_emplace(WithoutNumbers(reason), reason).first;
    Count(first->second, row, &sum_.reasons);
    if (sum_.broken.size() < kPlantListed) sum_.broken.push_back(row);
    return;
  }
  Count(row.verdict.zone, row, &sum_.zones);
  const bool named = !row.verdict.cause.id.empty();
  if (row.verdict.NeedsWork()) Count(CauseOf(row), row, &sum_.causes);
  if (row.verdict.to_do == ToDo::kMeasureAgain) Count(CauseOf(row), row, &sum_.causes_to_repeat);
  if (row.verdict.to_do == ToDo::kInspect && named)
    Count(CauseOf(row), row, &sum_.causes_of_passed);
}

void PlantCounter::CountDate(const std::string& date) {
  if (!date.empty() && (sum_.first_date.empty() || date < sum_.first_date)) sum_.first_date = date;
  sum_.last_date = std::max(sum_.last_date, date);
}

void PlantCounter::Add(const ResultRow& row) {
  PlantRow named;
  named.id = reader_.Text(row, "id");
  named.verdict = judge_.Judge(row);
  named.reason = reader_.Text(row, "reason");
  named.page = reader_.Text(row, "page");
  named.sparkline = reader_.Text(row, "sparkline");
  named.onset_date = reader_.Text(row, "onset_date");
  named.largest_loss = reader_.Text(row, "largest_loss");
  named.lost_now_percent = reader_.Number(row, "loss_now_total_percent");
  named.below_rating_W = reader_.Number(row, "below_rating_W");
  named.deviation_percent = reader_.Number(row, "group_deviation_percent");
  named.performance_factor = reader_.Number(row, "performance_factor");
  named.Pmax_stc_W = reader_.Number(row, "Pmax_stc_W");
  const std::string status = reader_.Text(row, "status");
  const bool fine = IsFine(status);
  const bool needs_work = named.verdict.NeedsWork();
  const bool differs = fine && reader_.Truth(row, "group_flag");

  ++sum_.rows;
  sum_.fine += fine ? 1 : 0;
  sum_.passed += fine && Passes(named.verdict.zone) ? 1 : 0;
  sum_.in_need += needs_work ? 1 : 0;
  sum_.to_repeat += named.verdict.to_do == ToDo::kMeasureAgain ? 1 : 0;
  if (std::isfinite(named.Pmax_stc_W)) sum_.power_W += named.Pmax_stc_W;
  const double power_W = named.verdict.cause.recoverable_power_W.value;
  if (needs_work && power_W > 0) sum_.recoverable_power_W += power_W;
  if (differs && !needs_work) ++sum_.passed_outlier;
  if (needs_work && named.below_rating_W > 0) sum_.below_rating_W += named.below_rating_W;
  CountWords(named, status);
  for (const char* date : {"date", "first", "last"}) CountDate(reader_.Text(row, date));
  CountTree(named);
  if (!fine) return;
  const double badness = Badness(row);
  const auto known = [](double value) { return std::isfinite(value) ? value : -HUGE_VAL; };
  if (!judge_.judges()) {
    if (std::isfinite(badness)) Keep({badness}, named, kPlantWorst, &worst_);
  } else if (named.verdict.NeedsAVisit()) {
    const double urgency = -static_cast<double>(named.verdict.to_do);
    Keep({urgency, std::fmax(named.lost_W(), 0), known(badness)}, named, kPlantWorst, &worst_);
  }
  sampler_.Add(row, differs);
  losses_.Add(named.id, row);
  if (!differs) return;
  const double by = std::fabs(named.deviation_percent);
  Keep({std::isfinite(by) ? by : 0}, named, kPlantListed, &outliers_);
}

PlantSummary PlantCounter::Summary() const {
  PlantSummary summary = sum_;
  summary.sample = sampler_.sample();
  summary.losses = losses_.summary();
  summary.worst = InOrder(worst_);
  summary.outliers = InOrder(outliers_);
  return summary;
}

}  // namespace lyrefit
