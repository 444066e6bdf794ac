#include "lyrefit/batch/plant_summary.h"

#include <algorithm>
#include <cmath>

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
                                  "group_flag"};

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
  if (share.title.empty()) share.title = row.cause_title;
}

bool Passes(const std::string& zone) { return zone.rfind("pass", 0) == 0; }

bool IsFine(const std::string& status) { return status.empty() || status == "fine"; }

// Order of a heap with the least bad row on top.
bool Worse(const std::pair<double, PlantRow>& one, const std::pair<double, PlantRow>& other) {
  return one.first > other.first;
}

}  // namespace

bool IsNoCause(const std::string& cause) {
  return cause.empty() || cause == "none" || cause == "clean" || cause == "reference";
}

PlantCounter::PlantCounter(const std::vector<ResultColumn>& columns) {
  for (int known = 0; known < kColumns; ++known) {
    const auto at = std::find_if(columns.begin(), columns.end(), [&](const ResultColumn& column) {
      return column.name == kNames[known];
    });
    places_[known] = at == columns.end() ? -1 : static_cast<int>(at - columns.begin());
  }
  sum_.judged_by = Has(kZone) ? "zone" : Has(kCause) ? "cause" : "";
  for (const Known by : {kPerformance, kDeviation, kRecoverable, kDeparture}) {
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
  const std::size_t place = places_[column];
  if (!Has(column) || place >= row.cells.size()) return kUnknown;
  if (const double* number = std::get_if<double>(&row.cells[place])) return *number;
  const auto* whole = std::get_if<std::int64_t>(&row.cells[place]);
  return whole ? static_cast<double>(*whole) : kUnknown;
}

// By the zone of a field test if there is one, else by the existence of a cause.
bool PlantCounter::NeedsWork(const std::string& zone, const std::string& cause) const {
  if (Has(kZone)) return !zone.empty() && !Passes(zone);
  return !IsNoCause(cause);
}

// True for a cause of the measurement rather than of the plant, unless the zone requires work.
bool PlantCounter::ToRepeat(const ResultRow& row) const {
  const std::string about = Text(row, kCauseAbout);
  return (about == "sweep" || about == "instrument" || about == "conditions") &&
         !(Has(kZone) && NeedsWork(Text(row, kZone), ""));
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
    Count(row.reason.empty() ? "no reason given" : row.reason, row, &sum_.reasons);
    if (sum_.broken.size() < kPlantWorst) sum_.broken.push_back(row);
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

void PlantCounter::CountWorst(double badness, const PlantRow& row) {
  if (!std::isfinite(badness)) return;
  if (worst_.size() == kPlantWorst && !(badness > worst_.front().first)) return;
  worst_.emplace_back(badness, row);
  std::push_heap(worst_.begin(), worst_.end(), Worse);
  if (worst_.size() <= kPlantWorst) return;
  std::pop_heap(worst_.begin(), worst_.end(), Worse);
  worst_.pop_back();
}

void PlantCounter::Add(const ResultRow& row) {
  PlantRow named;
  named.id = Text(row, kId);
  named.zone = Text(row, kZone);
  named.cause = Text(row, kCause);
  named.cause_title = Text(row, kCauseTitle);
  named.reason = Text(row, kReason);
  named.page = Text(row, kPage);
  named.performance_factor = Number(row, kPerformance);
  named.Pmax_stc_W = Number(row, kPower);
  named.recoverable_power_W = Number(row, kRecoverable);
  const std::string status = Text(row, kStatus);
  const bool fine = IsFine(status);
  const bool to_repeat = fine && ToRepeat(row);
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
  const double below_W = Number(row, kBelow);
  if (needs_work && below_W > 0) sum_.below_rating_W += below_W;
  if (std::isfinite(named.performance_factor)) {
    const double step = std::clamp(std::floor(named.performance_factor * 100 + 1e-9), 0.0, 150.0);
    ++sum_.performance[static_cast<std::size_t>(step)];
  }
  CountWords(named, status, needs_work, to_repeat);
  CountDate(Text(row, kDate));
  CountTree(named, needs_work);
  if (fine) CountWorst(Badness(row), named);
}

PlantSummary PlantCounter::Summary() const {
  PlantSummary summary = sum_;
  auto worst = worst_;
  std::sort(worst.begin(), worst.end(), [](const auto& one, const auto& other) {
    return one.first != other.first ? one.first > other.first : one.second.id < other.second.id;
  });
  for (auto& row : worst) summary.worst.push_back(std::move(row.second));
  return summary;
}

}  // namespace lyrefit
