#include "lyrefit/batch/plant_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/report/html_parts.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr int kWidth = 960;
constexpr int kLabel = 150;  // part of the width for names
constexpr std::size_t kMostCells = 400;
constexpr std::size_t kMostRows = 60;

// Deviation of a node from its target, 0 to 1. It is computed from the lowest performance factor if
// that is known, with 1 at 0.7 and below. Otherwise it is the share of strings that need work.
double Shade(const PlantNode& node) {
  const double lowest = node.lowest_performance;
  if (std::isfinite(lowest)) return std::clamp((1 - lowest) / 0.3, 0.0, 1.0);
  return std::clamp(static_cast<double>(node.in_need) / std::max<double>(node.rows, 1), 0.0, 1.0);
}

std::string CellText(const PlantNode& node) {
  return std::isfinite(node.lowest_performance) ? fmt::format("{:.2f}", node.lowest_performance)
                                                : fmt::format("{}/{}", node.in_need, node.rows);
}

std::string Shortened(const std::string& name, std::size_t most) {
  if (Columns(name) <= most) return name;
  std::string text = name.substr(name.size() - most);
  while (!text.empty() && (text.front() & 0xc0) == 0x80) text.erase(0, 1);
  return "\xe2\x80\xa6" + text;
}

std::string CellPicture(double x, double y, double width, const std::string& name,
                        const PlantNode& node) {
  // From light to vermilion. The upper half is dark enough for white text.
  const double shade = Shade(node);
  const bool dark = shade > 0.55;
  std::string svg = fmt::format(
      "<g><title>{}: {} strings, {} need work{}</title><rect x=\"{:.1f}\" y=\"{:.0f}\" "
      "width=\"{:.1f}\" height=\"22\" fill=\"#a33f00\" fill-opacity=\"{:.2f}\" "
      "class=\"cell\"/>",
      HtmlEscaped(name), node.rows, node.in_need,
      std::isfinite(node.lowest_performance)
          ? fmt::format(", lowest performance factor {:.3f}", node.lowest_performance)
          : "",
      x, y, width - 2, 0.06 + 0.94 * shade);
  if (width >= 34) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\"{}>{}{}</text>",
                       x + width / 2 - 1, y + 15, dark ? " class=\"on-dark\"" : "", CellText(node),
                       node.in_need > 0 && width >= 50 ? " !" : "");
  }
  return svg + "</g>\n";
}

// The deepest level with few enough nodes; -1 without a tree.
int LevelToDraw(const PlantSummary& summary) {
  int level = -1;
  for (std::size_t l = 0; l < summary.levels.size(); ++l) {
    if (summary.levels[l].size() <= kMostCells) level = static_cast<int>(l);
  }
  return level;
}

}  // namespace

std::string MapPicture(const PlantSummary& summary) {
  const int level = LevelToDraw(summary);
  if (level < 0) return "";
  std::map<std::string, std::vector<std::pair<std::string, PlantNode>>> lines;
  for (const auto& [path, node] : summary.levels[level]) {
    const std::size_t slash = path.rfind('/');
    const std::string above = slash == std::string::npos ? "" : path.substr(0, slash);
    lines[above].emplace_back(path, node);
  }
  std::size_t longest = 1;
  for (const auto& [above, nodes] : lines) longest = std::max(longest, nodes.size());
  const std::size_t across = std::min<std::size_t>(longest, 16);
  const double width = std::min(120.0, static_cast<double>(kWidth - kLabel) / across);
  std::string svg;
  double y = 4;
  std::size_t drawn = 0;
  for (const auto& [above, nodes] : lines) {
    if (drawn++ == kMostRows) break;
    svg += fmt::format("<text x=\"0\" y=\"{:.0f}\">{}</text>\n", y + 15,
                       HtmlEscaped(Shortened(above, 20)));
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (n > 0 && n % across == 0) y += 24;
      svg += CellPicture(kLabel + width * (n % across), y, width, nodes[n].first, nodes[n].second);
    }
    y += 28;
  }
  const bool by_factor = std::any_of(summary.performance.begin(), summary.performance.end(),
                                     [](std::int64_t rows) { return rows > 0; });
  return fmt::format(
             "<figure><svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"The plant's tree, "
             "a cell a node\">\n",
             kWidth, y) +
         svg +
         fmt::format(
             "</svg><figcaption>A cell for each of the {} nodes of level {}: {}; the darker, the "
             "worse; ! where a string needs work.{}</figcaption></figure>\n",
             summary.levels[level].size(), level + 1,
             by_factor ? "the lowest performance factor in it" : "strings that need work / strings",
             lines.size() > kMostRows ? fmt::format(" The first {} rows.", kMostRows) : "");
}

std::string PerformancePicture(const PlantSummary& summary) {
  const auto& bins = summary.performance;
  std::int64_t all = 0, most = 0;
  std::size_t first = bins.size(), last = 0;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    all += bins[b];
    most = std::max(most, bins[b]);
    if (bins[b] == 0) continue;
    first = std::min(first, b);
    last = b;
  }
  if (all == 0) return "";
  first = first / 10 * 10;
  last = (last / 10 + 1) * 10;
  const double step = 900.0 / static_cast<double>(last - first);
  std::string svg;
  for (std::size_t b = first; b < std::min(last, bins.size()); ++b) {
    const double height = 150.0 * static_cast<double>(bins[b]) / static_cast<double>(most);
    if (bins[b] == 0) continue;
    svg += fmt::format(
        "<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">"
        "<title>{:.2f} to {:.2f}: {}</title></rect>\n",
        30 + step * static_cast<double>(b - first), 160 - std::max(height, 1.0),
        std::max(step - 1, 1.0), std::max(height, 1.0), b / 100.0, (b + 1) / 100.0, bins[b]);
  }
  for (std::size_t tick = first; tick <= last; tick += 10) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"178\" text-anchor=\"middle\">{:.1f}</text>\n",
                       30 + step * static_cast<double>(tick - first), tick / 100.0);
  }
  std::int64_t below = 0;
  std::size_t median = 0;
  while (2 * (below += bins[median]) < all) ++median;
  return fmt::format(
             "<figure><svg viewBox=\"0 0 {} 186\" role=\"img\" aria-label=\"Strings by performance "
             "factor\"><line class=\"axis\" x1=\"30\" y1=\"160\" x2=\"930\" y2=\"160\"/>\n",
             kWidth) +
         svg +
         fmt::format(
             "</svg><figcaption>Performance factor (measured over predicted power) of {} strings "
             "in steps of 0.01: half of them lie below {:.2f}; the highest bar is {}."
             "</figcaption></figure>\n",
             all, (median + 1) / 100.0, most);
}

std::string ZoneMark(const std::string& zone) {
  if (zone == "pass") return "<span class=\"mark z0\" aria-hidden=\"true\">\xe2\x9c\x93</span> ";
  if (zone == "pass within uncertainty") {
    return "<span class=\"mark z1\" aria-hidden=\"true\">~</span> ";
  }
  if (zone == "fail within uncertainty") {
    return "<span class=\"mark z2\" aria-hidden=\"true\">?</span> ";
  }
  if (zone == "fail") return "<span class=\"mark z3\" aria-hidden=\"true\">\xe2\x9c\x95</span> ";
  return "";
}

}  // namespace lyrefit
