#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

// A picture as data: a page of panels under a common title and legend. What it shows is decided by
// functions from a record to a Figure; how it is drawn is decided here, with gnuplot.
namespace LYREFIT_PUBLIC lyrefit {

// How a series is drawn.
struct Look {
  std::string colour = "#000000";  // empty: by the third number of each row, on the colour bar
  int dash = 1;                    // gnuplot's numbers of dashes and symbols
  int point = 7;                   // a symbol by gnuplot's number: 7 is a disc
};

// Colours of Okabe and Ito, which the colour-blind tell apart too.
inline constexpr char kBlue[] = "#0072B2";
inline constexpr char kVermilion[] = "#D55E00";
inline constexpr char kSkyBlue[] = "#56B4E9";
inline constexpr char kOrange[] = "#E69F00";
inline constexpr char kGrey[] = "#888888";

// Of the first, second, ... of lines that are to be told apart.
Look LookOf(int index);

// What is drawn of the rows of a series.
enum class SeriesKind {
  kPoints,
  kLine,
  kLineAndPoints,
  kStems,  // from zero
  kBox,    // the quartiles of all y at the x of the first row, and what lies far out
};

// Points or a line in a panel.
struct Series {
  SeriesKind kind = SeriesKind::kLine;
  Look look = {};                                // colour, dash and symbol
  double width = 1;                              // of lines, and of boxes along x
  double size = 1;                               // of points
  bool right_axis = false;                       // y is read off the axis on the right
  std::string name = {};                         // viewers show it under the pointer
  std::vector<std::array<double, 3>> rows = {};  // x, y and what decides the colour
  std::vector<std::size_t> ends = {};  // where a stretch of rows ends that is not joined on

  void Add(double x, double y, double colour = 0);  // nothing that is not finite
  // What is added from here on is not joined to what is there.
  void EndLine();
};

// A word in the place of a number on an axis.
struct Tick {
  std::string name;  // the word
  double place = 0;  // in the axis' numbers
};

// One axis of a panel.
struct Axis {
  std::string label;      // with its unit: "Voltage (V)"
  double low = kUnknown;  // unknown ends are those of the data, at the next tick
  double high = kUnknown;
  std::string colour = "black";  // of the label
  double air_low = 0;            // room beyond the data where an end is unknown, of the panel
  double air_high = 0;           // the same at the upper end
  bool tight = false;            // an unknown end is not moved to the next tick
  bool log = false;              // logarithmic
  double first_tick = kUnknown;  // unknown: chosen by gnuplot
  double tick_step = kUnknown;   // a factor on a logarithmic axis
  std::vector<Tick> ticks = {};  // instead of numbers
  bool slanted = false;          // the names of ticks
};

// A line all across at a height of the y axis, behind the series.
struct Rule {
  double y = 0;  // in the axis' numbers
  std::string colour = "black";
  int dash = 1;             // gnuplot's number
  double width = 1;         // of the line
  bool right_axis = false;  // `y` is of the axis on the right
};

// From one place of an axis to another, all across, behind everything.
struct Band {
  bool upright = false;  // between two x
  double low = 0;
  double high = 0;
  std::string colour = kSkyBlue;
  double opacity = 0.25;  // 0 to 1
};

// In shares of the panel.
struct Note {
  std::string text;  // one line
  std::string colour;
  double x = 0;                 // from the left, 0 to 1
  double y = 0;                 // from below, 0 to 1
  std::string side = "center";  // which of the text is at x
};

// One set of axes with all that is drawn on them.
struct Panel {
  std::string title;
  Axis x = {};                      // below
  Axis y = {};                      // labelled in the panels on the left only
  std::optional<Axis> right = {};   // a second y axis, where a series asks for it
  std::vector<Series> series = {};  // the first lies lowest
  std::vector<Rule> rules = {};
  std::vector<Band> bands = {};
  std::vector<Note> notes = {};
  bool zero_line = false;  // where zero is within the range
  int height = 300;        // pixels of the svg picture
};

// What stands beside a name in the legend.
enum class LegendMark { kLine, kPoint, kLineAndPoint, kBox };

// A name in the legend, and how what it stands for is drawn.
struct LegendEntry {
  std::string name;                     // what the look stands for
  Look look = {};                       // as that of the series
  LegendMark mark = LegendMark::kLine;  // what is drawn beside the name
};

// What colours stand for, under the panels.
struct ColourBar {
  std::string label;  // with its unit
  double low = 0;
  double high = 1;
};

// A page of panels under one title and one legend.
struct Figure {
  std::string title;
  std::vector<LegendEntry> legend = {};  // above the panels
  std::vector<Panel> panels = {};        // row by row from the upper left
  int columns = 1;                       // of panels
  int panel_width = 0;                   // pixels; 0: by the number of columns
  int room_below = 0;                    // pixels under each panel, for slanted names
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
