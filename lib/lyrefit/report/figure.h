#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"

// A picture as data: a page of panels under a common title and legend. What it shows is decided by
// functions from a record to a Figure; how it is drawn is decided here, with gnuplot.
namespace lyrefit {

struct Look {
  std::string colour = "#000000";  // empty: by the third number of each row, on the colour bar
  int dash = 1;                    // gnuplot's numbers of dashes and symbols
  int point = 7;
};

// Colours of Okabe and Ito, which the colour-blind tell apart too.
inline constexpr char kBlue[] = "#0072B2";
inline constexpr char kVermilion[] = "#D55E00";
inline constexpr char kSkyBlue[] = "#56B4E9";
inline constexpr char kOrange[] = "#E69F00";
inline constexpr char kGrey[] = "#888888";

// Of the first, second, ... of lines that are to be told apart.
Look LookOf(int index);

enum class SeriesKind {
  kPoints,
  kLine,
  kLineAndPoints,
  kStems,  // from zero
  kBox,    // the quartiles of all y at the x of the first row, and what lies far out
};

struct Series {
  SeriesKind kind = SeriesKind::kLine;
  Look look = {};
  double width = 1;  // of lines, and of boxes along x
  double size = 1;   // of points
  bool right_axis = false;
  std::string name = {};                         // viewers show it under the pointer
  std::vector<std::array<double, 3>> rows = {};  // x, y and what decides the colour
  std::vector<std::size_t> ends = {};  // where a stretch of rows ends that is not joined on

  void Add(double x, double y, double colour = 0);  // nothing that is not finite
  void EndLine();
};

struct Tick {
  std::string name;
  double place = 0;
};

struct Axis {
  std::string label;
  double low = kUnknown;  // unknown ends are those of the data, at the next tick
  double high = kUnknown;
  std::string colour = "black";  // of the label
  double air_low = 0;            // room beyond the data where an end is unknown, of the panel
  double air_high = 0;
  bool tight = false;  // an unknown end is not moved to the next tick
  bool log = false;
  double first_tick = kUnknown;  // unknown: chosen by gnuplot
  double tick_step = kUnknown;   // a factor on a logarithmic axis
  std::vector<Tick> ticks = {};  // instead of numbers
  bool slanted = false;          // the names of ticks
};

// A line all across at a height of the y axis, behind the series.
struct Rule {
  double y = 0;
  std::string colour = "black";
  int dash = 1;
  double width = 1;
  bool right_axis = false;
};

// From one place of an axis to another, all across, behind everything.
struct Band {
  bool upright = false;  // between two x
  double low = 0;
  double high = 0;
  std::string colour = kSkyBlue;
  double opacity = 0.25;
};

// In shares of the panel.
struct Note {
  std::string text;
  std::string colour;
  double x = 0;
  double y = 0;
  std::string side = "center";  // which of the text is at x
};

struct Panel {
  std::string title;
  Axis x = {};
  Axis y = {};  // labelled in the panels on the left only
  std::optional<Axis> right = {};
  std::vector<Series> series = {};
  std::vector<Rule> rules = {};
  std::vector<Band> bands = {};
  std::vector<Note> notes = {};
  bool zero_line = false;  // where zero is within the range
  int height = 300;        // pixels of the svg picture
};

enum class LegendMark { kLine, kPoint, kLineAndPoint, kBox };

struct LegendEntry {
  std::string name;
  Look look = {};
  LegendMark mark = LegendMark::kLine;
};

// What colours stand for, under the panels.
struct ColourBar {
  std::string label;
  double low = 0;
  double high = 1;
};

struct Figure {
  std::string title;
  std::vector<LegendEntry> legend = {};
  std::vector<Panel> panels = {};  // row by row from the upper left
  int columns = 1;
  int panel_width = 0;  // pixels; 0: by the number of columns
  int room_below = 0;   // pixels under each panel, for slanted names
  std::optional<ColourBar> colour_bar = {};
};

// The names with the looks of their places.
std::vector<LegendEntry> LegendOf(const std::vector<std::string>& names, LegendMark mark);

// Which points of many are drawn: so few that they look like all of them and the picture is less
// than a megabyte, or all.
enum class PlotPoints { kThinned, kAll };

// gnuplot commands that draw the figure on standard output. `terminal` is "svg" or "png".
std::string FigureScript(const Figure& figure, const std::string& terminal,
                         PlotPoints points = PlotPoints::kThinned);

// Draws into a .svg or .png file. Written completely or not at all. Errors: another extension,
// gnuplot missing, `path` not writable.
Expected<void> DrawFigure(const Figure& figure, const std::string& path,
                          PlotPoints points = PlotPoints::kThinned);

// Whether DrawFigure() can draw into a file of this name: extension and gnuplot. To be asked before
// a long fit.
Expected<void> CheckPlot(const std::string& path);

}  // namespace lyrefit
