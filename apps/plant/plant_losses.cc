#include "plant/plant_losses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lyrefit/batch/addition.h"
#include "plant/plant_figures.h"
#include "plant/plant_text.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLossGroups = 15;
constexpr std::size_t kAllParts = std::size(kPlantLossParts);

using NamedLosses = std::pair<std::string, PlantLosses>;

// The sums with those of one more string.
PlantLosses WithLoss(PlantLosses sums, const std::vector<double>& percents, double weight,
                     double now_percent) {
  sums.weights.resize(kAllParts, 0);
  sums.parts.resize(kAllParts, 0);
  ++sums.rows;
  for (std::size_t p = 0; p < kAllParts; ++p) {
    if (!std::isfinite(percents[p])) continue;
    sums.weights[p] += weight;
    sums.parts[p] += weight * percents[p];
  }
  if (std::isfinite(now_percent)) sums.lost_W += weight * now_percent / 100;
  return sums;
}

// Mean of the strings that tell the part; NaN: none does.
double Percent(const PlantLosses& losses, std::size_t part) {
  return losses.parts[part] / losses.weights[part];
}

// The groups that lose most, the worst first.
std::vector<NamedLosses> LosingGroups(const PlantLossSummary& summary) {
  std::vector<NamedLosses> groups(summary.groups.begin(), summary.groups.end());
  std::stable_sort(
      groups.begin(), groups.end(), [](const NamedLosses& one, const NamedLosses& other) {
        return Percent(one.second, kAllParts - 1) > Percent(other.second, kAllParts - 1);
      });
  if (groups.size() > kLossGroups) groups.resize(kLossGroups);
  return groups;
}

// One bar on the other, of the parts that are losses.
Panel LossBars(const std::vector<NamedLosses>& groups) {
  Panel panel;
  for (std::size_t part = kAllParts - 1; part-- > 0;) {
    Series bars;
    bars.kind = SeriesKind::kBars;
    bars.look = LookOf(static_cast<int>(part));
    bars.width = 0.8;
    bars.filter_columns = {"id", "status"};
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const double own = Percent(groups[g].second, part);
      if (!(own > 0)) continue;
      double sum = 0;
      for (std::size_t below = 0; below <= part; ++below) {
        sum += std::fmax(Percent(groups[g].second, below), 0);
      }
      bars.Add(static_cast<double>(g), sum);
      bars.filters.push_back({"^" + groups[g].first + "/", "=fine"});
      bars.texts.push_back(
          fmt::format("{}: {} {:.2f} %", groups[g].first, kPlantLossParts[part].title, own));
    }
    panel.series.push_back(std::move(bars));
  }
  panel.y = {"Energy lost (%)", 0};
  panel.x.low = -0.6;
  panel.x.high = static_cast<double>(groups.size()) - 0.4;
  panel.x.slanted = true;
  for (const NamedLosses& group : groups) {
    panel.x.ticks.push_back({ShortName(group.first), static_cast<double>(panel.x.ticks.size())});
  }
  panel.height = 240;
  return panel;
}

block::Table::Row LossRow(const std::string& name, const PlantLosses& losses) {
  block::Table::Row row = {name, Counted(losses.rows)};
  for (std::size_t part = 0; part < kAllParts; ++part) {
    const double percent = Percent(losses, part);
    row.push_back(std::isfinite(percent) ? fmt::format("{:.2f}", percent) : "not told");
  }
  row.push_back(fmt::format("{:.0f}", losses.lost_W));
  return row;
}

}  // namespace

PlantLossCounter::PlantLossCounter(const std::vector<ResultColumn>& columns) : reader_(columns) {
  for (const PlantLossPart& part : kPlantLossParts) counts_ = counts_ && reader_.Has(part.column);
}

void PlantLossCounter::Add(const std::string& id, const ResultRow& row) {
  if (!counts_) return;
  std::vector<double> percents;
  for (const PlantLossPart& part : kPlantLossParts) {
    percents.push_back(reader_.Number(row, part.column));
  }
  const double power_W = reader_.Number(row, "reference_power_W");
  const double now_percent = reader_.Number(row, "loss_now_total_percent");
  if (!std::isfinite(percents.back()) || !(power_W > 0)) return;
  const auto add = [&](PlantLosses& sums) {
    sums = WithLoss(std::move(sums), percents, power_W, now_percent);
  };
  add(summary_.plant);
  const std::string parent = ParentOf(id);
  const bool fits = summary_.groups.size() < kPlantMostNodes || summary_.groups.count(parent) > 0;
  if (!parent.empty() && fits) add(summary_.groups[parent]);
}

block::Figure LossesFigure(const PlantLossSummary& losses) {
  block::Figure shown;
  if (losses.plant.rows == 0) return shown;
  std::vector<NamedLosses> groups = LosingGroups(losses);
  std::vector<std::string> titles;
  for (std::size_t part = 0; part + 1 < kAllParts; ++part) {
    titles.emplace_back(kPlantLossParts[part].title);
  }
  shown.readings.alignment = "l" + std::string(kAllParts + 2, 'r');
  shown.readings.heads = {{"group", "strings"}};
  shown.readings.caption = "Energy lost by part in percent, and the power lost now.";
  block::Table::Row& head = shown.readings.heads.front();
  for (const PlantLossPart& part : kPlantLossParts) {
    head.push_back(fmt::format("{} (%)", part.title));
  }
  head.emplace_back("lost now (W)");
  shown.readings.rows.push_back(LossRow("all", losses.plant));
  for (const auto& [path, sums] : groups) shown.readings.rows.push_back(LossRow(path, sums));
  if (groups.empty()) groups.emplace_back("all", losses.plant);
  shown.figure.title = "Energy lost since the reference days, by part";
  shown.caption = fmt::format(
      "Energy lost since the reference days of each string, by part. The bars are means over {}, "
      "weighted by power. Parts below zero are gains and stand in the table only. \"Lost now\" is "
      "of the last 30 days with data.",
      losses.groups.size() > kLossGroups ? fmt::format("the {} groups that lose most", kLossGroups)
                                         : std::string("the groups"));
  shown.figure.legend = LegendOf(titles, LegendMark::kBar);
  shown.figure.panels = {LossBars(groups)};
  shown.figure.panel_width = 760;
  shown.figure.margin_below = 70;
  return shown;
}

}  // namespace lyrefit
