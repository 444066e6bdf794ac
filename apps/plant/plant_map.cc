#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lyrefit/batch/addition.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/stream/natural_order.h"
#include "plant/plant_figures.h"
#include "plant/plant_text.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostCells = 400;
constexpr std::size_t kMostLines = 60;
constexpr std::size_t kMostAcross = 50;
constexpr std::size_t kWide = 760;  // pixels of the cells of one line, and on a phone
constexpr std::size_t kNarrow = 290;
constexpr std::size_t kLetter = 8;
constexpr std::size_t kLineLength = 20;  // where names are too many for columns

struct ByNature {
  bool operator()(const std::string& one, const std::string& other) const {
    return NaturalLess(one, other);
  }
};

// The part of an id below its group.
std::string NameOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

// The deepest level with few enough groups; -1 without a tree.
int LevelToDraw(const PlantSummary& summary) {
  int level = -1;
  for (std::size_t l = 0; l < summary.levels.size(); ++l) {
    std::set<std::string> parents;
    for (const auto& [path, node] : summary.levels[l]) parents.insert(ParentOf(path));
    const bool few = summary.levels[l].size() <= kMostCells && parents.size() <= kMostLines;
    if (few) level = static_cast<int>(l);
  }
  return level;
}

double Shortfall(const PlantNode& node, bool by_factor) {
  const double part = by_factor ? 1 - node.lowest_performance
                                : static_cast<double>(node.in_need) /
                                      static_cast<double>(std::max<std::int64_t>(node.rows, 1));
  return 100 * std::fmax(part, 0);
}

// A line of cells for each group above. A cell's place is that of its name, or its number where
// names are many.
struct CellGrid {
  std::map<std::string, std::vector<std::string>, ByNature> lines;  // paths, by group above
  std::map<std::string, int, ByNature> across;                      // place of each name
};

CellGrid GridOf(const std::map<std::string, PlantNode>& level) {
  CellGrid grid;
  for (const auto& [path, node] : level) {
    grid.lines[ParentOf(path)].push_back(path);
    grid.across.emplace(NameOf(path), 0);
  }
  if (grid.across.size() <= kMostAcross) {
    int place = 0;
    for (auto& name : grid.across) name.second = place++;
    return grid;
  }
  grid.across.clear();
  auto lines = std::move(grid.lines);
  grid.lines.clear();
  for (auto& [above, paths] : lines) {
    std::sort(paths.begin(), paths.end(), ByNature());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::size_t part = i / kLineLength;
      const std::string name = part == 0 ? above : fmt::format("{} ({})", above, part + 1);
      grid.lines[name].push_back(paths[i]);
    }
  }
  return grid;
}

std::size_t LongestName(const Panel& panel) {
  std::size_t longest = 0;
  for (const Tick& tick : panel.x.ticks) longest = std::max(longest, tick.name.size());
  return longest;
}

// Pixels that all names below the cells need side by side.
std::size_t NamesWidth(const Panel& panel) {
  return kLetter * (LongestName(panel) + 1) * panel.x.ticks.size();
}

Panel CellPanel(const CellGrid& grid, const std::map<std::string, PlantNode>& level,
                bool by_factor) {
  Panel panel;
  Series cells;
  cells.kind = SeriesKind::kCells;
  cells.look.colour = "";
  cells.width = 0.92;
  cells.filter_columns = {"id"};
  double across = 1;
  double y = static_cast<double>(grid.lines.size());
  for (const auto& [above, paths] : grid.lines) {
    panel.y.ticks.push_back({ShortName(above), --y});
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const auto at = grid.across.find(NameOf(paths[i]));
      const double x = at == grid.across.end() ? static_cast<double>(i) : at->second;
      const PlantNode& node = level.at(paths[i]);
      if (by_factor && !std::isfinite(node.lowest_performance)) continue;
      cells.Add(x, y, Shortfall(node, by_factor));
      cells.filters.push_back({"^" + paths[i] + "/"});
      cells.texts.push_back(
          fmt::format("{}: {} string{}, {} need{} work", paths[i], node.rows,
                      node.rows == 1 ? "" : "s", node.in_need, node.in_need == 1 ? "s" : "") +
          (by_factor ? fmt::format(", lowest performance factor {:.3f}", node.lowest_performance)
                     : ""));
      across = std::fmax(across, x + 1);
    }
  }
  const std::size_t every = grid.across.size() <= 12 ? 1 : 1 + grid.across.size() / 9;
  for (const auto& [name, place] : grid.across) {
    if (static_cast<std::size_t>(place) % every != 0) continue;
    panel.x.ticks.push_back({ShortName(name), static_cast<double>(place)});
  }
  panel.x.slanted = NamesWidth(panel) > kWide;
  panel.x.low = panel.y.low = -0.5;
  panel.x.high = across - 0.5;
  panel.y.high = static_cast<double>(grid.lines.size()) - 0.5;
  panel.height = static_cast<int>(std::clamp<std::size_t>(24 * grid.lines.size(), 48, 1200));
  panel.series = {std::move(cells)};
  return panel;
}

}  // namespace

block::Figure MapFigure(const PlantSummary& summary) {
  block::Figure shown;
  const int level = LevelToDraw(summary);
  if (level < 0) return shown;
  const std::map<std::string, PlantNode>& nodes = summary.levels[static_cast<std::size_t>(level)];
  const bool by_factor = std::any_of(nodes.begin(), nodes.end(), [](const auto& node) {
    return std::isfinite(node.second.lowest_performance);
  });
  double most = by_factor ? 5 : 1;
  shown.readings = {"lrrr", {{"group", "strings", "need work", "lowest performance factor"}}};
  shown.readings.caption = "All groups of the picture.";
  for (const auto& [path, node] : nodes) {
    if (!by_factor || std::isfinite(node.lowest_performance)) {
      most = std::fmax(most, Shortfall(node, by_factor));
    }
    shown.readings.rows.push_back(
        {path, Counted(node.rows), Counted(node.in_need), Significant(node.lowest_performance, 4)});
  }
  shown.figure.title = "The plant: each square is a group";
  shown.figure.panels = {CellPanel(GridOf(nodes), nodes, by_factor)};
  shown.figure.panel_width = kWide;
  const Panel& panel = shown.figure.panels.front();
  if (NamesWidth(panel) > kNarrow)
    shown.figure.margin_below = static_cast<int>(5 * LongestName(panel));
  shown.figure.colour_bar = {
      by_factor ? "Largest shortfall of a string (%)" : "Strings that need work (%)", 0,
      std::ceil(most)};
  shown.caption = fmt::format(
      "Each square is one of the {} groups. Its colour says {}.",
      Counted(static_cast<std::int64_t>(nodes.size())),
      by_factor ? "by how much the worst string of the group falls short of the expected power"
                : "which share of its strings needs work");
  return shown;
}

}  // namespace lyrefit
