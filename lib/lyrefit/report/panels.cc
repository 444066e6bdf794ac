#include "lyrefit/report/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lyrefit {
namespace {

constexpr int kLeft = 96;  // room for the axis of the panels on the left
constexpr int kGap = 64;   // between panels, for the numbers of the next axis
constexpr int kRight = 24;
constexpr int kTitle = 44;
constexpr int kLegendRow = 24;
constexpr int kPanelTitle = 34;
constexpr int kAxis = 64;  // under a panel
constexpr int kLine = 36;  // length of a line in the legend
constexpr int kLetter = 9;

// A page of few columns has room for wide ones.
int PanelWidth(int columns) { return columns == 1 ? 640 : columns == 2 ? 500 : 400; }

// Colours of Okabe and Ito without the yellow, and a grey.
constexpr std::array<const char*, 8> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                 "#000000", "#E69F00", "#56B4E9", "#8C8C8C"};
constexpr std::array<int, 8> kPoints = {7, 5, 9, 11, 6, 4, 8, 10};

}  // namespace

PanelPage::PanelPage(int panels, int columns, std::string title, LegendMark mark,
                     std::vector<std::string> legend, int names_below, int panel_height)
    : panels_(panels),
      columns_(std::min(columns, panels)),
      title_(std::move(title)),
      mark_(mark),
      legend_(std::move(legend)),
      names_below_(names_below),
      panel_height_(panel_height) {}

int PanelPage::Width() const {
  return kLeft + columns_ * PanelWidth(columns_) + (columns_ - 1) * kGap + kRight;
}

int PanelPage::EntryWidth() const {
  std::size_t longest = 1;
  for (const std::string& name : legend_) longest = std::max(longest, name.size());
  return kLine + 34 + kLetter * static_cast<int>(longest);
}

int PanelPage::LegendColumns() const {
  const int room = (Width() - kLeft) / EntryWidth();
  return std::clamp(room, 1, std::max(1, static_cast<int>(legend_.size())));
}

int PanelPage::LegendRows() const {
  if (legend_.empty()) return 0;
  return (static_cast<int>(legend_.size()) - 1) / LegendColumns() + 1;
}

int PanelPage::Top() const { return kTitle + LegendRows() * kLegendRow; }

int PanelPage::Height() const {
  const int rows = (panels_ - 1) / columns_ + 1;
  return Top() + rows * (kPanelTitle + panel_height_ + kAxis + names_below_);
}

std::string PanelPage::Begin(const std::string& terminal) const {
  const double w = Width();
  const double h = Height();
  std::string script = "set encoding utf8\n";
  if (terminal == "svg") {
    script += fmt::format(
        "set terminal svg size {},{} enhanced font 'DejaVu Sans,14' background '#ffffff'\n", w, h);
  } else {
    script += fmt::format(
        "set terminal pngcairo size {},{} enhanced font 'DejaVu Sans,11' fontscale 1.5 linewidth "
        "1.5\n",
        1.5 * w, 1.5 * h);
  }
  script +=
      "set multiplot\nunset key\nset border lw 0.8\nset grid back lt 1 lw 0.6 lc rgb '#d8d8d8'\n"
      "set tics nomirror out scale 0.6\n";
  script += fmt::format("set label 1001 {} at screen {:.5f},{:.5f} center noenhanced\n",
                        GnuplotText(title_), 0.5, 1 - 22 / h);
  return script + Legend();
}

std::string PanelPage::Legend() const {
  const double w = Width();
  const double h = Height();
  const int columns = LegendColumns();
  const double left = kLeft + std::max(0.0, 0.5 * (w - kLeft - kRight - columns * EntryWidth()));
  std::string script;
  for (int i = 0; i < static_cast<int>(legend_.size()); ++i) {
    const int row = i / columns;
    const double x = left + EntryWidth() * (i % columns);
    const double y = 1 - (kTitle + kLegendRow * (row + 0.5)) / h;
    const double end = (x + kLine) / w;
    if (mark_ == LegendMark::kBox) {
      script += fmt::format(
          "set object {} rectangle from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} "
          "fc rgb '{}' fs solid 0.45 border lc rgb '{}'\n",
          1001 + i, x / w, y - 6 / h, end, y + 6 / h, ColourOf(i), ColourOf(i));
    } else {
      script += fmt::format(
          "set arrow {} from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} nohead lw 2 {}\n",
          1001 + i, x / w, y, end, y, LineLook(i));
    }
    if (mark_ == LegendMark::kLineAndPoint) {
      script +=
          fmt::format("set label {} '' at screen {:.5f},{:.5f} point pt {} ps 1 lc rgb '{}'\n",
                      3001 + i, (x + 0.5 * kLine) / w, y, PointLook(i), ColourOf(i));
    }
    script += fmt::format("set label {} {} at screen {:.5f},{:.5f} left noenhanced\n", 2001 + i,
                          GnuplotText(legend_[i]), end + 8 / w, y);
  }
  return script;
}

std::string PanelPage::Place(int panel, const PanelText& text) const {
  const double w = Width();
  const double h = Height();
  const int column = panel % columns_;
  const int row = panel / columns_;
  const double width = PanelWidth(columns_);
  const double left = kLeft + column * (width + kGap);
  const double top =
      Top() + row * (kPanelTitle + panel_height_ + kAxis + names_below_) + kPanelTitle;
  std::string script;
  if (panel > 0) script += "unset arrow\nunset label\nunset object\n";  // these are drawn
  script += fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
      "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n"
      "set title {} noenhanced offset 0,-0.6\n",
      left / w, (left + width) / w, 1 - top / h, 1 - (top + panel_height_) / h,
      GnuplotText(text.title));
  script += fmt::format("set label 1 {} at graph 0.5, screen {:.5f} center noenhanced\n",
                        GnuplotText(text.x_axis), 1 - (top + panel_height_ + 46) / h);
  if (column > 0) return script;
  return script +
         fmt::format("set label 2 {} at screen {:.5f}, graph 0.5 center rotate noenhanced\n",
                     GnuplotText(text.y_axis), 20 / w);
}

std::string GnuplotText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return quoted + "'";
}

std::string ColourOf(int index) { return kColours[index % kColours.size()]; }

std::string LineLook(int index) {
  const int round = index / static_cast<int>(kColours.size());
  constexpr std::array<int, 4> kDashes = {1, 2, 4, 3};
  return fmt::format("lc rgb '{}' dt {}", ColourOf(index), kDashes[round % kDashes.size()]);
}

double PointSize(const std::string& terminal) { return terminal == "svg" ? 0.6 : 1; }

int PointLook(int index) { return kPoints[index % kPoints.size()]; }

}  // namespace lyrefit
