#include <fmt/format.h>

#include <algorithm>

#include "plant/plant_figures.h"
#include "plant/plant_text.h"

namespace lyrefit {
namespace {

constexpr std::size_t kGroups = 15;
constexpr std::size_t kCauses = 6;

using NamedNode = std::pair<std::string, PlantNode>;

// What strings that need work lose: the watts below their rating, else those that their causes
// cost, else the number of strings.
struct PlantLoss {
  double PlantShare::*watts = nullptr;  // null: strings
  double Of(const PlantShare& share) const {
    return watts != nullptr ? share.*watts : static_cast<double>(share.rows);
  }
  double Of(const PlantNode& node) const {
    double sum = 0;
    for (const auto& [title, share] : node.causes) sum += Of(share);
    return sum;
  }
  std::string Text(double loss) const {
    return watts != nullptr ? Power(loss) : Counted(static_cast<std::int64_t>(loss));
  }
  const char* Unit() const { return watts != nullptr ? "W" : "strings"; }
  const char* Label() const {
    if (watts == nullptr) return "Strings that need work";
    return watts == &PlantShare::below_rating_W ? "Power below the rating (W)"
                                                : "Power to recover (W)";
  }
};

PlantLoss LossIn(const PlantSummary& summary) {
  if (summary.below_rating_W > 0) return {&PlantShare::below_rating_W};
  if (summary.recoverable_power_W > 0) return {&PlantShare::recoverable_power_W};
  return {};
}

// The causes of the largest losses; all others count as one.
std::vector<std::string> CausesOf(const std::vector<NamedNode>& groups, const PlantLoss& loss) {
  std::map<std::string, double> sums;
  for (const NamedNode& group : groups) {
    for (const auto& [title, share] : group.second.causes) sums[title] += loss.Of(share);
  }
  std::vector<std::pair<double, std::string>> ordered;
  for (const auto& [title, sum] : sums) {
    if (sum > 0) ordered.emplace_back(-sum, title);
  }
  std::sort(ordered.begin(), ordered.end());
  std::vector<std::string> causes;
  for (std::size_t c = 0; c < std::min(ordered.size(), kCauses); ++c) {
    causes.push_back(ordered[c].second);
  }
  if (ordered.size() > kCauses) causes.emplace_back("others");
  return causes;
}

// The groups that lose most, the worst first.
std::vector<NamedNode> WorstGroups(const PlantSummary& summary, const PlantLoss& loss) {
  std::vector<NamedNode> groups;
  if (summary.levels.empty()) return groups;
  for (const auto& [path, node] : summary.levels.back()) {
    if (loss.Of(node) > 0) groups.emplace_back(path, node);
  }
  std::stable_sort(groups.begin(), groups.end(), [&](const NamedNode& one, const NamedNode& other) {
    return loss.Of(one.second) > loss.Of(other.second);
  });
  if (groups.size() > kGroups) groups.resize(kGroups);
  return groups;
}

// Losses of a group by cause, in the order of `causes`.
std::vector<double> LossesOf(const PlantNode& node, const std::vector<std::string>& causes,
                             const PlantLoss& loss) {
  std::vector<double> losses(causes.size(), 0);
  for (const auto& [title, share] : node.causes) {
    const auto at = std::find(causes.begin(), causes.end(), title);
    const auto place = static_cast<std::size_t>(at - causes.begin());
    losses[std::min(place, causes.size() - 1)] += loss.Of(share);
  }
  return losses;
}

// One bar on the other: bars from zero to each sum, the largest behind the others. Their filters name
// the column of the cause.
Panel StackedBars(const std::vector<NamedNode>& groups, const std::vector<std::string>& causes,
                  const PlantLoss& loss, const PlantSummary& summary) {
  Panel panel;
  const std::string& by = summary.titled_by;
  for (std::size_t c = causes.size(); c-- > 0;) {
    Series bars;
    bars.kind = SeriesKind::kBars;
    bars.look = LookOf(static_cast<int>(c));
    bars.width = 0.8;
    const bool to_do = summary.tells_what_to_do;
    bars.filter_columns = {"id", "status", to_do ? "string_to_do" : "zone", by};
    const bool others = causes[c] == "others" || (causes[c] == kNoCause && by == "cause");
    const std::string needs = !to_do ? "!pass" : causes[c] == kNoCause ? "=work" : "!inspect";
    const std::string title = others ? "" : causes[c] == kNoCause ? "=" : "=" + causes[c];
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::vector<double> losses = LossesOf(groups[g].second, causes, loss);
      if (!(losses[c] > 0)) continue;
      double sum = 0;
      for (std::size_t below = 0; below <= c; ++below) sum += losses[below];
      bars.Add(static_cast<double>(g), sum);
      bars.filters.push_back({"^" + groups[g].first + "/", "=fine", needs, title});
      bars.texts.push_back(
          fmt::format("{}: {}, {}", groups[g].first, causes[c], loss.Text(losses[c])));
    }
    panel.series.push_back(std::move(bars));
  }
  panel.y = {loss.Label(), 0};
  panel.x.low = -0.6;
  panel.x.high = static_cast<double>(groups.size()) - 0.4;
  panel.x.slanted = true;
  for (const NamedNode& group : groups) {
    panel.x.ticks.push_back({ShortName(group.first), static_cast<double>(panel.x.ticks.size())});
  }
  panel.height = 240;
  return panel;
}

}  // namespace

block::Figure GroupsFigure(const PlantSummary& summary) {
  block::Figure shown;
  const PlantLoss loss = LossIn(summary);
  const std::vector<NamedNode> groups = WorstGroups(summary, loss);
  if (groups.empty()) return shown;
  const std::vector<std::string> causes = CausesOf(groups, loss);
  shown.figure.title = "What is lost where, by cause";
  shown.caption =
      fmt::format("The {} groups in which the strings that need work lose most.", groups.size());
  shown.figure.legend = LegendOf(causes, LegendMark::kBar);
  shown.figure.panels = {StackedBars(groups, causes, loss, summary)};
  shown.figure.panel_width = 760;
  shown.figure.margin_below = 70;
  shown.readings.alignment = "l" + std::string(causes.size() + 1, 'r');
  shown.readings.heads = {{"group", fmt::format("all ({})", loss.Unit())}};
  shown.readings.caption = "The groups that lose most.";
  block::Table::Row& head = shown.readings.heads.front();
  head.insert(head.end(), causes.begin(), causes.end());
  for (const auto& [path, node] : groups) {
    block::Table::Row row = {path, fmt::format("{:.0f}", loss.Of(node))};
    for (const double part : LossesOf(node, causes, loss)) {
      row.push_back(part > 0 ? fmt::format("{:.0f}", part) : "");
    }
    shown.readings.rows.push_back(std::move(row));
  }
  return shown;
}

}  // namespace lyrefit
