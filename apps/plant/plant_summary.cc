#include "plant/plant_summary.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/reasons.h"

namespace lyrefit {
namespace {

constexpr const char* kNames[] = {"id",
                                  "status",
                                  "reason",
                                  "date",
                                  "zone",
                                  "cause",
                                  "cause_title",
                                  "cause_about",
                                  "performance_factor",
                                  "Pmax_stc_W",
                                  "recoverable_power_W",
                                  "group_deviation_percent",
                                  "lack_of_fit_percent",
                                  "page",
                                  "below_rating_W",
                                  "group_flag",
                                  "group_outlier",
                                  "sparkline",
                                  "plan_cause",
                                  "plan_cause_title",
                                  "plan_cause_about",
                                  "plan_sentence",
                                  "plan_equivalents",
                                  "plan_action",
                                  "plan_lost_W",
                                  "loss_now_total_percent",
                                  "onset_date",
                                  "largest_loss",
                                  "first",
                                  "last"};

PlantShare& ShareOf(const std::string& word, std::map<std::string, PlantShare>* shares) {
  if (shares->size() < kPlantMostWords || shares->count(word)) return (*shares)[word];
  return (*shares)["others"];
}

void Count(const std::string& word, const PlantRow& row,
           std::map<std::string, PlantShare>* shares) {
  if (word.empty()) return;
  PlantShare& share = ShareOf(word, shares);
  ++share.rows;
  if (row.recoverable_power_W > 0) share.recoverable_power_W += row.recoverable_power_W;
  if (row.below_rating_W > 0) share.below_rating_W += row.below_rating_W;
  if (share.title.empty()) share.title = row.cause_title;
}

// The title of a row's cause.
std::string TitleOf(const PlantRow& row) {
  if (IsNoCause(row.cause)) return kNoCause;
  return row.cause_title.empty() ? row.cause : row.cause_title;
}

bool Passes(const std::string& zone) { return zone.rfind("pass", 0) == 0; }

bool IsFine(const std::string& status) { return status.empty() || status == "fine"; }

// Order of a heap with the smallest key on top.
bool Larger(const std::pair<double, PlantRow>& one, const std::pair<double, PlantRow>& other) {
  return one.first > other.first;
}

// Keeps at most `most` rows, those of the largest keys.
void Rank(double key, const PlantRow& row, std::size_t most,
          std::vector<std::pair<double, PlantRow>>* ranked) {
  if (!std::isfinite(key)) return;
  if (ranked->size() == most && !(key > ranked->front().first)) return;
  ranked->emplace_back(key, row);
  std::push_heap(ranked->begin(), ranked->end(), Larger);
  if (ranked->size() <= most) return;
  std::pop_heap(ranked->begin(), ranked->end(), Larger);
  ranked->pop_back();
}

std::vector<PlantRow> InOrder(std::vector<std::pair<double, PlantRow>> ranked) {
  std::sort(ranked.begin(), ranked.end(), [](const auto& one, const auto& other) {
    return one.first != other.first ? one.first > other.first : one.second.id < other.second.id;
  });
  std::vector<PlantRow> rows;
  rows.reserve(ranked.size());
  for (auto& row : ranked) rows.push_back(std::move(row.second));
  return rows;
}

}  // namespace

bool IsNoCause(const std::string& cause) {
  return cause.empty() || cause == "none" || cause == "clean" || cause == "reference";
}

PlantCounter::PlantCounter(const std::vector<ResultColumn>& columns)
    : sampler_(columns), losses_(columns) {
  for (int known = 0; known < kColumns; ++known) {
    const auto at = std::find_if(columns.begin(), columns.end(), [&](const ResultColumn& column) {
      return column.name == kNames[known];
    });
    places_[known] = at == columns.end() ? -1 : static_cast<int>(at - columns.begin());
  }
  sum_.judged_by = Has(kZone) ? "zone" : Has(kCause) || Has(kPlanCause) ? "cause" : "";
  sum_.titled_by = Has(kCauseTitle) ? "cause_title" : Has(kCause) ? "cause" : "";
  if (sum_.titled_by.empty() && Has(kPlanTitle)) sum_.titled_by = "plan_cause_title";
  for (const Known by : {kPerformance, kLostNow, kDeviation, kRecoverable, kDeparture}) {
    if (Has(by) && sum_.worst_by.empty()) sum_.worst_by = kNames[by];
  }
}

std::string PlantCounter::Text(const ResultRow& row, Known column) const {
  const std::size_t place = places_[column];
  if (!Has(column) || place >= row.cells.size()) return "";
  const std::string* text = std::get_if<std::string>(&row.cells[place]);
  return text ? *text : "";
}

double PlantCounter::Number(const ResultRow& row, Known column) const {
  return Has(column) ? NumberAt(row, places_[column]) : kUnknown;
}

// By the zone of a field test that decides, else by the existence of a cause.
bool PlantCounter::NeedsWork(const std::string& zone, const std::string& cause) const {
  if (Has(kZone) && zone != "undecided") return !zone.empty() && !Passes(zone);
  return !IsNoCause(cause);
}

// True for a cause of the measurement rather than of the plant, unless the zone requires work.
bool PlantCounter::ToRepeat(const std::string& about, const std::string& zone) const {
  return (about == "sweep" || about == "instrument" || about == "conditions") &&
         !(Has(kZone) && NeedsWork(zone, ""));
}

// A cause of the scale takes the place of the cause of the curve, which is none or of the
// measurement alone.
PlantRow PlantCounter::WithPlan(PlantRow named, const ResultRow& row) const {
  named.plan_sentence = Text(row, kPlanSentence);
  named.plan_action = Text(row, kPlanAction);
  named.plan_equivalents = Text(row, kPlanEquivalents);
  named.plan_lost_W = Number(row, kPlanLost);
  named.cause = Text(row, kPlanCause);
  named.cause_title = Text(row, kPlanTitle);
  named.recoverable_power_W = named.plan_lost_W;
  return named;
}

bool PlantCounter::Differs(const ResultRow& row) const {
  const std::size_t place = places_[kDiffers];
  if (!Has(kDiffers) || place >= row.cells.size()) return false;
  const bool* const differs = std::get_if<bool>(&row.cells[place]);
  return differs != nullptr && *differs;
}

// Sort key of the worst rows, larger is worse; NaN: unknown.
double PlantCounter::Badness(const ResultRow& row) const {
  if (Has(kPerformance)) return -Number(row, kPerformance);
  if (Has(kLostNow)) return Number(row, kLostNow);
  if (Has(kDeviation)) return -Number(row, kDeviation);
  if (Has(kRecoverable)) return Number(row, kRecoverable);
  return Number(row, kDeparture);
}

void PlantCounter::CountTree(const PlantRow& row, bool needs_work) {
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

void PlantCounter::CountWords(const PlantRow& row, const std::string& status, bool needs_work,
                              bool to_repeat) {
  Count(status, row, &sum_.status);
  if (!IsFine(status)) {
    const std::string reason = row.reason.empty() ? "no reason given" : row.reason;
    const auto first = first_reasons_.try_emplace(WithoutNumbers(reason), reason).first;
    Count(first->second, row, &sum_.reasons);
    if (sum_.broken.size() < kPlantListed) sum_.broken.push_back(row);
    return;
  }
  Count(row.zone, row, &sum_.zones);
  const std::string cause = IsNoCause(row.cause) ? kNoCause : row.cause;
  if (needs_work) Count(cause, row, &sum_.causes);
  if (to_repeat) Count(cause, row, &sum_.causes_to_repeat);
  if (!needs_work && !to_repeat && !IsNoCause(row.cause)) Count(cause, row, &sum_.causes_of_passed);
}

void PlantCounter::CountDate(const std::string& date) {
  if (!date.empty() && (sum_.first_date.empty() || date < sum_.first_date)) sum_.first_date = date;
  sum_.last_date = std::max(sum_.last_date, date);
}

void PlantCounter::Add(const ResultRow& row) {
  PlantRow named;
  named.id = Text(row, kId);
  named.zone = Text(row, kZone);
  named.cause = Text(row, kCause);
  named.cause_title = Text(row, kCauseTitle);
  named.reason = Text(row, kReason);
  named.page = Text(row, kPage);
  named.outlier = Text(row, kOutlier);
  named.sparkline = Text(row, kSparkline);
  named.onset_date = Text(row, kOnset);
  named.largest_loss = Text(row, kLargestLoss);
  named.lost_now_percent = Number(row, kLostNow);
  named.below_rating_W = Number(row, kBelow);
  named.deviation_percent = Number(row, kDeviation);
  named.performance_factor = Number(row, kPerformance);
  named.Pmax_stc_W = Number(row, kPower);
  named.recoverable_power_W = Number(row, kRecoverable);
  const bool planned = !Text(row, kPlanCause).empty();
  const std::string about = Text(row, planned ? kPlanAbout : kCauseAbout);
  if (planned) named = WithPlan(std::move(named), row);
  const std::string status = Text(row, kStatus);
  const bool fine = IsFine(status);
  const bool to_repeat = fine && ToRepeat(about, named.zone);
  const bool needs_work = fine && !to_repeat && NeedsWork(named.zone, named.cause);

  ++sum_.rows;
  sum_.fine += fine ? 1 : 0;
  sum_.passed += fine && Passes(named.zone) ? 1 : 0;
  sum_.in_need += needs_work ? 1 : 0;
  sum_.to_repeat += to_repeat ? 1 : 0;
  if (std::isfinite(named.Pmax_stc_W)) sum_.power_W += named.Pmax_stc_W;
  if (needs_work && named.recoverable_power_W > 0) {
    sum_.recoverable_power_W += named.recoverable_power_W;
  }
  if (fine && !needs_work && Differs(row)) ++sum_.passed_outlier;
  if (needs_work && named.below_rating_W > 0) sum_.below_rating_W += named.below_rating_W;
  CountWords(named, status, needs_work, to_repeat);
  for (const Known date : {kDate, kFirst, kLast}) CountDate(Text(row, date));
  CountTree(named, needs_work);
  if (!fine) return;
  if (!Passes(named.zone)) Rank(Badness(row), named, kPlantWorst, &worst_);
  if (!named.plan_sentence.empty()) {
    Count(named.cause, named, &sum_.plan_causes);
    if (named.plan_lost_W > 0) sum_.plan_lost_W += named.plan_lost_W;
    Rank(std::isfinite(named.plan_lost_W) ? named.plan_lost_W : 0, named, kPlantScaled, &scaled_);
  }
  sampler_.Add(row, Differs(row));
  losses_.Add(named.id, row);
  if (!Differs(row)) return;
  const double by = std::fabs(named.deviation_percent);
  Rank(std::isfinite(by) ? by : 0, named, kPlantListed, &outliers_);
}

PlantSummary PlantCounter::Summary() const {
  PlantSummary summary = sum_;
  summary.sample = sampler_.sample();
  summary.losses = losses_.summary();
  summary.worst = InOrder(worst_);
  summary.outliers = InOrder(outliers_);
  summary.scaled = InOrder(scaled_);
  return summary;
}

}  // namespace lyrefit
