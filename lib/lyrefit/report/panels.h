#pragma once

#include <string>
#include <vector>

namespace lyrefit {

// How the legend shows what its names stand for.
enum class LegendMark { kLine, kLineAndPoint, kBox };

// The y axis is labelled in the panels on the left only.
struct PanelText {
  std::string title;
  std::string x_axis;
  std::string y_axis;
};

// A page of equal panels under a common title and legend, in pixels of the svg picture. Panels are
// counted row by row from the upper left.
class PanelPage {
 public:
  // `legend` names the lines in order; `names_below` is the room for names under each panel.
  PanelPage(int panels, int columns, std::string title, LegendMark mark,
            std::vector<std::string> legend, int names_below, int panel_height = 300);

  // Terminal, title and legend; then for each panel Place() and its own commands; then End().
  std::string Begin(const std::string& terminal) const;
  std::string Place(int panel, const PanelText& text) const;
  static std::string End() { return "unset multiplot\n"; }

 private:
  int EntryWidth() const;
  int LegendColumns() const;
  int LegendRows() const;
  std::string Legend() const;
  int Width() const;
  int Height() const;
  int Top() const;

  int panels_;
  int columns_;
  std::string title_;
  LegendMark mark_;
  std::vector<std::string> legend_;
  int names_below_;
  int panel_height_;
};

// In gnuplot's single quotes; control characters become blanks.
std::string GnuplotText(const std::string& text);

// How line `index` of a legend looks: "lc rgb '#0072B2' dt 1", and its point type.
std::string LineLook(int index);
int PointLook(int index);
double PointSize(const std::string& terminal);  // svg draws the same size larger
std::string ColourOf(int index);

}  // namespace lyrefit
